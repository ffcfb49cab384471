// air/packs/plain_air.h - the air of W machines side by side that have nothing but muscles between
// valves on a constant supply: network.h's law with a pack in the place of each number, and the
// muscles one after the other. Each machine has the bits that it has alone.
//
// Valves, commands and failures are each network's own affair: from its valves come the shares that
// are open until its next node. What a lane seldom needs (a power, the sealed stiffness) its own
// network answers.
#pragma once

#include <array>
#include <cstddef>

#include "sinew/air/braid_law.h"
#include "sinew/air/lanes.h"
#include "sinew/air/network.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/power_series.h"
#include "sinew/units/pack.h"

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
    Lanes inlet, exhaust;  // of the valves' areas that are open [-]
  };
  using Memory = Reference<Most, S>;
  struct Answer : Pull<Most, S> {
    Lanes inflow, outflow;  // from the supply, to the atmosphere [kg/s]
  };

  // All of them plain for good (AirNetwork::plain_for_good), with as many muscles; they are to live
  // on.
  explicit PlainAir(const std::array<const Network*, W>& each);

  int muscles() const noexcept { return size_; }

  // Takes over what one machine's valves let through.
  void set_shares(int lane, const AirValves<Most>& valves, Shares& shares) const noexcept;

  void evaluate(const Ends& ends, const State& state, const Shares& shares, const Memory& memory,
                Answer& out) const noexcept;

  // At a node of the machines in `where`, with the look at it: their references follow. Answers
  // each one's first muscle whose density is none, or -1.
  std::array<int, W> remember(const Mask& where, const Answer& look, Memory& memory) const noexcept;

  // The stages of RK4, as AirNetwork's: the masses h along one look's rates; the state, by the
  // weighted mean of four. `h` is nothing in lanes that wait.
  void move(State& out, const State& from, const S& h, const Answer& look) const noexcept;
  void finish(State& state, const S& h, const Answer* const (&look)[4]) const noexcept;

 private:
  struct Cell {
    BraidConstants<S> braid;
    gas::FlowConstantsOf<S> inlet, exhaust;
    Mask sealed, loose;  // bound by the sealed stiffness; it does not stick
  };

  void far_roots(int i, const Mask& outside, const S& drift, const Memory& memory,
                 S& y) const noexcept;
  void finish_friction(int i, const Ends& ends, BraidPull<S>& pull) const noexcept;

  int size_ = 0;
  std::array<const Network*, W> each_;
  std::array<Cell, Most> cells_;
  gas::PowerSeriesOf<S> series_;
  S atmosphere_ = 0, supply_y_ = 0;
};

template <int Most, int W>
PlainAir<Most, W>::PlainAir(const std::array<const Network*, W>& each)
    : size_(each[0]->muscles()), each_(each) {
  S exponent;
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    exponent.set(lane, each[k]->braids().series().exponent());
    atmosphere_.set(lane, each[k]->atmosphere());
    supply_y_.set(lane, each[k]->supply_y());
  }
  series_ = gas::PowerSeriesOf<S>(exponent);

  std::array<BraidConstants<double>, W> braids;
  std::array<gas::FlowConstants, W> inlets, exhausts;
  for (int i = 0; i < size_; ++i) {
    Cell& cell = cells_[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < W; ++k) {
      const int lane = static_cast<int>(k);
      const BraidLanes& laws = each[k]->braids();
      braids[k] = laws.constants(i);
      inlets[k] = each[k]->flow(2 * i);
      exhausts[k] = each[k]->flow(2 * i + 1);
      cell.sealed.set(lane, laws.bound_by_sealed(i));
      cell.loose.set(lane, !laws.sticks(i));
    }
    cell.braid = units::side_by_side<BraidConstants<S>>(braids);
    cell.inlet = units::side_by_side<gas::FlowConstantsOf<S>>(inlets);
    cell.exhaust = units::side_by_side<gas::FlowConstantsOf<S>>(exhausts);
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
void PlainAir<Most, W>::evaluate(const Ends& ends, const State& state, const Shares& shares,
                                 const Memory& memory, Answer& out) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const Cell& cell = cells_[static_cast<std::size_t>(i)];
    // Density against the reference, and y by the series.
    const S volume = braid_volume(cell.braid, ends.length[i]);
    const S x = (state.mass[i] * memory.inverse_sigma[i]) / volume - 1.0;
    S power, y;
    series_.raise(x, power);
    y = memory.y[i] * power;
    const Mask outside = (x > gas::PowerSeries::reach) | (x < -gas::PowerSeries::reach);
    if (units::any(outside)) far_roots(i, outside, x, memory, y);

    BraidPull<S> pull = braid_pull(cell.braid, atmosphere_, ends.length[i], ends.rate[i], y);
    if (units::any(cell.sealed | cell.loose)) finish_friction(i, ends, pull);
    out.drift[i] = x;
    out.pressure[i] = pull.pressure;
    out.tension[i] = pull.tension;
    out.clamped[i] = pull.clamped;
    out.friction_bound[i] = pull.friction_bound;

    out.inflow[i] = out.outflow[i] = 0;
    const S in = shares.inlet[i], gone = shares.exhaust[i];
    if (const Mask open = in > 0.0; units::any(open))
      out.inflow[i] = units::select(open, in * gas::flow_y(cell.inlet, supply_y_, y), 0.0);
    if (const Mask open = gone > 0.0; units::any(open))
      out.outflow[i] = units::select(open, gone * gas::flow_y(cell.exhaust, y, 1.0), 0.0);
  }
}

