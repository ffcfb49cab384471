// robot/stand.h - the test stand of one muscle, as a machine: the element that is tried, what pulls
// it, how its air gets in, and its transducers.
#pragma once

#include <string>
#include <vector>

#include "sinew/gas/hose.h"
#include "sinew/gas/leak.h"
#include "sinew/robot/transducer.h"
#include "sinew/signals/schedule.h"
#include "sinew/units/constants.h"

namespace sinew::robot {

struct Stand {
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

  // A constant, or points that take its place: weights are hung on at their instants, lengths,
  // forces and pressures run straight from one to the next.
  struct Load {
    // hanging: a mass, figure 3-3; driven: another machine prescribes the length
    enum class Mode { hanging, driven };

    Mode mode = Mode::hanging;
    double mass = 0, length = 0, force = 0;  // [kg] [m] [N]
    std::vector<signals::Schedule::Point> weights, lengths, forces;
    double gravity = units::standard_gravity;  // hanging [m/s^2]
  };
  // The way in which the air gets in.
  struct Charge {
    // sealed: what is in at the start stays; valves: those of the element; regulated: by a
    // regulator that nothing disturbs
    enum class Mode { sealed, valves, regulated };

    Mode mode = Mode::sealed;
    double pressure = 0;  // regulated: absolute [Pa]
    std::vector<signals::Schedule::Point> pressures;
  };

  Element element;
  Load load;
  Charge charge;
  std::vector<Transducer> sensors;
};

}  // namespace sinew::robot
