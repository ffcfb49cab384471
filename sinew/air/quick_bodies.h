// air/quick_bodies.h - bodies of air that are quicker than a step of the body.
//
// A hose's small volume settles within 0.1 ms, a muscle behind a wide valve (also through a hose
// without volume) or with a burst wall within less. RK4 of the whole machine would have to take
// such steps. Instead such a body of air, or two in series (hose and muscle), is integrated ahead
// through the step on its own by the linearly implicit RODAS3 (stiff/quick.h), with steps chosen by
// its error. The body's RK4 stages then use its masses at the half and at the end.
//
// Two approximations are made: the muscle's length continues at the node's rate (V is linear over
// the step: an error of l'' h^2/2, 1e-4 of the volume at 20 m/s^2 and 1 ms), and the supply's
// pressure is constant. docs/theory/gas-and-valves.md has the resulting error against steps of 5
// us.
//
// At rest, with all valves shut and equal densities, hose and muscle are one chamber that shares
// its air by volume, and the law of the hose is not evaluated.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/air/bodies.h"
#include "sinew/air/stiff/quick.h"
#include "sinew/gas/slopes.h"

namespace sinew::air {

template <int Most>
class QuickBodies : public BodiesOfAir<Most> {
 public:
  using QuickMasses = AirQuickMasses<Most>;
  using typename BodiesOfAir<Most>::Evaluation, typename BodiesOfAir<Most>::Ends,
      typename BodiesOfAir<Most>::Lanes, typename BodiesOfAir<Most>::Memory,
      typename BodiesOfAir<Most>::State, typename BodiesOfAir<Most>::Valves;
  using BodiesOfAir<Most>::flowing, BodiesOfAir<Most>::volume,
      BodiesOfAir<Most>::always_quick_muscles;

  // Integrates ahead at the beginning of a step of length h, or of a preview of that length.
  void plan(double t, double h, const Ends& ends, const State& state, const Valves& valves,
            const Memory& memory, QuickMasses& quick_masses) const noexcept;

 protected:
  using Bodies = BodiesOfAir<Most>;
  using Bodies::Bodies;
  using Cell = typename QuickMasses::Cell;
  // These members of the slower bodies are used without their class's name.
  using Bodies::air_, Bodies::by_regulators_, Bodies::blocked, Bodies::braids_,
      Bodies::fault_constants_, Bodies::cylinder_, Bodies::each_line, Bodies::faults_,
      Bodies::supply_line, Bodies::line, Bodies::muscle, Bodies::none, Bodies::other,
      Bodies::plain_, Bodies::ramping_, Bodies::regulators_, Bodies::shut, Bodies::side_settling_,
      Bodies::sides_, Bodies::size_, Bodies::slope_of_faults, Bodies::sloped_flows_through,
      Bodies::spring_, Bodies::taps_, Bodies::flows_through;
  using typename Bodies::SlopedFlows, typename Bodies::SupplyLine, typename Bodies::AirLine,
      typename Bodies::FlowInputs, typename Bodies::LinearVolume, typename Bodies::Tap;

