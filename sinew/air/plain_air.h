// air/plain_air.h - the air of W machines that have only muscles between valves on a constant
// supply: the law of network.h with a pack in the place of each number, and the muscles one after
// the other. Each machine has the same bits as alone.
//
// Valves, commands and failures are handled by each machine's own network, whose valves supply the
// open shares until the next node. Rare operations of a lane (a power, the sealed stiffness) are
// also done by its own network.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/air/braid_law.h"
#include "sinew/air/lanes.h"
#include "sinew/air/network.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/power_series.h"
#include "sinew/units/pack.h"
#include "sinew/units/stages.h"

namespace sinew::air {

template <int Most, int W>
class PlainAir {
 public:
  using S = units::Pack<W>;
  using Mask = units::PackMask<W>;
  using Network = AirNetwork<Most>;
  using Lanes = air::Lanes<Most, S>;
  using Ends = air::Ends<Most, S>;

  struct State {
    Lanes mass, in, out;  // as AirState's [kg]
  };
  struct Shares {
    Lanes inlet, exhaust;  // open shares of the valves' areas [-]
  };
  using Valves = Shares;
  using Memory = Reference<Most, S>;
  // No muscle is integrated ahead of a step.
  struct QuickMasses {
    static constexpr std::uint64_t muscles = 0;
  };
  struct Evaluation : Pull<Most, S> {
    Lanes inflow, outflow;  // supply to muscle, muscle to atmosphere [kg/s]
  };

  // All networks must be plain (AirNetwork::stays_plain), have the same number of muscles and
  // outlive this object.
  explicit PlainAir(const std::array<const Network*, W>& each);

  // Returns the number of muscles of each machine.
  int muscles() const noexcept { return size_; }

  // State of one muscle of one machine shortly after its node.
  struct MusclePreview {
    double pressure, tension;  // [Pa], [N]
  };
  // Returns muscle i of the machine in a lane at h after its node by Heun's rule, as the preview of
  // world.h but for this muscle alone. Length and rate are those at that time.
  MusclePreview preview(int lane, int i, double length, double rate, double h, const State& state,
                        const Shares& shares, const Memory& memory,
                        const Evaluation& at_node) const noexcept;

  // Copies the open shares of one machine's valves.
  void set_shares(int lane, const AirValves<Most>& valves, Shares& shares) const noexcept;

  // Evaluates the laws of all machines.
  void evaluate(const S& t, const Ends& ends, const State& state, const Shares& shares,
                const Memory& memory, Evaluation& out, std::uint64_t ahead = 0) const noexcept;

  // Updates the references of the machines in `where` at their nodes, from the evaluation there.
  // Returns for each the first muscle whose density is not valid, or -1.
  std::array<int, W> update_memory(const Mask& where, const Evaluation& evaluation,
                                   Memory& memory) const noexcept;

  // The stages of RK4, as in AirNetwork: the masses at h along the rates of one evaluation, and the
  // state by the weighted mean of four. `h` is 0 in lanes that wait.
  void plan(const S&, const S&, const Ends&, const State&, const Shares&, const Memory&,
            QuickMasses&) const noexcept {}
  void move(State& out, const State& from, const S& h, const Evaluation& evaluation,
            const Shares& shares, const QuickMasses& quick_masses) const noexcept;
  void finish(State& state, const S& h, const Evaluation* const (&evaluations)[4],
              const Shares& shares, const QuickMasses& quick_masses) const noexcept;

 private:
  // A muscle and its two valves.
  template <class T>
  struct Cell {
    BraidConstants<T> braid;
    gas::FlowConstantsOf<T> inlet, exhaust;
  };
  // Values of one machine, or of all, that its muscles have in common.
  template <class T>
  struct SharedValues {
    gas::PowerSeriesOf<T> series;
    T atmosphere = 0, supply_y = 0;
  };
  // Inputs of a muscle's evaluation, and its results.
  template <class T>
  struct MuscleInput : BraidState<T> {
    T inlet, exhaust;
  };
  template <class T>
  struct MuscleOutput {
    BraidPull<T> pull;
    T drift, inflow, outflow;
  };

  // Evaluates one muscle. far(x, y) writes y of a density outside the series' range; finish(pull)
  // adds the friction that the lanes do not have.
  template <class T, class Far, class Finish>
  [[gnu::always_inline]] static MuscleOutput<T> evaluate_muscle(const SharedValues<T>& shared,
                                                                const Cell<T>& cell,
                                                                const MuscleInput<T>& at,
                                                                const Far& far,
                                                                const Finish& finish) {
    T x, y;
    const BraidPull<T> pull = braid_at<T>(cell.braid, at, shared.atmosphere, shared.series,
                                          gas::PowerSeries::reach, far, x, y);
    MuscleOutput<T> out{pull, x, 0, 0};
    finish(out.pull);
    flow(shared, cell, at, y, out);
    return out;
  }

