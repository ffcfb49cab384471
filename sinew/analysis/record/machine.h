// analysis/record/machine.h - what the numbers of a log mean: the machine, the phases' names, what
// is reported of the run. Read from the composed experiment, or from the resolved.toml beside a
// log.
//
// Only what analysis needs is read, so a file may hold more than this folder knows of.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/analysis/measures/valves.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/node.h"
#include "sinew/config/reader.h"
#include "sinew/robot/robot.h"
#include "sinew/robot/stand.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

// What of a valve's table matters here: when it follows its coil, and what that takes.
struct MachineValve {
  std::string name;
  double opening = 0, closing = 0;  // from the edge until half of the way is done; ideal: 0 [s]
  gas::Coil coil;
  bool seals = true;  // false: a 3-way valve, which joins its muscle to the supply or to the room
  double shut = 0;    // from the edge that opens it until the shutter moves [s]
};

// A test stand, and what of its drive matters here.
struct MachineStand : robot::Stand {
  std::string drive = "none";  // its kind
  double drive_period = 0.04;  // [s]
};

struct Machine {
  std::string title;
  std::string reproduces;

  robot::Robot robot;
  std::optional<MachineStand> stand;  // in the robot's place, which is empty then
  std::vector<actuator::Actuator> actuators;
  std::vector<MachineValve> valves;
  double atmosphere = units::atmosphere;  // [Pa]

  std::vector<std::string> phases;    // in the file's order: the position is /plan/phase
  std::vector<std::string> sequence;  // of one step
  double period = 0.01;               // between samples [s]
  std::vector<Reported> reported;
  std::vector<MachineFault> faults;
};

// Reads a robot or, where there is an [element], a test stand. Throws config::Error with all
// mistakes in the keys that are read.
Machine read_machine(const config::Node& root);

// Positions in Machine::phases by what 5.4 calls them: `foot_plant` and `propulsion` are stance,
// `swing` is swing. Any other phase is neither.
bool is_stance(const Machine&, int phase);
bool is_swing(const Machine&, int phase);
std::string_view phase_name(const Machine&, int phase);  // empty outside the sequence
int find_phase(const Machine&, std::string_view name);   // -1: no such phase

// A foot at the end of two links: where the thesis's kinematics and [75] apply.
bool has_leg(const Machine&);

// A valve by its name; one without delays and power for an unknown one.
MachineValve valve_of(const Machine&, std::string_view valve);

// Share of a time with a muscle's valves shut, of their duties in it  [-], 6.3: 1 - (inlet +
// exhaust); 0 with a valve that never seals.
double passive(const Machine&, const robot::Muscle&, double inlet_duty, double exhaust_duty);

}  // namespace sinew::analysis
