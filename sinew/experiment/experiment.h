// experiment/experiment.h - description of a run: a robot with its plan, or a test stand with its
// drive; the start, the faults, what is recorded, and the figures that were reported.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/config/reader.h"
#include "sinew/config/reported.h"
#include "sinew/config/shown_units.h"
#include "sinew/control/gait/plan.h"
#include "sinew/experiment/fault.h"
#include "sinew/experiment/stand.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/gas/valve.h"
#include "sinew/robot/robot.h"
#include "sinew/robot/wiring/wiring.h"
#include "sinew/signals/tick.h"
#include "sinew/signals/timing.h"

namespace sinew::experiment {

// Recording of a run: [log] of every kind of experiment.
struct Log {
  bool enabled = true;
  std::vector<std::string> channels = {"*"};  // topics; * matches any characters
  double period = 0.01;                       // [s]
  bool gains = false;                         // record the gains in effect; not for a stand
};

struct Start {
  std::map<std::string, double> joint_angles;  // [rad]
  std::vector<std::string> blocked;            // joints that are held at their start angle
  double pressure = 0;                         // pressure of every muscle, absolute [Pa]
  double trolley = 0;                          // position on the track [m]
  double lift = 0;                             // height of the body on its cylinder [m]
  double settle = 0;                           // time with open exhausts before the first phase [s]
};

// predict.dat as numbers, so that a resolved file needs no other file: times by duty 0 ... 100 %
// [ticks].
struct PulseTable {
  std::vector<double> closing, opening;
};

struct Experiment {
  std::string path;  // path of the file
  std::string name;  // name of the file, without its ending
  std::string title;
  std::string reproduces;
  std::string plant = "planar";
  int seed = 1;
  double body_step = 1e-3;  // interval of committed nodes [s]

  robot::Robot robot;
  robot::Wiring wiring;
  std::optional<Stand> stand;  // if present, robot, start and plan are empty
  std::vector<actuator::Actuator> actuators;
  std::vector<gas::Valve> valves;
  gas::Air air;
  gas::Supply supply;
  PulseTable pulses;  // empty: taken from the robot's low_level.valve_timing
  signals::ValveTiming timing = signals::identity_timing();

  Start start;
  gait::Plan plan;
  Log log;
  config::PageTable page;
  std::vector<Fault> faults;
  std::vector<config::Reported> reported;

  config::Origins origins;  // source of every value
  std::vector<config::Problem> warnings;
  std::vector<config::Problem> unsourced;  // numbers outside robots/ without a source
};

// Reads the file and all files that it names, with --set overrides. Throws config::Error with all
// errors and contradictions, such as references to names that do not exist. Consistent
// experiments that still cannot be built are refused by run/setup/buildable.h.
Experiment load(const std::string& path, const std::vector<std::string>& sets = {});

// Reads an experiment from a tree that is already composed.
Experiment load(const config::Node& root, const std::string& path);

// Throws config::Error with every stretch of a foot path that the leg cannot reach. load() does not
// call this, since a run is possible: the gait controller then aims at the nearest reachable point.
void refuse_unreachable(const Experiment& experiment);

// Returns the valve of that name, or nullptr if it does not exist.
const gas::Valve* find_valve(const Experiment& experiment, std::string_view name);

// Returns the last tick that a run can reach.
signals::Tick last_tick(const Experiment& experiment);

// Returns the experiment with the numbers of predict.dat in place of that file's name, so that it
// is independent of other files.
Experiment without_files(Experiment experiment);

// Returns the experiment as a file that can be run again: every value in SI, with its source.
std::string resolved(const Experiment& experiment, const std::string& version);

}  // namespace sinew::experiment
