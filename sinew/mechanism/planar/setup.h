// mechanism/planar/setup.h - everything a planar world is made from, and the law of a joint's
// end stops.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sinew/air/cylinder.h"
#include "sinew/air/fault.h"
#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"
#include "sinew/units/pack.h"

namespace sinew::plant {

inline constexpr int most_joints = robot::max_joints, most_muscles = robot::max_muscles;

// Where the machine starts, and what holds it.
struct Start {
  std::vector<double> joint_angle;  // [rad]
  std::vector<bool> blocked;        // joints that are held where they start
  double trolley = 0;               // [m]
  double lift = 0;                  // of the body, from the cylinder's extended stop [m]
  double pressure = 0;              // of every muscle, absolute [Pa]
};

struct Steps {
  double body = 1e-3;  // between nodes [s]
};

inline constexpr double blocked_bound = 1e9;  // dry friction of a joint that is held [N m]

// The body step, or a whole part of it that suits the machine's fastest rate [1/s]: RK4 is stable
// up to a product of 2.78. What is left of it is for what acts together with the fastest, and for
// other poses; `elsewhere` is the fastest rate in any, if it is known.
inline double stable_step(double step, double rate, double elsewhere = 0) {
  constexpr double largest_product = 1.55, largest_elsewhere = 2.6;
  const double parts =
      std::fmax(rate * step / largest_product, elsewhere * step / largest_elsewhere);
  return parts > 1 ? step / std::ceil(parts) : step;
}

struct Setup {
  robot::Robot robot;
  std::vector<air::Muscle> muscles;  // in the order of robot.muscles
  gas::Air air;
  gas::Supply supply;
  std::optional<air::Cylinder> cylinder;  // one that moves
  std::vector<air::AirFault> faults;      // of its air
  Start start;
  Steps steps;
  std::uint64_t seed = 1;  // of the sensors' noise
};

// A foot's ankle from its leg's first joint, and the ground's force on it.
struct FootTruth {
  double x = 0, y = 0;              // [m]
  double force_x = 0, force_y = 0;  // [N]
};

// What only a simulation knows, at one instant.
struct Truth {
  double x = 0, x_rate = 0;                         // trolley [m], [m/s]
  std::array<double, most_joints> angle{}, rate{};  // joints [rad], [rad/s]
  std::array<double, most_joints> torque{};         // of the muscles, friction apart [N m]
  std::array<double, most_muscles> tension{}, pressure{}, length{}, mass{};  // [N] [Pa] [m] [kg]
  std::array<double, most_muscles> air_in{}, air_out{};                      // since the start [kg]
  std::array<FootTruth, robot::max_legs> foot{};                             // by leg
  double roller_front = 0, roller_rear = 0;  // loads, below 0: lifted off [N]

  // These belong to parts that not every machine has, and are 0 without them.
  std::array<double, robot::max_discs> disc_force{};  // of the ground on each disc, up [N]
  std::array<double, most_muscles> air_leaked{};      // since the start [kg]
  double supply_pressure = 0, tank_pressure = 0;      // absolute [Pa]
  double air_mass = 0;                                // in chambers, hoses and tank [kg]
  double air_past_tank = 0;  // from a line that a fault had cut from its tank, since the start [kg]
  double lift = 0, lift_rate = 0;                       // of the body [m], [m/s]
  std::array<double, 2> cylinder_pressure{};            // up, down; absolute [Pa]
  std::array<double, 2> cylinder_in{}, cylinder_out{};  // since the start [kg]
};

// What holds a joint within its range: a spring and a damper at either
// end.
//
//   tau = -(k_stop (theta - high) + c_stop theta')   beyond the highest angle, never pulling it on
//   tau =   k_stop (low - theta)  - c_stop theta'    below the lowest one, the same way round

// A joint's stop, of a double or of a pack; without bounds there is none.
template <class S>
struct JointStopOf {
  S low = -std::numeric_limits<double>::infinity();
  S high = std::numeric_limits<double>::infinity();  // [rad]
  S stiffness = 0, damping = 0;                      // [N m/rad], [N m s/rad]

  JointStopOf() = default;
  // Takes the stop of a robot's joint.
  explicit JointStopOf(const robot::Stop& stop) {
    if (!stop.present()) return;
    low = stop.range[0];
    high = stop.range[1];
    stiffness = stop.stiffness;
    damping = stop.damping;
  }

  // > 0 raises the angle  [N m].
  S torque(const S& angle, const S& rate) const noexcept {
    const auto above = angle > high, below = angle < low;
    if (!units::any(above | below)) return 0;
    const S down = stiffness * (angle - high) + damping * rate;
    const S up = stiffness * (low - angle) - damping * rate;
    return units::select(above, units::select(down > 0.0, -down, 0.0),
                         units::select(below & (up > 0.0), up, 0.0));
  }
};
using JointStop = JointStopOf<double>;

}  // namespace sinew::plant
