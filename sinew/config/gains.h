// config/gains.h - reader of gain.dat, the control gains of B.5.
//
// A row per joint has `angle gain, stiffness gain` and, with damping control, `, velocity gain`, in
// % per count, % per lbf in/rad and % per count/s. The first row is for joint 0, the cylinder: its
// angle gain and, as it has no stiffness gain, the desired stiffness of the first joint with
// muscles in lbf in/rad (B.1: stiffdes[1] = kgain[0]).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// Gains of a joint.
struct GainRow {
  double angle = 0, stiffness = 0, velocity = 0;  // as written
  int line = 0;
};

// Read a file or a text; throw Error.
std::vector<GainRow> read_gains(const std::string& path);
std::vector<GainRow> parse_gains(std::string_view text, const std::string& name);

// Sets the keys that gain.dat replaces: cylinder.position_gain if there is a cylinder, the gains of
// every joint with muscles and, if `with_control`, control.stiffness of the first. `entry` is the
// key that names the file: a key set in the same file as `entry` is a contradiction, a key of
// another file is replaced. Throws Error.
void put_gains(Node& root, const Node& entry, const std::string& path, bool with_control);

}  // namespace sinew::config
