// identify/check/recognised.h - what was read, as a person would check it at a glance: files with
// their columns, muscles with their mounts, and how far force readings scatter.
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

// A file.
struct RecognisedFile {
  std::string file;
  std::size_t rows = 0;
  bool is_recording = false;  // it has times; else it is a table of points
  double settled = 1;         // share of a recording's samples that are at rest
  std::vector<RecognisedColumn> columns;
};

// A muscle at one length.
struct RecognisedMount {
  double rest_length = 0, length = 0;  // of the muscle, 0: not known; as mounted [m]
  std::string branches;                // "fill, vent"; empty: not told
  std::size_t points = 0;              // that a fit takes
  int pressures = 0;                   // steps among them
  double lowest = 0, highest = 0;      // gauge [Pa]
  double strongest = 0;                // largest force [N]
  std::size_t held_out = 0;            // points that are not fitted
};

// How far readings of one state scatter.
struct ForceNoise {
  double deviation = 0;      // standard, of one reading [N]
  double share = 0;          // of the largest force [-]
  std::size_t readings = 0;  // that tell it; 0: none does
  std::string from;          // "settled samples" or "repeated readings"
};

// What was read, in the order of the files; mounts by muscle, the longest last.
struct Recognised {
  std::vector<RecognisedFile> files;
  std::vector<RecognisedMount> mounts;
  ForceNoise noise;
};

// Returns what the tables and their points are. Throws nothing for what they hold.
Recognised recognise(const CheckInput& input);

// --- noise of the force ---

// Returns it from the samples of recordings that have settled, each against a straight line through
// those of its neighbours that it rests with; else from readings of a table that repeat a length,
// pressure and branch, each against the others. The larger kind of data speaks.
ForceNoise force_noise(const CheckInput& input);

}  // namespace sinew::identify
