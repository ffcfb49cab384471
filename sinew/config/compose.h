// config/compose.h - composition of several files into one resolved namespace.
//
//   experiment ── base = "other.toml"      merged under the file, one level deep,
//                                                without its `reported` figures
//              ── robot = "robot.toml"     its tables are added to the experiment's own
//                   ── files.actuator      actuator.<name>
//                   ── files.valves        valve.<name>
//                   ── files.wiring        wiring.…
//                   ── files.valve_timing  low_level.valve_timing, an absolute path
//                   ── files.gains         joint.<name>.angle_gain … (gains.h); an experiment's too
//              ── --set key=value          overrides all others
//
// Keys of valves or wiring in the robot's own file override those in the valves or wiring file, so
// a robot with a `base` may change a single delay.
//
// A valve may name one of a catalogue, a valves file; its values apply where the machine's files
// and
// --set give none:
//
//   [valve.inlet]
//   catalogue = "festo-mhj10"            of data/valves.toml, which ships with Sinew
//   catalogue_file = "our-valves.toml"   of this file instead
//
// A file that names one replaces what its base or the robot's valves file have for that valve; so
// does --set.
//
// The result has the keys that `--set` and messages use: joint.hip.damping, valve.inlet.area,
// phase.swing.duration. A file name is relative to the file that contains it. Robot, actuator and
// valves files can also be composed alone, as can a resolved.toml.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/node.h"

namespace sinew::config {

// Composes a file with its base, robot and settings. Every node keeps the file in which it was
// written. Throws Error.
Node compose(const std::string& path, const std::vector<std::string>& sets = {});

// Composes files again and again, each time with other settings. A file is read once. Files that
// only a value of the tree names, such as a table of valve timing, are not read here.
class Composer {
 public:
  // Returns the same as compose(), for the contents that the files had at the first call. Threads
  // may call it at the same time.
  Node compose(const std::string& path, const std::vector<std::string>& sets = {});

 private:
  const Node& read(const std::string& path, std::vector<std::string> files);
  void add_catalogue(Node& root);

  std::mutex mutex_;                               // guards the map; its nodes never change
  std::map<std::vector<std::string>, Node> read_;  // keys: path, settings of `robot`
};

// Returns the path of the file that an entry names, relative to the file with the entry, or else of
// the shipped file of that name. Throws Error that names the entry's `key` if there is no such
// file.
std::string file_of(const Node& entry, const std::string& key);

// Returns "experiment" for format = "sinew.experiment/1"; empty if there is no such key.
std::string_view format_kind(const Node& root);

// Returns whether an experiment describes a test stand: it has an [element] or the older format
// sinew.rig/1.
bool is_on_stand(const Node& root);

// Returns the kind found from the tables: format_kind(), or "rig" for an experiment on a test
// stand.
std::string_view tables_kind(const Node& root);

// Sets "key=value" in the tree: true, false, a number, a TOML list or table, else a text. An index,
// "phase.swing.y.polynomial[1]" or "fault[0].at", is that of an element of an existing list. In an
// actuator's file, "braid.turns" is "actuator.<name>.braid.turns".
void apply_set(Node& root, std::string_view set);

}  // namespace sinew::config
