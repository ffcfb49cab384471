// identify/check/recognised.h - overview of what was read, for a quick check by the user: files
// with their columns, muscles with their mounts, and the noise of the force.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/check/check.h"
#include "sinew/identify/check/recognised.h"

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

}  // namespace sinew::identify
