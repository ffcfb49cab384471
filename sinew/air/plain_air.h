// air/plain_air.h - the air of W machines that have only muscles between valves on a constant
// supply: the law of network.h with a pack in the place of each number, and the muscles one after
// the other. Each machine has the same bits as alone.
//
// Valves and commands are handled by each machine alone, whose valves supply the open shares until
// the next node. The friction of muscles that is bounded by their sealed stiffness is computed by
// each machine's own network; one machine alone (W = 1) cannot have such muscles, and has no
// pointer: it is copied as bytes.
//
// An evaluation has three loops over the muscles (y, pulls, flows): each is short, so that the
// processor overlaps the divisions and roots of several muscles.
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

// The networks of machines with muscles whose friction is bounded by their sealed stiffness.
template <int Most, int W>
struct SealedBounds {
  std::array<const AirNetwork<Most>*, W> each;

  // Returns the bound of muscle i of the machine in a lane [N].
  double operator()(int lane, int i, double length, double pressure) const noexcept {
    return each[static_cast<std::size_t>(lane)]->braids().sealed_bound(i, length, pressure);
  }
};
template <int Most>
struct SealedBounds<Most, 1> {
  std::array<const AirNetwork<Most>*, 0> each = {};
  // A single machine has no such muscles.
  constexpr explicit SealedBounds(const std::array<const AirNetwork<Most>*, 1>&) {}
  constexpr double operator()(int, int, double, double) const noexcept { return 0; }
};

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
    // For each muscle, the law of each machine's open valve, if only one is open, and, a bit each,
    // the machines that fill or empty it. Set by set_shares().
    std::array<gas::FlowConstantsOf<S>, Most> open;
    std::array<std::uint32_t, Most> fills, empties;
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

  // All networks must be plain (AirNetwork::stays_plain) and have the same number of muscles.
  // Several must outlive this object; a single one may not have such
  // muscles.
  explicit PlainAir(const std::array<const Network*, W>& each);

  // Returns the number of muscles of each machine.
  int muscles() const noexcept { return size_; }

  // State of one muscle of one machine shortly after its node, and the masses that have passed its
  // valves since the start.
  struct MusclePreview {
    double pressure, tension;  // [Pa], [N]
    double mass, in, out;      // [kg]
  };
  // Returns muscle i of the machine in a lane at h after its node by Heun's rule, as the preview of
  // world.h but for this muscle alone. Length and rate are those at that time.
  MusclePreview preview(int lane, int i, double length, double rate, double h, const State& state,
                        const Shares& shares, const Memory& memory,
                        const Evaluation& at_node) const noexcept;

  // Copy the open shares of one machine's valves: of all its muscles, of those whose shares differ,
  // or of one muscle.
  void set_shares(int lane, const AirValves<Most>& valves, Shares& shares) const noexcept;
  void update_shares(int lane, const AirValves<Most>& valves, Shares& shares) const noexcept;
  void set_shares(int lane, int muscle, double inlet, double exhaust,
                  Shares& shares) const noexcept;

  // Evaluates the laws of all machines. The second one is for stages of a step and writes only
  // tensions and flows.
  void evaluate(const S&, const Ends& ends, const State& state, const Shares& shares,
                const Memory& memory, Evaluation& out, std::uint64_t = 0) const noexcept {
    evaluate_muscles<true>(ends, state, shares, memory, out);
  }
  void evaluate_stage(const Ends& ends, const State& state, const Shares& shares,
                      const Memory& memory, Evaluation& out) const noexcept {
    evaluate_muscles<false>(ends, state, shares, memory, out);
  }

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
  struct Flows {
    S in = 0, out = 0;  // [kg/s]
  };

  static Mask beyond_series(const S& x) {
    return (x > gas::PowerSeries::reach) | (x < -gas::PowerSeries::reach);
  }
  template <bool whole>
  void evaluate_muscles(const Ends& ends, const State& state, const Shares& shares,
                        const Memory& memory, Evaluation& out) const noexcept;
  Flows flows(int i, const Shares& shares, const S& y) const noexcept;
  double root(int lane, int i, const BraidState<double>& at) const noexcept;
  void far_roots(const S& x, const S& inverse_sigma, S& y) const noexcept;
  void finish_friction(int i, const S& length, const S& rate, BraidPull<S>& pull) const noexcept;
  // Returns y of a density of the machine in a lane.
  double exact_y(std::size_t lane, double density) const noexcept {
    const Alone& of = alone_[lane];
    return exact_root(density, of.inverse_reference_density, of.series.exponent());
  }
  template <class T, class M>
  static void apply_sliding_friction(const M& loose, const T& rate, BraidPull<T>& pull);

  int size_ = 0;
  SealedBounds<Most, W> sealed_bound_;
  // Values that the muscles of a machine have in common.
  gas::PowerSeriesOf<S> series_;
  S atmosphere_ = 0, supply_y_ = 0;
  std::array<Cell<S>, Most> cells_;
  std::array<Mask, Most> sealed_, loose_;    // bounded by the sealed stiffness; does not stick
  std::array<bool, Most> is_rare_friction_;  // either of them, for any machine
  // The constants of each machine alone.
  struct Alone {
    gas::PowerSeries series;
    double atmosphere, supply_y, inverse_reference_density;  // [Pa], [-], [m^3/kg]
    std::array<Cell<double>, Most> cell;
  };
  std::array<Alone, W> alone_;
};

