// mechanism/slide/setup.h - everything that a test stand is made from, and what it knows of itself.
//
//   plant::StandSetup s;
//   s.muscle.actuator = actuator::thesis_actuator();
//   s.muscle.external_volume = 1.868e-6;
//   s.load.mass = 2.7216;                        // 6 lb
//   s.start = {.pressure = 515038, .displacement = 0.00508};
//   plant::Stand stand(s);
//   for (double t = 0; t < 4; t += 1e-3) use(stand.truth(t));
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "sinew/air/cylinder.h"
#include "sinew/air/fault.h"
#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/robot/stand.h"
#include "sinew/robot/transducer.h"
#include "sinew/signals/schedule.h"
#include "sinew/units/constants.h"

namespace sinew::plant {

using robot::Transducer;
using signals::Schedule;

// What pulls back.
struct Load {
  using Mode = robot::Stand::Load::Mode;

  Mode mode = Mode::hanging;
  Schedule mass;                             // hanging: M, above 0 [kg]
  Schedule force;                            // hanging: on the mass beside its weight, down > 0 [N]
  Schedule length;                           // driven: L [m]
  double gravity = units::standard_gravity;  // g [m/s^2]
};

// How its air gets in.
struct Charge {
  using Mode = robot::Stand::Charge::Mode;

  Mode mode = Mode::sealed;
  Schedule pressure;  // regulated: absolute [Pa]
};

struct StandStart {
  double pressure = units::atmosphere;  // absolute, at `length` [Pa]
  double length = 0;                    // 0: where the load hangs in equilibrium [m]
  double displacement = 0;              // hanging: from there, with the same air, down > 0 [m]
};

// Everything that a stand is made from.
struct StandSetup {
  air::Muscle muscle;                     // a bundle with its valves, hose and leak
  std::optional<air::Cylinder> cylinder;  // single-acting, in the muscle's place
  gas::Air air;
  gas::Supply supply;
  Load load;
  Charge charge;
  StandStart start;
  std::vector<air::AirFault> faults;    // of its air; none that opens a prescribed pressure
  std::vector<Transducer> transducers;  // the channels of the port, in their order
  double step = 5e-4;                   // between nodes, at most [s]
  double accuracy = 3.4e-7;             // of a swing, per radian of it, between nodes [-]
  std::uint64_t seed = 1;               // of the transducers' noise
};

// Rates times the length of a piece, by the accuracy that is asked for: RK4's error per radian of a
// swing is the fourth power/120. Its limit of stability is far off.
inline double longest_swing(double accuracy) {
  return std::fmin(std::sqrt(std::sqrt(120 * accuracy)), 1.0);
}
inline double longest_settling(double accuracy) {
  return std::fmin(3.75 * longest_swing(accuracy), 1.5);
}

// What only a simulation knows, at one instant.
struct StandTruth {
  double length = 0, velocity = 0, acceleration = 0;  // L [m], [m/s], [m/s^2]
  double force = 0;                // on the load, dry friction in it; negative where it pushes [N]
  double friction = 0;             // the dry part of it [N]
  bool sticks = false;             // dry friction holds the load
  double load = 0;                 // hanging: M [kg]
  double pressure = 0;             // of the air in the element, absolute [Pa]
  double air = 0;                  // its mass [kg]
  double all_air = 0;              // in element, hose and tank [kg]
  double air_in = 0, air_out = 0;  // through the valves since the start [kg]
  double air_leaked = 0;           // since the start [kg]
  double inlet = 0, exhaust = 0;   // open shares of the valves' areas [-]
  double supply_pressure = 0, tank_pressure = 0;  // absolute [Pa]
};

}  // namespace sinew::plant
