// world/driven/driven_muscle.h - one muscle with its valves, hose and leak on a supply, moved by a
// loop outside of Sinew: another program's robot, simulator or controller.
//
//   air::DrivenMuscle m(muscle, air, supply, 0.08);      // 80 mm long, at the room's pressure
//   for (;;) {
//     m.inlet(now_open);
//     m.advance(1e-4, your_length());                    // 0.1 ms later it is so long
//     pull_with(m.tension());
//   }
//
// It is the world of a driven length (mechanism/driven/driven_length.h): within a step the length
// runs straight to where it will be. Valves move at their own instants, delays included, whatever
// the steps; hoses and what else is quicker go ahead of a step (air/quick_bodies.h), so that a loop
// may be as slow as 1 ms.
//
// State is one block, copied like bytes: two muscles of equal description go on alike from it.
// After it is made a muscle allocates nothing, and throws only for a command that its valves do not
// have.
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
  // Everything that its future depends on.
  using State = plant::DrivenWorld::State;

  // `length` at the start [m]; `pressure` of its air there, absolute [Pa]. Throws
  // std::invalid_argument for a length at which it has no room for air.
  DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply, double length,
               double pressure);
  DrivenMuscle(const Muscle& muscle, const gas::Air& air, const gas::Supply& supply, double length)
      : DrivenMuscle(muscle, air, supply, length, air.atmosphere) {}

  // Current of the valves' coils from now on. The inlet is also a 3-way valve's, which has no
  // other. Throw std::invalid_argument for a coil that the valves do not have.
  void inlet(bool on);
  void exhaust(bool on);

  // Set point of a regulator in the inlet's place from now on, 0 to 1 of its range. Throws
  // std::invalid_argument if the muscle has no such valve.
  void set_point(double share);

  // Lets `step` [s] pass, in which the muscle comes to be `length` [m] long.
  void advance(double step, double length) noexcept;

  // Force on both ends [N]: static and viscous; a tendon, so that it never pushes. A sensor between
  // the muscle and what it pulls sees up to friction() more where the muscle gives way, and less
  // where it pulls: who integrates decides whether it sticks.
  double tension() const noexcept { return state().first.air.tension[0]; }
  double friction() const noexcept {
    return state().first.air.friction_bound[0];
  }  // bound of the dry part [N]

  double pressure() const noexcept { return state().first.air.pressure[0]; }  // absolute [Pa]
  double length() const noexcept { return world_.motion().length; }           // [m]
  double time() const noexcept { return world_.time(); }                      // [s]

  // Air in the muscle, and what has passed its valves and leaks since the start [kg]. What it holds
  // and its hose holds together is air_mass().
  Account account() const noexcept { return world_.air().account(state().now.air, 0); }
  double air_mass() const noexcept { return world_.air_mass(); }

  // Returns whether its state is not finite any more. From then on it stands still.
  bool failed() const noexcept { return static_cast<bool>(world_.failure()); }

  // Returns its state, to be copied; and continues from one of a muscle of equal description.
  const State& state() const noexcept { return world_.state(); }
  void restore(const State& state) noexcept { world_.restore(state); }

 private:
  void command(int valve, bool on, std::uint16_t level) noexcept;

  gas::Valve::Kind kind_;  // of the inlet
  plant::DrivenWorld world_;
};

}  // namespace sinew::air