 private:
  SlopedFlows sloped_flows(int cell, const FlowInputs& now, double since_node, double y,
                           bool sloped) const noexcept;
  gas::SlopedFlow sloped_leak(int i, const FlowInputs& now, double y) const noexcept;
  bool is_quick(int cell, double h, const Ends& ends, const Valves& valves) const noexcept;
  template <int Openings>
  void run_ahead(const FlowInputs& node, double h, const LinearVolume& chamber,
                 const gas::Base& base, double mass, Cell& cell) const noexcept;
  void run_hose_ahead(const FlowInputs& node, double h, const LinearVolume& chamber,
                      Cell& cell) const noexcept;
  void run_muscle_ahead(const FlowInputs& node, double h, const Ends& ends,
                        Cell& cell) const noexcept;
  void run_regulators_ahead(int first, const FlowInputs& node, double h, const Ends& ends,
                            RegulatorLanes::Outputs& ahead) const noexcept;
};

// Returns the flows of the valves of muscle i, or of a chamber of the cylinder, with y in it. If
// the valves' flow passes a hose without volume, y between them is where both flows are equal, and
// its slopes are those that keep them equal.
template <int Most>
auto QuickBodies<Most>::sloped_flows(int cell, const FlowInputs& now, double since_node, double y,
                                     bool sloped) const noexcept -> SlopedFlows {
  if (cell >= size_ || !line(cell).has_hose)
    return sloped_flows_through(2 * cell, now, since_node, y, sloped);
  if (shut(2 * cell, now)) return {};
  const gas::HoseConstants& hose = line(cell).hose_flow;
  const auto surplus = [&](double between) {
    const SlopedFlows f = sloped_flows_through(2 * cell, now, since_node, between, false);
    return f.in - f.out - gas::hose_flow_y(hose, between, y);
  };
  const double low = std::min({1.0, now.y_supply, y}), high = std::max({1.0, now.y_supply, y});
  const double between = gas::balance(surplus, low, high);
  SlopedFlows o = sloped_flows_through(2 * cell, now, since_node, between, sloped);
  if (!sloped) return o;
  const gas::SlopedFlow through = gas::sloped_hose_flow_y(hose, between, y);
  const double opposes = through.by_a - (o.in_by - o.out_by);  // above 0 where anything flows
  const double by_y = opposes > 0 ? through.by_b / -opposes : 0.0;
  const double by_time = opposes > 0 ? (o.in_by_time - o.out_by_time) / opposes : 0.0;
  o.in_by_time += o.in_by * by_time;
  o.out_by_time += o.out_by * by_time;
  o.in_by *= by_y;
  o.out_by *= by_y;
  return o;
}

// Returns the flow from muscle i to the room by leaks and holes [kg/s].
template <int Most>
gas::SlopedFlow QuickBodies<Most>::sloped_leak(int i, const FlowInputs& now,
                                               double y) const noexcept {
  gas::SlopedFlow leak;
  const auto add = [&](const gas::LeakConstants& c) {
    const gas::SlopedFlow one = gas::sloped_leak_flow_y(c, y, 1.0);
    leak.flow += one.flow;
    leak.by_a += one.by_a;
  };
  if (!line(i).leak.tight()) add(line(i).leak);
  if (now.valves.leaking)
    faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
      if (f.what == AirFault::What::hole && f.of == i) add(fault_constants_[k].leak);
    });
  return leak;
}

// Returns whether the air of muscle i, or of a cylinder's chamber, is integrated ahead in a step of
// h.
template <int Most>
bool QuickBodies<Most>::is_quick(int cell, double h, const Ends& ends,
                                 const Valves& valves) const noexcept {
  if (air_.wall_time > 0) return false;
  if (cell < size_ && (always_quick_muscles(valves) >> cell & 1) != 0) return true;
  double slope = valves.leaking ? spring_ * slope_of_faults(cell, valves.faults) : 0.0,
         capacity = 0;
  if (cell < size_) {
    if (valves.broken && blocked(cell, valves)) return false;
    slope += line(cell).settling + Bodies::settling_of_open(cell, valves);
    if (!(slope > 0)) return false;
    capacity = volume(cell, ends.length[cell]);
  } else {
    const Side side = static_cast<Side>(cell - size_);
    if (sides_[side].mass == none) return false;
    const auto inlet = static_cast<std::size_t>(2 * cell);
    const bool open = ramping_ || valves[inlet].share > 0 || valves[inlet + 1].share > 0;
    slope += open ? side_settling_[side] : 0.0;
    capacity = air::volume(*cylinder_, side, ends.travel);
  }
  return slope * h > quick::from_rate * capacity;
}

// Integrates one body of air: a muscle without the air of a hose, or a chamber of the cylinder;
// the third opening is its leak.
template <int Most>
template <int Openings>
void QuickBodies<Most>::run_ahead(const FlowInputs& node, double h, const LinearVolume& chamber,
                                  const gas::Base& base, double mass, Cell& cell) const noexcept {
  constexpr bool leaks = Openings == 3;
  const double at_one = gas::density_at_atmosphere(air_), n7 = braids_.series().exponent();
  const auto rates = [&](double t, const std::array<double, 1>& x, bool sloped) {
    FlowInputs now = node;
    now.t = t;
    const double v = chamber.volume + chamber.rate * (t - node.t);
    const double y = gas::root(braids_.series(), base, x[0] / v, at_one);
    const SlopedFlows o = sloped_flows(cell.of, now, t - node.t, y, sloped);
    const double by_mass = n7 * y / x[0], by_time = -n7 * y * chamber.rate / v;
    QuickRates<1, Openings> r;
    r.passed[0] = o.in, r.passed[1] = o.out;
    r.passed_by[0][0] = o.in_by * by_mass, r.passed_by[1][0] = o.out_by * by_mass;
    r.passed_by_time[0] = o.in_by * by_time + o.in_by_time;
    r.passed_by_time[1] = o.out_by * by_time + o.out_by_time;
    r.mass[0] = o.in - o.out;
    r.mass_by[0][0] = r.passed_by[0][0] - r.passed_by[1][0];
    r.mass_by_time[0] = r.passed_by_time[0] - r.passed_by_time[1];
    if constexpr (leaks) {
      const gas::SlopedFlow leak = sloped_leak(cell.of, now, y);
      r.passed[2] = leak.flow;
      r.passed_by[2][0] = leak.by_a * by_mass;
      r.passed_by_time[2] = leak.by_a * by_time;
      r.mass[0] -= r.passed[2];
      r.mass_by[0][0] -= r.passed_by[2][0];
      r.mass_by_time[0] -= r.passed_by_time[2];
    }
    return r;
  };
  quick::write_result(quick::integrate_step<1>(rates, node.t, h, {quick::muscle_error}, {mass}),
                      cell);
}

