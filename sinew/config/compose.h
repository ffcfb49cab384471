// config/compose.h - several files become the one resolved namespace.
//
//   experiment ── base = "other.toml"      merged under the file, one level deep,
//                                                without its `reported` figures
//              ── robot = "robot.toml"     its tables appear beside the experiment's own
//                   ── files.actuator      actuator.<name>
//                   ── files.valves        valve.<name>
//                   ── files.wiring        wiring.…
//                   ── files.valve_timing  low_level.valve_timing, an absolute path
//                   ── files.gains         joint.<name>.angle_gain … (gains.h); an experiment's too
//              ── --set key=value          last word
//
// A robot that writes keys of its valves or its wiring itself has them in place of the file's: a
// robot with a `base` may so change a delay alone.
//
// The result holds what `--set` and messages call a key: joint.hip.damping, valve.inlet.area,
// phase.swing.duration. A name in a file is relative to the file in which it is written. Robot,
// actuator and valves files compose alone too, and so does a resolved.toml.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// Throws Error. Every node keeps the file in which it was written.
Node compose(const std::string& path, const std::vector<std::string>& sets = {});

// "experiment" of format = "sinew.experiment/1"; empty where there is no such key.
std::string_view format_kind(const Node& root);

// Returns whether an experiment describes a test stand: it has an [element], or the older format
// sinew.rig/1.
bool is_on_stand(const Node& root);

// Returns the kind by its tables: as format_kind(), and "rig" of an experiment on a test stand.
std::string_view tables_kind(const Node& root);

// Puts "key=value" into the tree: true, false, numbers, TOML lists and tables, else text. A key
// that ends with an index, as "phase.swing.y.polynomial[1]", is an element of a list that is there.
void apply_set(Node& root, std::string_view set);

}  // namespace sinew::config