  // If no machine both fills and empties this muscle, one flow evaluation serves all.
  template <class T>
  [[gnu::always_inline]] static void flow(const SharedValues<T>& shared, const Cell<T>& cell,
                                          const MuscleInput<T>& at, const T& y,
                                          MuscleOutput<T>& out) {
    const auto fills = at.inlet > 0.0, empties = at.exhaust > 0.0;
    const bool some_fill = units::any(fills), some_empty = units::any(empties);
    if (some_fill && some_empty && !units::any(fills & empties)) {
      const T size =
          units::select(fills, at.inlet, at.exhaust) *
          gas::flow_y(gas::select(fills, cell.inlet, cell.exhaust),
                      units::select(fills, shared.supply_y, y), units::select(fills, y, 1.0));
      out.inflow = units::select(fills, size, 0.0);
      out.outflow = units::select(empties, size, 0.0);
      return;
    }
    if (some_fill)
      out.inflow =
          units::select(fills, at.inlet * gas::flow_y(cell.inlet, shared.supply_y, y), 0.0);
    if (some_empty)
      out.outflow = units::select(empties, at.exhaust * gas::flow_y(cell.exhaust, y, 1.0), 0.0);
  }

  void far_roots(int i, const Mask& outside, const S& drift, const Memory& memory,
                 S& y) const noexcept;
  template <class T, class M>
  static void apply_sliding_friction(const M& loose, const T& rate, BraidPull<T>& pull);
  void finish_friction(int i, const Ends& ends, BraidPull<S>& pull) const noexcept;
  void finish_friction(int lane, int i, const MuscleInput<double>& at,
                       BraidPull<double>& pull) const noexcept;

  int size_ = 0;
  std::array<const Network*, W> each_;
  SharedValues<S> shared_;
  std::array<Cell<S>, Most> cells_;
  std::array<Mask, Most> sealed_, loose_;  // bounded by the sealed stiffness; does not stick
  // Values of each machine alone.
  std::array<SharedValues<double>, W> shared_of_each_;
  std::array<std::array<Cell<double>, Most>, W> alone_;
};

template <int Most, int W>
PlainAir<Most, W>::PlainAir(const std::array<const Network*, W>& each)
    : size_(each[0]->muscles()), each_(each) {
  std::array<Cell<double>, W> each_cell;
  S exponent;
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    shared_of_each_[k] = {each[k]->braids().series(), each[k]->atmosphere(), each[k]->supply_y()};
    exponent.set(lane, shared_of_each_[k].series.exponent());
    shared_.atmosphere.set(lane, shared_of_each_[k].atmosphere);
    shared_.supply_y.set(lane, shared_of_each_[k].supply_y);
  }
  shared_.series = gas::PowerSeriesOf<S>(exponent);

  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < W; ++k) {
      const int lane = static_cast<int>(k);
      const BraidLanes& laws = each[k]->braids();
      alone_[k][m] = {laws.constants(i), each[k]->flow(2 * i), each[k]->flow(2 * i + 1)};
      each_cell[k] = alone_[k][m];
      sealed_[m].set(lane, laws.bound_by_sealed(i));
      loose_[m].set(lane, !laws.sticks(i));
    }
    cells_[m] = units::side_by_side<Cell<S>>(each_cell);
  }
}

template <int Most, int W>
void PlainAir<Most, W>::set_shares(int lane, const AirValves<Most>& valves,
                                   Shares& shares) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const auto inlet = static_cast<std::size_t>(2 * i);
    shares.inlet[i].set(lane, valves[inlet].share);
    shares.exhaust[i].set(lane, valves[inlet + 1].share);
  }
}

template <int Most, int W>
void PlainAir<Most, W>::evaluate(const S&, const Ends& ends, const State& state,
                                 const Shares& shares, const Memory& memory, Evaluation& out,
                                 std::uint64_t) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    const MuscleInput<S> at{
        {ends.length[i], ends.rate[i], state.mass[i], memory.y[i], memory.inverse_sigma[i]},
        shares.inlet[i],
        shares.exhaust[i]};
    const auto far = [&](const Mask& outside, const S& x, S& y) {
      far_roots(i, outside, x, memory, y);
    };
    const auto finish = [&](BraidPull<S>& pull) {
      if (units::any(sealed_[m] | loose_[m])) finish_friction(i, ends, pull);
    };
    const MuscleOutput<S> result = evaluate_muscle<S>(shared_, cells_[m], at, far, finish);
    out.drift[i] = result.drift;
    out.pressure[i] = result.pull.pressure;
    out.tension[i] = result.pull.tension;
    out.clamped[i] = result.pull.clamped;
    out.friction_bound[i] = result.pull.friction_bound;
    out.inflow[i] = result.inflow;
    out.outflow[i] = result.outflow;
  }
}