// Beyond the reach of the series.
template <int Most, int W>
void PlainAir<Most, W>::far_roots(int i, const Mask& outside, const S& drift, const Memory& memory,
                                  S& y) const noexcept {
  const S density = (drift + 1.0) / memory.inverse_sigma[i];
  for (int k = 0; k < W; ++k)
    if (outside[k]) y.set(k, each_[static_cast<std::size_t>(k)]->braids().exact_y(density[k]));
}

// Loss::Scale::sealed; and [33] as printed, sign(v), for actuators that do not stick.
template <int Most, int W>
void PlainAir<Most, W>::finish_friction(int i, const Ends& ends,
                                        BraidPull<S>& pull) const noexcept {
  const Cell& cell = cells_[static_cast<std::size_t>(i)];
  for (int k = 0; k < W; ++k)
    if (cell.sealed[k])
      pull.friction_bound.set(k, each_[static_cast<std::size_t>(k)]->braids().sealed_bound(
                                     i, ends.length[i][k], pull.pressure[k]));
  const S rub = units::select(ends.rate[i] >= 0.0, pull.friction_bound, -pull.friction_bound);
  const S f = pull.tension + rub;
  pull.tension = units::select(cell.loose, units::select(f > 0.0, f, 0.0), pull.tension);
  pull.clamped = units::select(cell.loose, pull.clamped + rub, pull.clamped);
  pull.friction_bound = units::select(cell.loose, 0.0, pull.friction_bound);
}

template <int Most, int W>
std::array<int, W> PlainAir<Most, W>::remember(const Mask& where, const Answer& look,
                                               Memory& memory) const noexcept {
  std::array<int, W> failed;
  failed.fill(-1);
  for (int i = 0; i < size_; ++i) {
    const S x = look.drift[i];
    // A drift that is no number is not near: it goes on, and fails below.
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
                             const Answer& look) const noexcept {
  for (int i = 0; i < size_; ++i)
    out.mass[i] = from.mass[i] + h * (look.inflow[i] - look.outflow[i]);
}

template <int Most, int W>
void PlainAir<Most, W>::finish(State& state, const S& h,
                               const Answer* const (&look)[4]) const noexcept {
  const S sixth = h / 6.0;
  const auto mean = [&](const S& a, const S& b, const S& c, const S& d) {
    return S(sixth * (a + 2.0 * b + 2.0 * c + d));
  };
  for (int i = 0; i < size_; ++i) {
    const S in =
        mean(look[0]->inflow[i], look[1]->inflow[i], look[2]->inflow[i], look[3]->inflow[i]);
    const S gone =
        mean(look[0]->outflow[i], look[1]->outflow[i], look[2]->outflow[i], look[3]->outflow[i]);
    state.in[i] += in;
    state.out[i] += gone;
    state.mass[i] += in - gone;
  }
}

}  // namespace sinew::air
