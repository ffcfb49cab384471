// config/gains.h - gain.dat, the control gains of B.5.
//
// One row per joint, `angle gain, stiffness gain` and, with damping control, `, velocity gain`, in
// % per count, % per lbf in/rad and % per count/s. The first row is joint 0's, the cylinder's: its
// angle gain, and in place of a stiffness gain that it has not, the stiffness that the first joint
// with muscles is asked for, in lbf in/rad (B.1: stiffdes[1] = kgain[0]).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// The gains of one joint.
struct GainRow {
  double angle = 0, stiffness = 0, velocity = 0;  // as written
  int line = 0;
};

// Throw Error.
std::vector<GainRow> read_gains(const std::string& path);
std::vector<GainRow> parse_gains(std::string_view text, const std::string& name);

// Puts a gain.dat into the keys that it stands for: cylinder.position_gain where there is a
// cylinder, the gains of every joint with muscles, and, `with_control`, control.stiffness of the
// first. `entry` names it: a key that the same file says as well is a contradiction, one of a file
// below it is replaced. Throws Error.
void put_gains(Node& root, const Node& entry, const std::string& path, bool with_control);

}  // namespace sinew::config