// Integrates a hose and its muscle through the step.
template <int Most>
void QuickBodies<Most>::run_hose_ahead(const FlowInputs& node, double h,
                                       const LinearVolume& chamber, Cell& cell) const noexcept {
  const int i = cell.of;
  const AirLine& l = line(i);
  const double at_one = gas::density_at_atmosphere(air_), n7 = braids_.series().exponent();
  const double in_hose = muscle(i).hose.volume;
  const bool passes = !blocked(i, node.valves);
  const bool leaks = !l.leak.tight() || node.valves.leaking;
  const std::array<double, 2> x{other(node.state, l.hose), node.state.mass[i]};
  const double sum = x[0] + x[1];

  const double apart = (x[0] / in_hose) / (x[1] / chamber.volume) - 1.0;
  const double evens = l.settling * (1.0 / in_hose + 1.0 / chamber.volume);  // [1/s]
  if (passes && l.leak.tight() && shut(2 * i, node) && std::abs(apart) < quick::equal_density &&
      std::abs(chamber.rate) < quick::equal_density * evens * chamber.volume) {
    const double half = chamber.volume + 0.5 * h * chamber.rate,
                 full = chamber.volume + h * chamber.rate;
    cell.half = sum * half / (half + in_hose);
    cell.full = sum * full / (full + in_hose);
    cell.hose = sum - cell.full;
    cell.in = cell.out = cell.leak = 0;
    return;
  }

  const gas::Base base{node.memory.reference.y[i], node.memory.reference.inverse_sigma[i]};
  const gas::Base& of_hose = node.memory.hose[static_cast<std::size_t>(i)];
  const auto rates = [&](double t, const std::array<double, 2>& m, bool sloped) {
    FlowInputs now = node;
    now.t = t;
    const double v = chamber.volume + chamber.rate * (t - node.t);
    const double y_hose = gas::root(braids_.series(), of_hose, m[0] / in_hose, at_one);
    const double y = gas::root(braids_.series(), base, m[1] / v, at_one);
    const SlopedFlows o = sloped_flows_through(2 * i, now, t - node.t, y_hose, sloped);
    const gas::SlopedFlow pass = !passes ? gas::SlopedFlow{}
                                 : sloped
                                     ? gas::sloped_hose_flow_y(l.hose_flow, y_hose, y)
                                     : gas::SlopedFlow{gas::hose_flow_y(l.hose_flow, y_hose, y)};
    const gas::SlopedFlow leak = leaks ? sloped_leak(i, now, y) : gas::SlopedFlow{};
    const double hose_by = n7 * y_hose / m[0], by_mass = n7 * y / m[1];
    const double by_time = -n7 * y * chamber.rate / v;
    QuickRates<2> r;
    r.passed = {o.in, o.out, leak.flow};
    r.passed_by = {
        {{o.in_by * hose_by, 0.0}, {o.out_by * hose_by, 0.0}, {0.0, leak.by_a * by_mass}}};
    r.passed_by_time = {o.in_by_time, o.out_by_time, leak.by_a * by_time};
    r.mass = {o.in - o.out - pass.flow, pass.flow - leak.flow};
    r.mass_by = {{{(o.in_by - o.out_by - pass.by_a) * hose_by, -pass.by_b * by_mass},
                  {pass.by_a * hose_by, (pass.by_b - leak.by_a) * by_mass}}};
    r.mass_by_time = {o.in_by_time - o.out_by_time - pass.by_b * by_time,
                      (pass.by_b - leak.by_a) * by_time};
    return r;
  };
  quick::write_result(
      quick::integrate_step<2>(rates, node.t, h, {quick::hose_error, quick::muscle_error}, x),
      cell);
}