template <int Most, int W>
auto PlainAir<Most, W>::preview(int lane, int i, double length, double rate, double h,
                                const State& state, const Shares& shares, const Memory& memory,
                                const Evaluation& at_node) const noexcept -> MusclePreview {
  const auto k = static_cast<std::size_t>(lane), m = static_cast<std::size_t>(i);
  const double mass = state.mass[i][lane];
  MuscleInput<double> at{{length, rate, mass, memory.y[i][lane], memory.inverse_sigma[i][lane]},
                         shares.inlet[i][lane],
                         shares.exhaust[i][lane]};
  const auto far = [&](bool, double x, double& y) {
    y = each_[k]->braids().exact_y((x + 1.0) / at.inverse_sigma);
  };
  const auto finish = [&](BraidPull<double>& pull) { finish_friction(lane, i, at, pull); };
  const auto evaluate_now = [&] {
    return evaluate_muscle<double>(shared_of_each_[k], alone_[k][m], at, far, finish);
  };
  if (at.inlet > 0 || at.exhaust > 0) {
    const double in = at_node.inflow[i][lane], out = at_node.outflow[i][lane], half = 0.5 * h;
    at.mass = mass + h * (in - out);
    const MuscleOutput<double> then = evaluate_now();
    at.mass = mass + (half * (in + then.inflow) - half * (out + then.outflow));
  }
  const MuscleOutput<double> result = evaluate_now();
  return {result.pull.pressure, result.pull.tension};
}

// Writes y of the machines whose density is outside the series' range.
template <int Most, int W>
void PlainAir<Most, W>::far_roots(int i, const Mask& outside, const S& drift, const Memory& memory,
                                  S& y) const noexcept {
  const S density = (drift + 1.0) / memory.inverse_sigma[i];
  for (int k = 0; k < W; ++k)
    if (outside[k]) y.set(k, each_[static_cast<std::size_t>(k)]->braids().exact_y(density[k]));
}

// Completes the friction for Loss::Scale::sealed, and with sign(v), [33] as printed, for
// actuators that do not stick.
template <int Most, int W>
void PlainAir<Most, W>::finish_friction(int i, const Ends& ends,
                                        BraidPull<S>& pull) const noexcept {
  const auto m = static_cast<std::size_t>(i);
  for (int k = 0; k < W; ++k)
    if (sealed_[m][k])
      pull.friction_bound.set(k, each_[static_cast<std::size_t>(k)]->braids().sealed_bound(
                                     i, ends.length[i][k], pull.pressure[k]));
  apply_sliding_friction(loose_[m], ends.rate[i], pull);
}

template <int Most, int W>
void PlainAir<Most, W>::finish_friction(int lane, int i, const MuscleInput<double>& at,
                                        BraidPull<double>& pull) const noexcept {
  const auto m = static_cast<std::size_t>(i);
  if (sealed_[m][lane])
    pull.friction_bound =
        each_[static_cast<std::size_t>(lane)]->braids().sealed_bound(i, at.length, pull.pressure);
  apply_sliding_friction(loose_[m][lane], at.rate, pull);
}

template <int Most, int W>
template <class T, class M>
void PlainAir<Most, W>::apply_sliding_friction(const M& loose, const T& rate, BraidPull<T>& pull) {
  const T friction = units::select(rate >= 0.0, pull.friction_bound, -pull.friction_bound);
  const T f = pull.tension + friction;
  pull.tension = units::select(loose, units::select(f > 0.0, f, 0.0), pull.tension);
  pull.clamped = units::select(loose, pull.clamped + friction, pull.clamped);
  pull.friction_bound = units::select(loose, 0.0, pull.friction_bound);
}

template <int Most, int W>
std::array<int, W> PlainAir<Most, W>::update_memory(const Mask& where, const Evaluation& evaluation,
                                                    Memory& memory) const noexcept {
  std::array<int, W> failed;
  failed.fill(-1);
  for (int i = 0; i < size_; ++i) {
    const S x = evaluation.drift[i];
    // A NaN is not near: it fails below.
    const Mask near = (x < gas::PowerSeries::rebase) & (x > -gas::PowerSeries::rebase);
    const Mask follows = where & !near;
    if (!units::any(follows)) continue;
    const S density = (x + 1.0) / memory.inverse_sigma[i], inverse = 1.0 / density;
    for (std::size_t k = 0; k < W; ++k) {
      const int lane = static_cast<int>(k);
      if (!follows[lane]) continue;
      if (!is_density(density[lane]) && failed[k] < 0) failed[k] = i;
      memory.y[i].set(lane, each_[k]->braids().exact_y(density[lane]));
    }
    memory.inverse_sigma[i] = units::select(follows, inverse, memory.inverse_sigma[i]);
  }
  return failed;
}

template <int Most, int W>
void PlainAir<Most, W>::move(State& out, const State& from, const S& h,
                             const Evaluation& evaluation, const Shares&,
                             const QuickMasses&) const noexcept {
  for (int i = 0; i < size_; ++i)
    out.mass[i] = from.mass[i] + h * (evaluation.inflow[i] - evaluation.outflow[i]);
}

template <int Most, int W>
void PlainAir<Most, W>::finish(State& state, const S& h, const Evaluation* const (&evaluations)[4],
                               const Shares&, const QuickMasses&) const noexcept {
  const units::StageMean mean(h);
  for (int i = 0; i < size_; ++i) {
    const S in = mean([&](int s) { return evaluations[s]->inflow[i]; });
    const S out = mean([&](int s) { return evaluations[s]->outflow[i]; });
    state.in[i] += in;
    state.out[i] += out;
    state.mass[i] += in - out;
  }
}

}  // namespace sinew::air