template <int Most, int W>
PlainAir<Most, W>::PlainAir(const std::array<const Network*, W>& each)
    : size_(each[0]->muscles()), sealed_bound_{each} {
  std::array<Cell<double>, W> each_cell;
  S exponent;
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    exponent.set(lane, each[k]->braids().series().exponent());
    atmosphere_.set(lane, each[k]->atmosphere());
    supply_y_.set(lane, each[k]->supply_y());
    alone_[k] = {.series = each[k]->braids().series(),
                 .atmosphere = each[k]->atmosphere(),
                 .supply_y = each[k]->supply_y(),
                 .inverse_reference_density = each[k]->braids().inverse_reference_density(),
                 .cell = {}};
  }
  series_ = gas::PowerSeriesOf<S>(exponent);

  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < W; ++k) {
      const int lane = static_cast<int>(k);
      const BraidLanes& laws = each[k]->braids();
      each_cell[k] = {laws.constants(i), each[k]->flow(2 * i), each[k]->flow(2 * i + 1)};
      alone_[k].cell[m] = each_cell[k];
      sealed_[m].set(lane, laws.bound_by_sealed(i));
      loose_[m].set(lane, !laws.sticks(i));
    }
    is_rare_friction_[m] = units::any(sealed_[m] | loose_[m]);
    cells_[m] = units::side_by_side<Cell<S>>(each_cell);
  }
}

template <int Most, int W>
void PlainAir<Most, W>::set_shares(int lane, const AirValves<Most>& valves,
                                   Shares& shares) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const auto inlet = static_cast<std::size_t>(2 * i);
    set_shares(lane, i, valves[inlet].share, valves[inlet + 1].share, shares);
  }
}

template <int Most, int W>
void PlainAir<Most, W>::update_shares(int lane, const AirValves<Most>& valves,
                                      Shares& shares) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const auto v = static_cast<std::size_t>(2 * i);
    const double inlet = valves[v].share, exhaust = valves[v + 1].share;
    if (inlet != shares.inlet.of[v / 2][lane] || exhaust != shares.exhaust.of[v / 2][lane])
      set_shares(lane, i, inlet, exhaust, shares);
  }
}

template <int Most, int W>
void PlainAir<Most, W>::set_shares(int lane, int muscle, double inlet, double exhaust,
                                   Shares& shares) const noexcept {
  const auto m = static_cast<std::size_t>(muscle);
  const std::uint32_t bit = 1u << lane;
  shares.inlet[muscle].set(lane, inlet);
  shares.exhaust[muscle].set(lane, exhaust);
  shares.fills[m] = inlet > 0 ? shares.fills[m] | bit : shares.fills[m] & ~bit;
  shares.empties[m] = exhaust > 0 ? shares.empties[m] | bit : shares.empties[m] & ~bit;
  const Cell<double>& cell = alone_[static_cast<std::size_t>(lane)].cell[m];
  units::put_lane(inlet > 0 ? cell.inlet : cell.exhaust, lane, shares.open[m]);
}

template <int Most, int W>
template <bool whole>
void PlainAir<Most, W>::evaluate_muscles(const Ends& ends, const State& state, const Shares& shares,
                                         const Memory& memory, Evaluation& out) const noexcept {
  std::array<S, Most> x, y;
  Mask outside = S(0.0) > 0.0;
  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    const BraidState<S> at{ends.length[i], ends.rate[i], state.mass[i], memory.y[i],
                           memory.inverse_sigma[i]};
    braid_root(cells_[m].braid, at, series_, x[m], y[m]);
    outside = outside | beyond_series(x[m]);
  }
  if (units::any(outside))
    for (int i = 0; i < size_; ++i) {
      const auto m = static_cast<std::size_t>(i);
      far_roots(x[m], memory.inverse_sigma[i], y[m]);
    }

  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    const S length = ends.length[i], rate = ends.rate[i];
    BraidPull<S> pull = braid_pull(cells_[m].braid, atmosphere_, length, rate, y[m]);
    if (is_rare_friction_[m]) finish_friction(i, length, rate, pull);
    out.tension[i] = pull.tension;
    if constexpr (whole) {
      out.drift[i] = x[m];
      out.pressure[i] = pull.pressure;
      out.clamped[i] = pull.clamped;
      out.friction_bound[i] = pull.friction_bound;
    }
  }

  for (int i = 0; i < size_; ++i) {
    const Flows flow = flows(i, shares, y[static_cast<std::size_t>(i)]);
    out.inflow[i] = flow.in;
    out.outflow[i] = flow.out;
  }
}