// Integrates muscle `cell.of` through the step on its own.
template <int Most>
void QuickBodies<Most>::run_muscle_ahead(const FlowInputs& node, double h, const Ends& ends,
                                         Cell& cell) const noexcept {
  const int i = cell.of;
  const Muscle& m = muscle(i);
  const LinearVolume chamber{
      volume(i, ends.length[i]),
      m.count * actuator::volume_slope(m.actuator, ends.length[i]) * ends.rate[i]};
  if (line(i).hose != none) return run_hose_ahead(node, h, chamber, cell);
  const gas::Base base{node.memory.reference.y[i], node.memory.reference.inverse_sigma[i]};
  const double mass = node.state.mass[i];
  if (line(i).leak.tight() && !node.valves.leaking)
    run_ahead<2>(node, h, chamber, base, mass, cell);
  else
    run_ahead<3>(node, h, chamber, base, mass, cell);
}

// Integrates four muscles from `first` on as if all were behind regulators; lanes without a
// regulator return values that the caller ignores.
template <int Most>
void QuickBodies<Most>::run_regulators_ahead(int first, const FlowInputs& node, double h,
                                             const Ends& ends,
                                             RegulatorLanes::Outputs& ahead) const noexcept {
  const auto lane = [first](const Lanes& of) { return of.of.data() + first; };
  const Reference<Most>& reference = node.memory.reference;
  RegulatorLanes::Inputs in{.length = lane(ends.length),
                            .rate = lane(ends.rate),
                            .mass = lane(node.state.mass),
                            .y_ref = lane(reference.y),
                            .inverse_sigma = lane(reference.inverse_sigma)};
  for (int at = 0; at < lanes; ++at) {
    const auto v = static_cast<std::size_t>(2 * std::min(first + at, size_ - 1));
    const int outlet = taps_[v].outlet;
    const bool lags = outlet != none;
    const gas::Base& base = node.memory.outlet[v];
    const double set = node.valves[v].set;
    in.set[at] = lags ? set : 1.0;
    in.off[at] = lags ? other(node.state, outlet) - set : 0.0;
    in.outlet_y[at] = lags ? base.y : node.valves[v].set_y;
    in.outlet_inverse[at] = lags ? base.inverse : 1.0;
  }
  regulators_.integrate(first, h, node.y_supply, in, ahead);
}

template <int Most>
void QuickBodies<Most>::plan(double t, double h, const Ends& ends, const State& state,
                             const Valves& valves, const Memory& memory,
                             QuickMasses& quick_masses) const noexcept {
  quick_masses.count = 0;
  quick_masses.step = h;
  quick_masses.muscles = 0;
  if ((plain_ && !valves.broken) || !flowing(valves)) return;
  Evaluation scratch;
  const SupplyLine before = supply_line(state, valves, memory, scratch);
  quick_masses.cut = before.cut;
  const FlowInputs now{t, before.y, state, valves, memory};
  const auto add = [&](int of) -> Cell& {
    Cell& cell = quick_masses.cells[static_cast<std::size_t>(quick_masses.count++)];
    cell.of = of;
    if (of < size_) quick_masses.muscles |= std::uint64_t{1} << of;
    cell.hose = 0;
    return cell;
  };
  std::uint64_t by_regulators = 0;
  each_line(valves, [&](int i) {
    if (!is_quick(i, h, ends, valves)) return;
    if (!valves.leaking && (by_regulators_ >> i & 1) != 0)
      by_regulators |= std::uint64_t{1} << i;
    else
      run_muscle_ahead(now, h, ends, add(i));
  });
  for (int first = 0; by_regulators >> first != 0; first += lanes) {
    if ((by_regulators >> first & 0xf) == 0) continue;
    RegulatorLanes::Outputs ahead;
    run_regulators_ahead(first, now, h, ends, ahead);
    for (int at = 0; at < lanes; ++at) {
      if ((by_regulators >> (first + at) & 1) == 0) continue;
      Cell& cell = add(first + at);
      if ((ahead.calm >> at & 1) == 0)
        run_muscle_ahead(now, h, ends, cell);
      else
        cell.half = ahead.half[at], cell.full = ahead.full[at], cell.in = ahead.in[at],
        cell.out = ahead.out[at], cell.leak = 0;
    }
  }
  for (const Side side : {up, down}) {
    if (!cylinder_ || !is_quick(size_ + side, h, ends, valves)) continue;
    const LinearVolume chamber{air::volume(*cylinder_, side, ends.travel),
                               volume_slope(*cylinder_, side) * ends.travel_rate};
    run_ahead<2>(now, h, chamber, memory.side[side], other(state, sides_[side].mass),
                 add(size_ + side));
  }
}

extern template class QuickBodies<4>;
extern template class QuickBodies<8>;
extern template class QuickBodies<48>;

}  // namespace sinew::air
