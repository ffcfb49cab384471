// robot/stand.h - description of the test stand of one muscle: the tested element, its load, its
// air supply, and its transducers.
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
  // The tested element.
  struct Element {
    struct Cylinder {
      double bore = 0;                      // above 0: an air cylinder instead of the muscle [m]
      double rod_diameter = 0, stroke = 0;  // [m]
      double dead_volume = 0;               // rod's side, with hoses [m^3]
    };

    std::string name = "bpa";    // used in the log's topics
    std::string actuator;        // name in files.actuator
    int count = 1;               // in parallel
    double external_volume = 0;  // downstream of the valves [m^3]
    std::string inlet, exhaust;  // names in files.valves; a 3-way valve is the inlet
    gas::Hose hose;
    gas::Leak leak;
    Cylinder cylinder;
  };

  // A constant, or points that replace it: weights are added at their instants; lengths, forces and
  // pressures change linearly from one point to the next.
  struct Load {
    // hanging: a mass, figure 3-3; driven: another machine prescribes the length
    enum class Mode { hanging, driven };

    Mode mode = Mode::hanging;
    double mass = 0, length = 0, force = 0;  // [kg] [m] [N]
    std::vector<signals::Schedule::Point> weights, lengths, forces;
    double gravity = units::standard_gravity;  // hanging [m/s^2]
  };
  // Air supply of the element.
  struct Charge {
    // sealed: the air at the start stays inside; valves: those of the element; regulated: an ideal
    // regulator
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
