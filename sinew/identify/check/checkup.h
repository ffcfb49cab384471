// identify/check/checkup.h - summary of measurements before a static law is fitted: files with
// their columns, muscles with their mounts, the noise of the force, checks, and which parameters of
// a static law the data determine.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/check/check.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// A column with the range of its values, in the unit of the file: "force", "0 N", "541 N".
struct RecognisedColumn {
  std::string name, lowest, highest;
};

// A file that was read.
struct RecognisedFile {
  std::string file;
  std::size_t rows = 0;
  bool is_recording = false;  // has times; false: a table of points
  double settled = 1;         // share of a recording's samples that are at rest
  std::vector<RecognisedColumn> columns;
};

// Points of a muscle at one length.
struct RecognisedMount {
  double rest_length = 0, length = 0;  // rest length of the muscle, 0: unknown; mounted length [m]
  std::string branches;                // e.g. "fill, vent"; empty: unknown
  std::size_t points = 0;              // points that a fit takes
  int pressures = 0;                   // pressure steps among them
  double lowest = 0, highest = 0;      // gauge [Pa]
  double strongest = 0;                // largest force [N]
  std::size_t held_out = 0;            // points that are not fitted
};

// Scatter of force readings of one state.
struct ForceNoise {
  double deviation = 0;      // standard deviation of one reading [N]
  double share = 0;          // share of the largest force [-]
  std::size_t readings = 0;  // number of readings used; 0: unknown
  std::string from;          // "settled samples" or "repeated readings"
};

// Overview in the order of the files; mounts by muscle, the longest last.
struct Recognised {
  std::vector<RecognisedFile> files;
  std::vector<RecognisedMount> mounts;
  ForceNoise noise;
};

// Returns the overview of the tables and their points. Bad data throw nothing.
Recognised recognise(const CheckInput& input);

// --- noise of the force ---

// Returns the noise from settled samples of recordings, each compared with a straight line through
// its neighbours at rest, or from readings of a table that repeat a length, pressure and branch,
// each compared with the others. The kind with more data is used.
ForceNoise force_noise(const CheckInput& input);

// Source of a parameter's value.
enum class Determination {
  by_data,       // interval less than half of the value
  by_priors,     // value near that of other muscles
  at_bound,      // end of its range: the data show no such effect
  undetermined,  // compatible with zero, or no measurement depends on it
};

// One parameter of the law.
struct Determined {
  std::string name, unit;
  double value = 0, half_width = 0;  // half of its 95 % interval [unit]; infinite: unknown
  Determination by = Determination::undetermined;
  std::string words;   // "to +-3.1 %"
  std::string advice;  // measurement that would determine it; empty if the data do
};

// The richest law, fitted to these data.
struct DeterminedLaw {
  std::string model, law;  // "saturating-effectiveness", and its equation
  std::vector<Determined> parameters;
  std::string refused;  // why no fit is possible; empty: it is
};

// Fits the richest law to the points that are to be fitted. Bad data throw nothing.
DeterminedLaw determine(const CheckInput& input);

// Returns "data", "priors", "bound" or "nothing".
std::string_view word(Determination by);

// Checks, what was recognised, and the parameters that the data determine; these are left out if a
// check is red.
struct Checkup {
  std::vector<Check> checks;
  Recognised recognised;
  DeterminedLaw determined;
};

// Makes the whole summary. Bad data throw nothing.
Checkup check_up(const CheckInput& input);

// Returns the output of `sinew identify check --json`, sinew.check/1.
Json to_json(const Checkup& checkup);

}  // namespace sinew::identify
