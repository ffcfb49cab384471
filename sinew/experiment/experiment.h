// experiment/experiment.h - what is run: a robot with its plan, or a test stand with its drive; its
// start, what breaks, what is recorded, and what was reported of it.
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

// What of a run is recorded: [log] of every kind of experiment.
struct Log {
  bool enabled = true;
  std::vector<std::string> channels = {"*"};  // topics, * for any run of characters
  double period = 0.01;                       // [s]
  bool gains = false;                         // those in effect too; a stand has none
};

struct Start {
  std::map<std::string, double> joint_angles;  // [rad]
  std::vector<std::string> blocked;            // joints that are held there
  double pressure = 0;                         // of every muscle, absolute [Pa]
  double trolley = 0;                          // [m]
  double lift = 0;                             // of the body on its cylinder [m]
  double settle = 0;                           // exhausts open, before the first phase [s]
};

// predict.dat as numbers, so that a resolved file needs no other  [ticks], by duty 0 ... 100 %.
struct PulseTable {
  std::vector<double> closing, opening;
};

struct Experiment {
  std::string path;  // of the file
  std::string name;  // of the file, without its ending
  std::string title;
  std::string reproduces;
  std::string plant = "planar";
  int seed = 1;
  double body_step = 1e-3;  // between committed nodes [s]

  robot::Robot robot;
  robot::Wiring wiring;
  std::optional<Stand> stand;  // in the robot's place, which is empty then, as are start and plan
  std::vector<actuator::Actuator> actuators;
  std::vector<gas::Valve> valves;
  gas::Air air;
  gas::Supply supply;
  PulseTable pulses;  // empty: from the robot's low_level.valve_timing
  signals::ValveTiming timing = signals::identity_timing();

  Start start;
  gait::Plan plan;
  Log log;
  config::PageTable page;
  std::vector<Fault> faults;
  std::vector<config::Reported> reported;

  config::Origins origins;  // where every value came from
  std::vector<config::Problem> warnings;
  std::vector<config::Problem> unsourced;  // numbers outside robots/ that no source is given for
};

// Reads the file and everything it names, with --set overrides. Throws config::Error with all that
// is wrong, also what contradicts itself, such as names that lead nowhere. What contradicts nothing
// and can still not be built, run/setup/buildable.h refuses.
Experiment load(const std::string& path, const std::vector<std::string>& sets = {});

// The same from a tree that is composed already.
Experiment load(const config::Node& root, const std::string& path);

// Throws config::Error with every stretch of a foot path that the leg cannot reach. No part of
// load(): a run is possible, the brain then aims at the nearest point that can be reached.
void refuse_unreachable(const Experiment& experiment);

// Returns the valve of that name, nullptr where there is none.
const gas::Valve* find_valve(const Experiment& experiment, std::string_view name);

// The last tick that a run can reach.
signals::Tick last_tick(const Experiment& experiment);

// Returns the experiment with the numbers of predict.dat in place of that file's name: the same,
// wherever its files are.
Experiment without_files(Experiment experiment);

// What was run, as a file that runs again: every value in SI, with its source.
std::string resolved(const Experiment& experiment, const std::string& version);

}  // namespace sinew::experiment
