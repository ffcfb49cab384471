// world/driven/driven_muscle.h - one muscle with its valves, hose and leak on a supply, for the
// loop of another program: a robot, simulator or controller.
//
//   air::DrivenMuscle m(muscle, air, supply, 0.08);      // 80 mm long, at the room's pressure
//   for (;;) {
//     m.inlet(now_open);
//     m.advance(1e-4, your_length());                    // reaches this length 0.1 ms later
//     pull_with(m.tension());
//   }
//
// It is the world of a driven length (mechanism/driven/driven_length.h): within a step the length
// changes linearly to its new value. Valves switch at their own instants, delays included, whatever
// the steps; hoses and other quick parts are integrated ahead of a step (air/quick_bodies.h), so
// steps of up to 1 ms are possible.
//
// State is one trivially copyable block: two muscles of equal description continue equally from it.
// After construction a muscle allocates nothing, and throws only for a command that its valves do
// not support.
#pragma once

#include "sinew/air/muscle.h"
#include "sinew/air/network.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/mechanism/driven/driven_length.h"
#include "sinew/world/kernel/world.h"

namespace sinew::plant {

using DrivenWorld = World<DrivenLength, air::AirNetwork<driven_lanes>>;
extern template class World<DrivenLength, air::AirNetwork<driven_lanes>>;

}  // namespace sinew::plant

namespace sinew::air {

class DrivenMuscle {
 public:
  // The complete state.
  using State = plant::DrivenWorld::State;

  // Takes the length [m] and the absolute pressure [Pa] at the start; without a pressure, that of
  // the room. Throws std::invalid_argument for a length at which the muscle has no volume for air.
  DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply, double length,
               double pressure);
  DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply, double length)
      : DrivenMuscle(muscle, air, supply, length, air.atmosphere) {}

  // Switch the current of the valves' coils. A 3-way valve has one coil, which inlet() switches.
  // Throw std::invalid_argument for a coil that the valves do not have.
  void inlet(bool on);
  void exhaust(bool on);

  // Sets the set point of a regulator at the inlet, 0 to 1 of its range. Throws
  // std::invalid_argument if the muscle has no regulator.
  void set_point(double share);

  // Advances by `step` [s], at the end of which the muscle is `length` [m] long.
  void advance(double step, double length) noexcept;

  // Returns the force on both ends [N]: static and viscous; never negative, since a tendon cannot
  // push. Dry friction is not in it.
  double tension() const noexcept { return state().first.air.tension[0]; }
  // Returns the largest dry friction [N]. A sensor between the muscle and its load measures up to
  // this more than tension() while the muscle lengthens, and up to this less while it shortens. The
  // caller's model decides whether the muscle sticks.
  double friction() const noexcept { return state().first.air.friction_bound[0]; }

  double pressure() const noexcept { return state().first.air.pressure[0]; }  // absolute [Pa]
  double length() const noexcept { return world_.motion().length; }           // [m]
  double time() const noexcept { return world_.time(); }                      // [s]

  // Return the air in the muscle with the masses that have passed its valves and leaks since the
  // start [kg], and the air in muscle and hose.
  Account account() const noexcept { return world_.air().account(state().now.air, 0); }
  double air_mass() const noexcept { return world_.air_mass(); }

  // Returns whether the state has become infinite or NaN; it then no longer changes.
  bool failed() const noexcept { return static_cast<bool>(world_.failure()); }

  // Return the state for copying, and continue from that of a muscle of equal description.
  const State& state() const noexcept { return world_.state(); }
  void restore(const State& state) noexcept { world_.restore(state); }

 private:
  void command(int valve, bool on, std::uint16_t level) noexcept;

  gas::Valve::Kind kind_;  // inlet's kind
  plant::DrivenWorld world_;
};

}  // namespace sinew::air
