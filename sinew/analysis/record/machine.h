// analysis/record/machine.h - description of the machine of a log: its parts, the phases' names and
// the figures that the source reports of the run. It is read from the composed experiment, or from
// the resolved.toml next to a log.
//
// Only the keys that analysis needs are read; a file may have others.
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
#include "sinew/gas/valve.h"
#include "sinew/robot/robot.h"
#include "sinew/robot/stand.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

// Delays and coil of a valve.
struct MachineValve {
  std::string name;
  double opening = 0, closing = 0;  // time from the edge to half of the stroke; ideal: 0 [s]
  gas::Coil coil;
  gas::Valve::Kind kind = gas::Valve::Kind::two_way;

  double shut = 0;              // time from the opening edge until the shutter moves [s]
  double rated_switchings = 0;  // openings that it is made for; 0: not given [-]

  // Returns whether it shuts its muscle off; false for a 3-way valve, which joins the muscle to the
  // supply or to the room.
  bool seals() const { return kind != gas::Valve::Kind::three_way; }
};

// A test stand with the kind and the period of its drive.
struct MachineStand : robot::Stand {
  std::string drive = "none";  // kind of the drive
  double drive_period = 0.04;  // [s]
};

struct Machine {
  std::string title;
  std::string reproduces;

  robot::Robot robot;
  std::optional<MachineStand> stand;  // if it is given, `robot` is empty
  std::vector<actuator::Actuator> actuators;
  std::vector<MachineValve> valves;
  double atmosphere = units::atmosphere;  // [Pa]

  std::vector<std::string> phases;    // in the file's order: /plan/phase is the index
  std::vector<std::string> sequence;  // phases of one step
  double period = 0.01;               // between samples [s]
  std::vector<Reported> reported;
  std::vector<MachineFault> faults;
};

// Reads a robot or, where there is an [element], a test stand. Throws config::Error with all
// mistakes in the keys that are read.
Machine read_machine(const config::Node& root);

// Replaces actuators and valves by those of another description of the same machine.
void replace_parts(Machine&, const std::vector<actuator::Actuator>&,
                   const std::vector<gas::Valve>&);

// Return whether a phase, an index of Machine::phases, is stance or swing by its name in 5.4:
// `foot_plant` and `propulsion` are stance, `swing` is swing. Any other phase is neither.
bool is_stance(const Machine&, int phase);
bool is_swing(const Machine&, int phase);
std::string_view phase_name(const Machine&, int phase);  // empty outside the sequence
int find_phase(const Machine&, std::string_view name);   // -1: no such phase

// Returns whether the machine is a foot at the end of two links, for which the thesis's kinematics
// and [75] apply.
bool has_leg(const Machine&);

// Returns a valve by its name, or one without delays and power if the name is unknown.
MachineValve valve_of(const Machine&, std::string_view valve);

// Returns the share of the time in which both valves of a muscle are shut  [-], 6.3, from their
// duties: 1 - (inlet + exhaust); 0 with a valve that never seals.
double passive(const Machine&, const robot::Muscle&, double inlet_duty, double exhaust_duty);

}  // namespace sinew::analysis