// Returns the flows of a muscle. If no machine both fills and empties it, one evaluation serves
// all.
template <int Most, int W>
auto PlainAir<Most, W>::flows(int i, const Shares& shares, const S& y) const noexcept -> Flows {
  const auto m = static_cast<std::size_t>(i);
  const std::uint32_t some_fill = shares.fills[m], some_empty = shares.empties[m];
  Flows out;
  if ((some_fill | some_empty) == 0) return out;
  const S inlet = shares.inlet[i], exhaust = shares.exhaust[i];
  const Mask fills = inlet > 0.0, empties = exhaust > 0.0;
  if ((some_fill & some_empty) == 0) {
    const S size = units::select(fills, inlet, exhaust) *
                   gas::flow_y(shares.open[m], units::select(fills, supply_y_, y),
                               units::select(fills, y, 1.0));
    out.in = units::select(fills, size, 0.0);
    out.out = units::select(empties, size, 0.0);
    return out;
  }
  const Cell<S>& cell = cells_[m];
  out.in = units::select(fills, inlet * gas::flow_y(cell.inlet, supply_y_, y), 0.0);
  out.out = units::select(empties, exhaust * gas::flow_y(cell.exhaust, y, 1.0), 0.0);
  return out;
}

// Returns y of the muscle of one machine.
template <int Most, int W>
double PlainAir<Most, W>::root(int lane, int i, const BraidState<double>& at) const noexcept {
  const auto k = static_cast<std::size_t>(lane), m = static_cast<std::size_t>(i);
  double x, y;
  braid_root(alone_[k].cell[m].braid, at, alone_[k].series, x, y);
  const bool outside = x > gas::PowerSeries::reach || x < -gas::PowerSeries::reach;
  return outside ? exact_y(k, (x + 1.0) / at.inverse_sigma) : y;
}

template <int Most, int W>
auto PlainAir<Most, W>::preview(int lane, int i, double length, double rate, double h,
                                const State& state, const Shares& shares, const Memory& memory,
                                const Evaluation& at_node) const noexcept -> MusclePreview {
  const auto k = static_cast<std::size_t>(lane), m = static_cast<std::size_t>(i);
  const Alone& alone = alone_[k];
  const Cell<double>& cell = alone.cell[m];
  double in_total = state.in[i][lane], out_total = state.out[i][lane];
  BraidState<double> at{length, rate, state.mass[i][lane], memory.y[i][lane],
                        memory.inverse_sigma[i][lane]};
  const double inlet = shares.inlet[i][lane], exhaust = shares.exhaust[i][lane];
  if (inlet > 0 || exhaust > 0) {
    const double mass = at.mass, half = 0.5 * h;
    const double in = at_node.inflow[i][lane], out = at_node.outflow[i][lane];
    at.mass = mass + h * (in - out);
    const double y = root(lane, i, at);
    const double then_in = inlet > 0 ? inlet * gas::flow_y(cell.inlet, alone.supply_y, y) : 0.0;
    const double then_out = exhaust > 0 ? exhaust * gas::flow_y(cell.exhaust, y, 1.0) : 0.0;
    const double came = half * (in + then_in), went = half * (out + then_out);
    at.mass = mass + (came - went);
    in_total += came;
    out_total += went;
  }
  BraidPull<double> pull =
      braid_pull(cell.braid, alone.atmosphere, length, rate, root(lane, i, at));
  if (sealed_[m][lane]) pull.friction_bound = sealed_bound_(lane, i, length, pull.pressure);
  apply_sliding_friction(loose_[m][lane], rate, pull);
  return {pull.pressure, pull.tension, at.mass, in_total, out_total};
}

// Writes y of the machines whose density is outside the series' range.
template <int Most, int W>
void PlainAir<Most, W>::far_roots(const S& x, const S& inverse_sigma, S& y) const noexcept {
  const Mask outside = beyond_series(x);
  if (!units::any(outside)) return;
  const S density = (x + 1.0) / inverse_sigma;
  for (int k = 0; k < W; ++k)
    if (outside[k]) y.set(k, exact_y(static_cast<std::size_t>(k), density[k]));
}

// Completes the friction for Loss::Scale::sealed, and with sign(v), [33] as printed, for
// actuators that do not stick.
template <int Most, int W>
void PlainAir<Most, W>::finish_friction(int i, const S& length, const S& rate,
                                        BraidPull<S>& pull) const noexcept {
  const auto m = static_cast<std::size_t>(i);
  for (int k = 0; k < W; ++k)
    if (sealed_[m][k]) pull.friction_bound.set(k, sealed_bound_(k, i, length[k], pull.pressure[k]));
  apply_sliding_friction(loose_[m], rate, pull);
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
      memory.y[i].set(lane, exact_y(k, density[lane]));
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
