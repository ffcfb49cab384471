// mechanism/planar/setup.h - setup of a planar world, its true values, and the law of a joint's end
// stops.
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

// State of the machine at the start, and its blocked joints.
struct Start {
  std::vector<double> joint_angle;  // [rad]
  std::vector<bool> blocked;        // joints held at their start
  double trolley = 0;               // [m]
  double lift = 0;                  // body, from the cylinder's extended stop [m]
  double pressure = 0;              // pressure of every muscle, absolute [Pa]
};

struct Steps {
  double body = 1e-3;  // between nodes [s]
};

inline constexpr double blocked_bound = 1e9;  // dry friction of a held joint [N m]

// Returns the body step, or an integer fraction of it that suits the machine's fastest rate [1/s].
// RK4 is stable up to a product of 2.78; the margin is for terms that act together with the
// fastest, and for other poses. `elsewhere`: the fastest rate in any pose, if known.
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
  std::optional<air::Cylinder> cylinder;  // if one moves the body
  std::vector<air::AirFault> faults;      // faults of the air
  Start start;
  Steps steps;
  std::uint64_t seed = 1;  // seed of the sensors' noise
};

// A foot's ankle relative to its leg's first joint, and the ground's force on it.
struct FootTruth {
  double x = 0, y = 0;              // [m]
  double force_x = 0, force_y = 0;  // [N]
};

// True values at one instant, available only in a simulation.
struct Truth {
  double x = 0, x_rate = 0;                         // trolley [m], [m/s]
  std::array<double, most_joints> angle{}, rate{};  // joints [rad], [rad/s]
  std::array<double, most_joints> torque{};         // muscles' torques, without friction [N m]
  std::array<double, most_muscles> tension{}, pressure{}, length{}, mass{};  // [N] [Pa] [m] [kg]
  std::array<double, most_muscles> air_in{}, air_out{};                      // since the start [kg]
  std::array<FootTruth, robot::max_legs> foot{};                             // one per leg
  double roller_front = 0, roller_rear = 0;  // loads, below 0: lifted off [N]

  // Values of optional parts, 0 without them.
  std::array<double, robot::max_discs> disc_force{};  // ground on each disc, upwards [N]
  std::array<double, most_muscles> air_leaked{};      // since the start [kg]
  double supply_pressure = 0, tank_pressure = 0;      // absolute [Pa]
  double air_mass = 0;                                // in chambers, hoses and tank [kg]
  double air_past_tank = 0;        // delivered while a fault cut the line from its tank [kg]
  double lift = 0, lift_rate = 0;  // body [m], [m/s]
  std::array<double, 2> cylinder_pressure{};            // up, down; absolute [Pa]
  std::array<double, 2> cylinder_in{}, cylinder_out{};  // since the start [kg]
};

// End stops of a joint: a spring and a damper at either end.
//
//   tau = -(k_stop (theta - high) + c_stop theta')   beyond the highest angle, if it pushes back
//   tau =   k_stop (low - theta)  - c_stop theta'    below the lowest one, likewise

// End stop of a joint. S is a double or a pack. Without bounds the stop never acts.
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

  // Returns the torque, > 0 raises the angle [N m].
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
