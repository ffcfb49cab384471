// mechanism/driven/driven_length.h - a muscle with prescribed length: by a table, whose points are
// nodes, or by a caller from node to node. Between two nodes the length is linear.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/air/lanes.h"
#include "sinew/air/muscle.h"
#include "sinew/air/state.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/signals/port.h"
#include "sinew/signals/schedule.h"

namespace sinew::plant {

inline constexpr int driven_lanes = 4;  // a whole lane of air/lanes.h, for one muscle

// A muscle with its air, and its prescribed length.
struct DrivenSetup {
  air::Muscle muscle;
  gas::Air air;
  gas::Supply supply;
  signals::Schedule length;  // over time; after its last point the caller's rate applies [m]
  double pressure = 0;       // at the start, absolute [Pa]
  double step = 1e-3;        // between nodes [s]
};

// True values, available only in a simulation.
struct DrivenTruth {
  double length = 0, tension = 0, pressure = 0;  // [m], [N], absolute [Pa]
  air::Account air;
};

// Senses of a machine without transducers.
struct DrivenSenses {
  using Truth = DrivenTruth;
  // The sensor functions have no channels; truth() writes the true values at t [s].
  explicit DrivenSenses(const DrivenSetup&) {}
  std::size_t channels() const noexcept { return 0; }
  double quantity(const auto&, std::size_t, double) const noexcept { return 0; }
  std::uint16_t counts(std::size_t, double, signals::Tick) const noexcept { return 0; }
  void truth(auto& world, double t, Truth& out) const noexcept {
    const auto p = world.preview(t);
    out = {p.evaluation.ends.length[0], p.evaluation.air.tension[0], p.evaluation.air.pressure[0],
           world.air().account(p.state.air, 0)};
  }
};

class DrivenLength {
 public:
  static constexpr bool cuts_steps = false;
  using Scalar = double;
  using Setup = DrivenSetup;
  using Senses = DrivenSenses;
  using Ends = air::Ends<driven_lanes>;
  struct Motion {
    double length = 0, rate = 0;  // [m], [m/s]
  };
  struct Nothing {};  // no inertia, forces or friction
  using Acceleration = Nothing;
  using Arms = Nothing;
  using Pose = Nothing;
  using Load = Nothing;
  using Forces = Nothing;

  // Return the constants, the motion at the start, the time between nodes [s], and the first air.
  explicit DrivenLength(const Setup& setup) : length_(setup.length) {}
  const signals::Schedule& constants() const noexcept { return length_; }
  Motion start() const noexcept { return {length_.at(0), length_.piece(0).slope}; }
  double node_step(const Setup& setup) const noexcept { return setup.step; }
  template <class Air>
  Air make_air(const Setup& s) const {
    return Air(std::span(&s.muscle, 1), s.air, s.supply, {}, {}, s.step);
  }
  auto start_air(const auto& air, const Setup& s, const Ends& ends) const {
    return air.initial(s.pressure, ends.length, 0);
  }
  auto start_memory(const auto& air, const Setup& s, const Ends& ends) const {
    return air.memory_at_rest(s.pressure, ends.length);
  }
  // Returns the table's next point after t [s]; begin() sets the prescribed motion from a node on.
  double corner_after(double t) const noexcept { return length_.corner(t); }
  void begin(double t, Motion& m) const noexcept {
    if (length_.moves_until(t)) m = {length_.at(t), length_.piece(t).slope};
  }
  // sum() is finite if the motion is; route() writes the muscle's ends, move() a motion h [s]
  // later.
  double sum(const Motion& m) const noexcept { return m.length; }
  void route(double, const Motion& m, Ends& ends, Arms&) const noexcept {
    ends.length.of.fill(m.length);
    ends.rate.of.fill(m.rate);
    ends.travel = ends.travel_rate = 0;
  }
  void move(Motion& out, const Motion& from, double h, const Motion&,
            const Acceleration&) const noexcept {
    out = {from.length + h * from.rate, from.rate};
  }
  void extrapolate(Motion& m, double h, const Acceleration&) const noexcept {
    move(m, m, h, m, {});
  }
  void finish(Motion& now, double h, const Motion* const (&)[4],
              const Acceleration (&)[4]) const noexcept {
    move(now, now, h, now, {});
  }
  // These parts of a mechanism are empty here.
  Pose pose(double, const Motion&) const noexcept { return {}; }
  void load(const auto&...) const noexcept {}
  Nothing accelerate(const auto&...) const noexcept { return {}; }
  Nothing prepare(const auto&...) const noexcept { return {}; }
  Forces hold(double, const Forces&) const noexcept { return {}; }
  double trolley_bound(const Forces&, double last) const noexcept { return last; }

 private:
  signals::Schedule length_;
};

}  // namespace sinew::plant
