// mechanism/slide/setup.h - setup of a test stand, and its true values.
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

// Load of the stand.
struct Load {
  using Mode = robot::Stand::Load::Mode;

  Mode mode = Mode::hanging;
  Schedule mass;                             // hanging: M, above 0 [kg]
  Schedule force;                            // hanging: added to the weight, down > 0 [N]
  Schedule length;                           // driven: L [m]
  double gravity = units::standard_gravity;  // g [m/s^2]
};

// Source of the element's air.
struct Charge {
  using Mode = robot::Stand::Charge::Mode;

  Mode mode = Mode::sealed;
  Schedule pressure;  // regulated: absolute [Pa]
};

struct StandStart {
  double pressure = units::atmosphere;  // absolute, at `length` [Pa]
  double length = 0;                    // 0: equilibrium of the hanging load [m]
  double displacement = 0;              // hanging: added to it, with the same air, down > 0 [m]
};

// Setup of a stand.
struct StandSetup {
  air::Muscle muscle;                     // a bundle with its valves, hose and leak
  std::optional<air::Cylinder> cylinder;  // single-acting, instead of the muscle
  gas::Air air;
  gas::Supply supply;
  Load load;
  Charge charge;
  StandStart start;
  std::vector<air::AirFault> faults;    // faults of the air; not with a regulated pressure
  std::vector<Transducer> transducers;  // channels of the port, in order
  double step = 5e-4;                   // between nodes, at most [s]
  double accuracy = 3.4e-7;             // error of an oscillation per radian, between nodes [-]
  std::uint64_t seed = 1;               // seed of the transducers' noise
};

// Largest product of rate and step for a required accuracy: RK4's error per radian of an
// oscillation is the fourth power/120. The stability limit is far larger.
inline double longest_swing(double accuracy) {
  return std::fmin(std::sqrt(std::sqrt(120 * accuracy)), 1.0);
}
inline double longest_settling(double accuracy) {
  return std::fmin(3.75 * longest_swing(accuracy), 1.5);
}

// True values at one instant, available only in a simulation.
struct StandTruth {
  double length = 0, velocity = 0, acceleration = 0;  // L [m], [m/s], [m/s^2]
  double force = 0;                // on the load, with dry friction; negative where it pushes [N]
  double friction = 0;             // its dry part [N]
  bool sticks = false;             // dry friction holds the load
  double load = 0;                 // hanging: M [kg]
  double pressure = 0;             // absolute pressure of the element's air [Pa]
  double air = 0;                  // its mass [kg]
  double all_air = 0;              // in element, hose and tank [kg]
  double air_in = 0, air_out = 0;  // through the valves since the start [kg]
  double air_leaked = 0;           // since the start [kg]
  double inlet = 0, exhaust = 0;   // open shares of the valves' areas [-]
  double supply_pressure = 0, tank_pressure = 0;  // absolute [Pa]
};

}  // namespace sinew::plant
