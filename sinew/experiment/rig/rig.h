// experiment/rig/rig.h - what is run on the test stand: experiments/rig/*.toml.
//
// The element that is tried, what pulls it, how its air gets in, and what drives its valves.
#pragma once

#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/config/reader.h"
#include "sinew/config/reported.h"
#include "sinew/config/shown_units.h"
#include "sinew/experiment/fault.h"
#include "sinew/experiment/log_table.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/gas/valve.h"
#include "sinew/mechanism/slide/setup.h"
#include "sinew/robot/robot.h"

namespace sinew::rig {

// What hangs on the stand.
struct Element {
  struct Cylinder {
    double bore = 0;                      // above 0: an air cylinder in the muscle's place [m]
    double rod_diameter = 0, stroke = 0;  // [m]
    double dead_volume = 0;               // of the rod's side, with hoses [m^3]
  };

  std::string name = "bpa";    // in the log's topics
  std::string actuator;        // of files.actuator
  int count = 1;               // side by side
  double external_volume = 0;  // downstream of the valves [m^3]
  std::string inlet, exhaust;  // of files.valves; a 3-way valve stands at the inlet
  gas::Hose hose;
  gas::Leak leak;
  Cylinder cylinder;
};

// A constant, or points that take its place: weights are hung on at their instants, lengths, forces
// and pressures run straight from one to the next.
struct Load {
  plant::Load::Mode mode = plant::Load::Mode::hanging;
  double mass = 0, length = 0, force = 0;  // [kg] [m] [N]
  std::vector<plant::Point> weights, lengths, forces;
  double gravity = units::standard_gravity;  // hanging [m/s^2]
};
struct Charge {
  plant::Charge::Mode mode = plant::Charge::Mode::sealed;
  double pressure = 0;  // regulated: absolute [Pa]
  std::vector<plant::Point> pressures;
};

// What opens and shuts the valves: drive.h.
struct Drive {
  // Names the law: nothing; pulses of a duty; single pulses; by the model to a length; by a sensor
  // to a length.
  enum class Kind { none, pwm, pulses, feed_forward, feedback };
  // Names how the feedback answers an error: by full pulses beyond the dead band, or a duty by the
  // error.
  enum class Law { on_off, proportional };

  // One opening of a valve.
  struct Pulse {
    double at = 0, open = 0;  // [s]
    bool exhaust = false;
  };

  Kind kind = Kind::none;
  double period = 0.04;              // of the pulses, and of the law [s]
  double duty = 0;                   // pwm: of the inlet [-]
  std::vector<plant::Point> duties;  // pwm: from their instants on
  std::vector<Pulse> pulses;
  double desired = 0;                 // feed-forward, feedback: length [m]
  std::vector<plant::Point> lengths;  // the same over time
  double believed_load = 0;           // feed-forward: hangs on the element [N]
  Law law = Law::proportional;        // feedback
  std::string sensor;                 // feedback: of the length
  double dead_band = 0;               // feedback: error without a pulse [m]
  double gain = 0;                    // proportional: duty per error [1/m]
};

// Each duty on a stand of its own, all from the same start: settled length against duty.
struct Sweep {
  double from = 0, to = 0, step = 0;  // duties; step 0: no sweep [-]
};

// measured.csv: what somebody at the stand writes down.
struct Measured {
  double period = 0;  // between rows; 0: that of the log [s]
  double from = 0;    // the first [s]
};

// An experiment on the test stand.
struct Experiment {
  std::string path, name;  // of the file; without its ending
  std::string title, reproduces;
  int seed = 1;
  double duration = 0;       // [s]
  double step = 5e-4;        // between nodes, at most [s]
  double accuracy = 3.4e-7;  // of a swing, per radian of it, between nodes [-]

  Element element;
  Load load;
  Charge charge;
  double start_pressure = 0;  // absolute [Pa]
  double start_length = 0;    // 0: where the load hangs [m]
  double displacement = 0;    // [m]
  Drive drive;
  Sweep sweep;
  std::vector<plant::Transducer> sensors;
  std::vector<experiment::Fault> faults;  // of the air
  Measured measured;
  experiment::Log log{.period = 1e-3};
  config::PageTable page;
  std::vector<config::Reported> reported;

  std::vector<actuator::Actuator> actuators;
  std::vector<gas::Valve> valves;
  gas::Air air;
  gas::Supply supply;

  config::Origins origins;
  std::vector<config::Problem> warnings, unsourced;
};

// Reads the file and what it names, with --set overrides. Throws config::Error with all that is
// wrong.
Experiment load(const std::string& path, const std::vector<std::string>& sets = {});

// Loads the experiment from a tree that is composed already; `path` is for messages.
Experiment load(const config::Node& root, const std::string& path);

// The valve of that name; none: null.
const gas::Valve* find_valve(const Experiment& experiment, const std::string& name);

// Points as steps: each value holds from its instant on.
std::vector<plant::Point> steps_of(const std::vector<plant::Point>& points);

// The stand that it describes, in which nothing breaks (run/stand/faulty_setup.h).
plant::StandSetup setup_of(const Experiment& experiment);

// Every value in SI under the keys of its origins, and the same as a file that runs again.
config::Node values_in_si(Experiment experiment);
std::string resolved(const Experiment& experiment, const std::string& version);

}  // namespace sinew::rig
