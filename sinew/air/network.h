// air/network.h - air network of a machine: bodies of air (chambers of muscles and of a cylinder,
// hoses, a tank, the room) joined by restrictions (valves, regulators, hoses, leaks), and the
// tensions of the muscles that they fill. It is the air half of one ODE; world/kernel/world.h
// integrates it together with a body:
//
//   lengths, rates, state, valves, memory  ->  tensions, pressures, flows
//
//   State       integrated quantities, and the masses that have passed the valves since the start
//   Valves      constant until the next node: positions of valves, set points and faults
//   Memory      constant until the next node: bases of the series, states of the hysteresis
//   Evaluation  result of one evaluation
//
//   order    command() at t, with the evaluation at the last node
//            move_valves(t) at next_change() and wherever the integrator requires a node, then
//            evaluate(), and update_memory() with that evaluation
//
// A network itself is constant; its caller owns the state.
//
// The state of a body of air is its mass, [40], and its energy where walls are warm. Muscles are
// evaluated in lanes by braid_lanes.h if it supports all of them and no wall is warm, else one
// after the other by actuator/tension.h. Parts that a machine does not have cost nothing: a muscle
// between two valves costs a lane and a flow per open valve. Only lines with more (a hose, a leak,
// a regulator, a warm wall), and all lines while something is broken, are evaluated one by one.
//
//   valve_bank.h    valves and regulators with their faults    bodies.h  the bodies of air
//   quick_bodies.h  those that are quicker than a step         here      the flows between them
//
// The laws: gas/orifice.h, hose.h, leak.h, heat.h, supply.h, valve.h, cylinder.h,
// actuator/hysteresis.h, creep.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/quick_bodies.h"
#include "sinew/units/stages.h"

namespace sinew::air {

// Air network for at most `Most` muscles: compiled for 4, 8 and 48.
template <int Most>
class AirNetwork : public QuickBodies<Most> {
  using Quick = QuickBodies<Most>;

 public:
  using Quick::flowing, Quick::open_share, Quick::volume;
  using typename Quick::Evaluation, typename Quick::QuickMasses, typename Quick::Ends,
      typename Quick::Lanes, typename Quick::Memory, typename Quick::State, typename Quick::Valves;

  // Throws std::invalid_argument for more than `Most` muscles, and for a cylinder with valves whose
  // chambers vanish at a stop. `step` is the longest one of the body [s].
  AirNetwork(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
             const std::optional<Cylinder>& cylinder = {}, std::span<const AirFault> faults = {},
             double step = 1e-3)
      : Quick(muscles, air, supply, cylinder, faults, step) {}

  // Applies an electrical edge of a valve at t, or a regulator's set point from t on; t is not
  // before the last node. `at_node`: the evaluation at that node, for delays and failures that
  // depend on the pressure difference.
  void command(const signals::Edge& edge, double t, const Evaluation& at_node,
               Valves& valves) const noexcept {
    Quick::command(edge, t, difference(edge.valve.index, at_node, valves), valves);
  }

  // Moves valves, set points and faults to the node at t. `before`: the evaluation at the last
  // node, for the delay of a shutter that a fault releases.
  void move_valves(double t, const Evaluation& before, Valves& valves) const noexcept {
    if (valves.next_change > t) return;
    Quick::move(
        t, [&](int valve) { return difference(valve, before, valves); }, valves);
  }

  // Evaluates the laws; t matters only to valves that ramp. `ahead`: a bit for each muscle that is
  // integrated ahead, whose flows are not computed.
  void evaluate(double t, const Ends& ends, const State& state, const Valves& valves,
                const Memory& memory, Evaluation& out, std::uint64_t ahead = 0) const noexcept;

  // The stages of RK4. move() writes the state at h along the rates of one evaluation, without the
  // masses passed since the start; `out` must not be `from`. finish() advances the state by the
  // weighted mean of four evaluations. Quick bodies take their masses from `quick_masses`.
  void move(State& out, const State& from, double h, const Evaluation& evaluation,
            const Valves& valves, const QuickMasses& quick_masses) const noexcept;
  void finish(State& state, double h, const Evaluation* const (&evaluations)[4],
              const Valves& valves, const QuickMasses& quick_masses) const noexcept;

  // Writes the second half of Heun's rule, for a preview; move() is the first half.
  void correct(State& out, const State& from, double h, const Evaluation& before,
               const Evaluation& after, const Valves& valves,
               const QuickMasses& quick_masses) const noexcept;

 private:
  using Cell = typename Quick::Cell;
  using Quick::air_, Quick::blocked, Quick::braids_, Quick::cut_, Quick::cylinder_,
      Quick::each_line, Quick::in_lanes_, Quick::supply_line, Quick::lagging_, Quick::line,
      Quick::muscle, Quick::none, Quick::other, Quick::others_, Quick::plain_, Quick::ramping_,
      Quick::rate_of, Quick::shut, Quick::sides_, Quick::size_, Quick::tank_, Quick::taps_,
      Quick::flows_through, Quick::hole_flow;
  using typename Quick::Flows, typename Quick::SupplyLine, typename Quick::AirLine,
      typename Quick::FlowInputs, typename Quick::Slot, typename Quick::Tap;

  struct Chamber {
    double pressure = 0, y = 0, temperature = 0;
  };

  double difference(int valve, const Evaluation& at_node, const Valves& valves) const noexcept;
  void one_by_one(const Ends& ends, const State& state, const Memory& memory, Evaluation& out,
                  Lanes& y) const noexcept;
  double smooth_tension(int i, double length, double rate, double gauge, const State& state,
                        const Memory& memory, Evaluation& out) const noexcept;
  void pull(int i, double length, double rate, double pressure, const State& state,
            const Memory& memory, Evaluation& out) const noexcept;
  void open_taps(double t, double y_supply, const Lanes& y, const Valves& valves,
                 Evaluation& out) const noexcept;
  Flows series(int i, const FlowInputs& now, const Chamber& c, Evaluation& out) const noexcept;
  Chamber hose(int i, const FlowInputs& now) const noexcept;
  void run_line(int i, const FlowInputs& now, const Ends& ends, const Chamber& c,
                Evaluation& out) const noexcept;
  void run_options(const FlowInputs& now, bool cut, const Ends& ends, const Lanes& y,
                   Evaluation& out) const noexcept;
  void run_cylinder(const FlowInputs& now, const Ends& ends, Evaluation& out) const noexcept;
  void run_supply(const FlowInputs& now, bool cut, Evaluation& out) const noexcept;
  double enthalpy(double flow, double from, double to) const noexcept;
  double warming(int energy, double mass, const State& state, double gained,
                 double work) const noexcept;
  template <class Mean>
  void add(State& out, const State& from, Mean mean, const Valves& valves,
           const QuickMasses& quick_masses) const noexcept;
  template <class Mean>
  void add_quick_masses(State& out, Mean mean, const QuickMasses& quick_masses) const noexcept;
};

// Returns the pressure difference that the valve holds back, positive in its direction of flow
// [Pa].
template <int Most>
double AirNetwork<Most>::difference(int valve, const Evaluation& at_node,
                                    const Valves& valves) const noexcept {
  const int pair = valve / 2;
  const double p = pair >= size_ ? at_node.cylinder_pressure[static_cast<std::size_t>(pair - size_)]
                   : line(pair).has_options || valves.broken ? at_node.manifold[pair]
                                                             : at_node.pressure[pair];
  return valve % 2 == 0 ? at_node.supply_pressure - p : p - air_.atmosphere;
}

template <int Most>
void AirNetwork<Most>::evaluate(double t, const Ends& ends, const State& state,
                                const Valves& valves, const Memory& memory, Evaluation& out,
                                std::uint64_t ahead) const noexcept {
  const SupplyLine supply = supply_line(state, valves, memory, out);
  Lanes y;
  if (in_lanes_)
    braids_.evaluate(ends.length, ends.rate, state.mass, memory.reference, out, y);
  else
    one_by_one(ends, state, memory, out, y);
  for (int i = 0; i < braids_.padded(); i += lanes)
    out.inflow.four(i) = out.outflow.four(i) = Four{};
  if (ramping_ || valves.open_count > 0) open_taps(t, supply.y, y, valves, out);
  out.cylinder_force = 0;
  if (!plain_ || valves.broken)
    run_options({t, supply.y, state, valves, memory, ahead}, supply.cut, ends, y, out);
}

// Evaluates all parts of a machine other than muscles between valves.
template <int Most>
void AirNetwork<Most>::run_options(const FlowInputs& now, bool cut, const Ends& ends,
                                   const Lanes& y, Evaluation& out) const noexcept {
  each_line(now.valves, [&](int i) {
    if ((now.ahead >> i & 1) != 0 && line(i).hose == none) {  // its flows are in the quick masses
      out.manifold[i] = out.pressure[i];
      out.inflow[i] = out.outflow[i] = out.leak[i] = out.gain[i] = 0;
      return;
    }
    Chamber c{out.pressure[i], y[i], air_.temperature};
    if (const int energy = line(i).energy; energy != none)
      c.temperature = gas::temperature(air_, other(now.state, energy), now.state.mass[i]);
    run_line(i, now, ends, c, out);
  });
  out.cylinder_pressure = out.cylinder_inflow = out.cylinder_outflow = {};
  if (cylinder_) run_cylinder(now, ends, out);
  run_supply(now, cut, out);
}

// Computes the flows of the muscles that have only valves, which may be shut.
template <int Most>
void AirNetwork<Most>::open_taps(double t, double y_supply, const Lanes& y, const Valves& valves,
                                 Evaluation& out) const noexcept {
  const auto through_one = [&](int valve, double share) {
    const Tap& tap = taps_[static_cast<std::size_t>(valve)];
    if (!tap.listed) return;
    const int i = valve / 2;
    if (valve % 2 == 0)
      out.inflow[i] = share * gas::flow_y(tap.flow, y_supply, y[i]);
    else
      out.outflow[i] = share * gas::flow_y(tap.flow, y[i], 1.0);
  };
  if (ramping_)
    for (int valve = 0; valve < 2 * size_; ++valve)
      through_one(valve, open_share(valve, t, valves));
  else
    for (int k = 0; k < valves.open_count; ++k) {
      const typename Valves::Open& open = valves.open[static_cast<std::size_t>(k)];
      through_one(open.valve, open.share);
    }
}

// Computes pressures and tensions of muscles that lanes do not support.
template <int Most>
void AirNetwork<Most>::one_by_one(const Ends& ends, const State& state, const Memory& memory,
                                  Evaluation& out, Lanes& y) const noexcept {
  for (int i = 0; i < size_; ++i) {
    const double v = volume(i, ends.length[i]), density = state.mass[i] / v;
    double p = 0;
    if (const int energy = line(i).energy; energy != none) {
      p = gas::pressure_of_energy(other(state, energy), v);
      y[i] = gas::y_of(air_, p);
      out.drift[i] = 0;
    } else {
      const gas::Base base{memory.reference.y[i], memory.reference.inverse_sigma[i]};
      y[i] = gas::root(braids_.series(), base, density, gas::density_at_atmosphere(air_));
      p = gas::pressure_of_y(air_, y[i]);
      out.drift[i] = density * base.inverse - 1.0;
    }
    pull(i, ends.length[i], ends.rate[i], p, state, memory, out);
  }
}

// Returns [31]-[35] without the dry friction, at the pressure after hysteresis, and with the creep
// [N].
template <int Most>
double AirNetwork<Most>::smooth_tension(int i, double length, double rate, double gauge,
                                        const State& state, const Memory& memory,
                                        Evaluation& out) const noexcept {
  const Muscle& m = muscle(i);
  const AirLine& l = line(i);
  double effective_gauge = gauge;
  if (l.plays) {
    const actuator::EffectivePressure effective =
        actuator::effective_pressure(m.actuator, length, gauge, memory.play[i], air_.atmosphere);
    effective_gauge = effective.gauge_pressure;
    out.play[i] = effective.play;  // applied by update_memory() alone
  }
  double one =
      actuator::clamped_tension(m.actuator, length, rate, effective_gauge, air_.atmosphere);
  for (std::size_t k = 0; k < l.late.size(); ++k) {
    const int late = l.late[k];
    if (late == none) continue;
    const actuator::Creep& creep = m.actuator.creep;
    one += actuator::creep_tension(m.actuator, creep.share[k], length, other(state, late),
                                   air_.atmosphere);
    rate_of(out, late) = actuator::creep_rate(creep.time[k], effective_gauge, other(state, late));
  }
  return m.count * one;
}

// Computes [31]-[35] of the bundle.
template <int Most>
void AirNetwork<Most>::pull(int i, double length, double rate, double pressure, const State& state,
                            const Memory& memory, Evaluation& out) const noexcept {
  const Muscle& m = muscle(i);
  const double gauge = pressure - air_.atmosphere;
  const double smooth = smooth_tension(i, length, rate, gauge, state, memory, out);
  const double exponent = air_.wall_time > 0 ? gas::heat_capacity_ratio : air_.polytropic_exponent;
  const bool by_sealed = m.actuator.loss.coulomb_scale == actuator::Loss::Scale::sealed;
  const double sealed =
      by_sealed ? actuator::stiffness_sealed(m.actuator, length, pressure, air_.atmosphere,
                                             m.external_volume / m.count, exponent)
                : 0.0;
  const double bound =
      m.count * actuator::coulomb_bound(m.actuator, length, gauge, air_.atmosphere, sealed);

  // A tendon cannot push; without stick [33] has sign(v), as printed.
  const bool stick = m.actuator.loss.stick;
  const double tendon_tension = std::max(smooth, 0.0);
  out.tension[i] =
      stick ? tendon_tension : std::max(tendon_tension + (rate >= 0 ? bound : -bound), 0.0);
  out.clamped[i] = stick ? smooth : smooth + (rate >= 0 ? bound : -bound);
  out.friction_bound[i] = stick ? bound : 0.0;
  out.pressure[i] = pressure;
}

// Returns m' c_p T of a flow between two bodies of air, with the temperature of the body that it
// comes from [W].
template <int Most>
double AirNetwork<Most>::enthalpy(double flow, double from, double to) const noexcept {
  return flow * (gas::heat_capacity_pressure(air_) * (flow > 0 ? from : to));
}

// Returns U' of a chamber: enthalpy gained, work done on the outside, heat from the wall  [W].
template <int Most>
double AirNetwork<Most>::warming(int energy, double mass, const State& state, double gained,
                                 double work) const noexcept {
  return gained - work + gas::heat_flow(air_, other(state, energy), mass);
}

// Returns the flows of the valves where the hose holds no air: both flows in series are equal.
template <int Most>
auto AirNetwork<Most>::series(int i, const FlowInputs& now, const Chamber& c,
                              Evaluation& out) const noexcept -> Flows {
  const gas::HoseConstants& hose = line(i).hose_flow;
  if (shut(2 * i, now)) return {};
  const bool passes = !blocked(i, now.valves);
  const auto surplus = [&](double y) {
    const Flows f = flows_through(2 * i, now, y);
    return f.in - f.out - (passes ? gas::hose_flow_y(hose, y, c.y) : 0.0);
  };
  const double low = std::min({1.0, now.y_supply, c.y}), high = std::max({1.0, now.y_supply, c.y});
  const double y = gas::balance(surplus, low, high);
  out.manifold[i] = gas::pressure_of_y(air_, y);
  return flows_through(2 * i, now, y);
}

// Returns the air of a hose that is a chamber.
template <int Most>
auto AirNetwork<Most>::hose(int i, const FlowInputs& now) const noexcept -> Chamber {
  const AirLine& l = line(i);
  const double mass = other(now.state, l.hose), in_hose = muscle(i).hose.volume;
  if (l.hose_energy != none) {
    const double energy = other(now.state, l.hose_energy);
    const double p = gas::pressure_of_energy(energy, in_hose);
    return {p, gas::y_of(air_, p), gas::temperature(air_, energy, mass)};
  }
  const double y = gas::root(braids_.series(), now.memory.hose[static_cast<std::size_t>(i)],
                             mass / in_hose, gas::density_at_atmosphere(air_));
  return {gas::pressure_of_y(air_, y), y, air_.temperature};
}

// Computes the flows of muscle i: valves, hose, leak.
template <int Most>
void AirNetwork<Most>::run_line(int i, const FlowInputs& now, const Ends& ends, const Chamber& c,
                                Evaluation& out) const noexcept {
  const AirLine& l = line(i);
  out.manifold[i] = c.pressure;
  out.inflow[i] = out.outflow[i] = out.leak[i] = out.gain[i] = 0;
  if (!flowing(now.valves)) return;
  if ((now.ahead >> i & 1) != 0) {
    out.manifold[i] = hose(i, now).pressure;
    rate_of(out, l.hose) = 0;
    return;
  }
  const double room = air_.temperature;
  const bool passes = !blocked(i, now.valves);
  Flows valves;
  double arrives = 0, there = room;  // into the muscle [kg/s], from air of this temperature
  if (l.hose != none) {
    const Chamber h = hose(i, now);
    arrives = passes ? gas::hose_flow_y(l.hose_flow, h.y, c.y) : 0.0;
    there = h.temperature;
    valves = flows_through(2 * i, now, h.y);
    out.manifold[i] = h.pressure;
    rate_of(out, l.hose) = valves.in - valves.out - arrives;
    if (l.hose_energy != none)
      rate_of(out, l.hose_energy) =
          warming(l.hose_energy, other(now.state, l.hose), now.state,
                  enthalpy(valves.in, room, there) - enthalpy(valves.out, there, room) -
                      enthalpy(arrives, there, c.temperature),
                  0.0);
  } else {
    valves = l.has_hose || !passes ? series(i, now, c, out) : flows_through(2 * i, now, c.y);
    arrives = passes ? valves.in - valves.out : 0.0;
  }
  double leak = l.leak.tight() ? 0.0 : gas::leak_flow_y(l.leak, c.y);
  if (now.valves.leaking) leak += hole_flow(i, now, c.y);
  out.inflow[i] = valves.in;
  out.outflow[i] = valves.out;
  out.leak[i] = leak;
  out.gain[i] = arrives - leak;
  if (l.energy == none) return;
  const Muscle& m = muscle(i);
  const double volume_rate =
      m.count * actuator::volume_slope(m.actuator, ends.length[i]) * ends.rate[i];
  rate_of(out, l.energy) =
      warming(l.energy, now.state.mass[i], now.state,
              enthalpy(arrives, there, c.temperature) - enthalpy(leak, c.temperature, room),
              c.pressure * volume_rate);
}

template <int Most>
void AirNetwork<Most>::run_cylinder(const FlowInputs& now, const Ends& ends,
                                    Evaluation& out) const noexcept {
  const Cylinder& c = *cylinder_;
  if (c.mode == Cylinder::Mode::regulator) {
    // Held pressure: the regulator admits or relieves the air for the change of volume.
    const double held = std::min(c.pressure, out.supply_pressure);
    const double flow = gas::density(air_, held) * volume_slope(c, down) * ends.travel_rate;
    out.cylinder_pressure = {air_.atmosphere, held};
    out.cylinder_inflow[down] = std::max(flow, 0.0);
    out.cylinder_outflow[down] = std::max(-flow, 0.0);
  } else {
    const double room = air_.temperature;
    for (const Side side : {up, down}) {
      const Slot& slot = sides_[side];
      if (slot.mass == none) {  // single-acting: open to the room
        out.cylinder_pressure[side] = air_.atmosphere;
        continue;
      }
      const double room_of_air = air::volume(c, side, ends.travel);
      const double mass = other(now.state, slot.mass), density = mass / room_of_air;
      Chamber air{0, 0, room};
      if (slot.energy != none) {
        const double energy = other(now.state, slot.energy);
        const double p = gas::pressure_of_energy(energy, room_of_air);
        air = {p, gas::y_of(air_, p), gas::temperature(air_, energy, mass)};
      } else {
        air.y = gas::root(braids_.series(), now.memory.side[side], density,
                          gas::density_at_atmosphere(air_));
        air.pressure = gas::pressure_of_y(air_, air.y);
      }
      const Flows f = flows_through(2 * (size_ + side), now, air.y);
      out.cylinder_pressure[side] = air.pressure;
      out.cylinder_density[side] = density;
      out.cylinder_inflow[side] = f.in;
      out.cylinder_outflow[side] = f.out;
      rate_of(out, slot.mass) = f.in - f.out;
      if (slot.energy != none)
        rate_of(out, slot.energy) =
            warming(slot.energy, mass, now.state,
                    enthalpy(f.in, room, air.temperature) - enthalpy(f.out, air.temperature, room),
                    air.pressure * volume_slope(c, side) * ends.travel_rate);
    }
  }
  out.cylinder_force =
      force(c, out.cylinder_pressure[up], out.cylinder_pressure[down], air_.atmosphere);
}

// Computes the rates of the regulators' outlets and of the tank, which loses the inlets' flow.
template <int Most>
void AirNetwork<Most>::run_supply(const FlowInputs& now, bool cut, Evaluation& out) const noexcept {
  for (const int valve : lagging_) {
    const auto v = static_cast<std::size_t>(valve);
    const int outlet = taps_[v].outlet;
    rate_of(out, outlet) =
        gas::outlet_rate(taps_[v].valve.regulator, other(now.state, outlet), now.valves[v].set);
  }
  if (tank_ == none) return;
  double taken = out.cylinder_inflow[up] + out.cylinder_inflow[down];  // [kg/s]
  for (int i = 0; i < size_; ++i) taken += out.inflow[i];
  rate_of(out, tank_) = cut ? 0.0 : -taken;
  if (cut_ != none) rate_of(out, cut_) = cut ? taken : 0.0;
}

// Advances only the masses; what has passed is summed at the end of the step.
template <int Most>
void AirNetwork<Most>::move(State& out, const State& from, double h, const Evaluation& evaluation,
                            const Valves& valves, const QuickMasses& quick_masses) const noexcept {
  const bool flows = flowing(valves);
  for (int i = 0; i < braids_.padded(); i += lanes) {
    Four mass = from.mass.four(i);
    if (flows) mass += h * (evaluation.inflow.four(i) - evaluation.outflow.four(i));
    out.mass.four(i) = mass;
  }
  if (plain_ && !valves.broken) return;
  each_line(valves, [&](int i) { out.mass[i] = from.mass[i] + h * evaluation.gain[i]; });
  for (std::size_t k = 0; k < static_cast<std::size_t>(others_); ++k)
    out.other[k] = from.other[k] + h * evaluation.rate[k];

  const bool end = !(h < quick_masses.step);
  for (std::size_t k = 0; k < static_cast<std::size_t>(quick_masses.count); ++k) {
    const Cell& cell = quick_masses.cells[k];
    const double mass = end ? cell.full : cell.half;
    if (cell.of >= size_) {
      other(out, sides_[static_cast<std::size_t>(cell.of - size_)].mass) = mass;
      continue;
    }
    out.mass[cell.of] = mass;
    if (const int hose = line(cell.of).hose; hose != none) other(out, hose) = cell.hose;
  }
}

template <int Most>
void AirNetwork<Most>::finish(State& state, double h, const Evaluation* const (&evaluations)[4],
                              const Valves& valves,
                              const QuickMasses& quick_masses) const noexcept {
  const units::StageMean stages(h);
  const auto mean = [&](auto&& of) { return stages([&](int s) { return of(*evaluations[s]); }); };
  add(state, state, mean, valves, quick_masses);
}

template <int Most>
void AirNetwork<Most>::correct(State& out, const State& from, double h, const Evaluation& before,
                               const Evaluation& after, const Valves& valves,
                               const QuickMasses& quick_masses) const noexcept {
  const double half = 0.5 * h;
  add(
      out, from, [&](auto&& of) { return half * (of(before) + of(after)); }, valves, quick_masses);
}

// Adds the mean of every rate: mean(of) is the step's length times the mean of of(evaluation).
// `out` may be `from`.
template <int Most>
template <class Mean>
void AirNetwork<Most>::add(State& out, const State& from, Mean mean, const Valves& valves,
                           const QuickMasses& quick_masses) const noexcept {
  const bool options = !plain_ || valves.broken;
  const int moved = flowing(valves) ? size_ : 0;
  for (int i = 0; i < moved; ++i) {
    const double in = mean([&](const Evaluation& a) { return a.inflow[i]; });
    const double mass_out = mean([&](const Evaluation& a) { return a.outflow[i]; });
    out.in[i] = from.in[i] + in;
    out.out[i] = from.out[i] + mass_out;
    if (options && (line(i).has_options || valves.broken)) {
      out.mass[i] = from.mass[i] + mean([&](const Evaluation& a) { return a.gain[i]; });
      out.leak[i] = from.leak[i] + mean([&](const Evaluation& a) { return a.leak[i]; });
    } else {
      out.mass[i] = from.mass[i] + (in - mass_out);
    }
  }
  if (!options) return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(others_); ++k)
    out.other[k] = from.other[k] + mean([&](const Evaluation& a) { return a.rate[k]; });
  for (std::size_t c = 0; c < 2 && cylinder_; ++c) {
    out.piston_in[c] =
        from.piston_in[c] + mean([&](const Evaluation& a) { return a.cylinder_inflow[c]; });
    out.piston_out[c] =
        from.piston_out[c] + mean([&](const Evaluation& a) { return a.cylinder_outflow[c]; });
  }
  if (quick_masses.count > 0) add_quick_masses(out, mean, quick_masses);
}

// Replaces the flows and masses of each body that was integrated ahead by its own, and
// corrects the mass that the supply has delivered.
template <int Most>
template <class Mean>
void AirNetwork<Most>::add_quick_masses(State& out, Mean mean,
                                        const QuickMasses& quick_masses) const noexcept {
  for (std::size_t k = 0; k < static_cast<std::size_t>(quick_masses.count); ++k) {
    const Cell& cell = quick_masses.cells[k];
    const bool of_a_muscle = cell.of < size_;
    const auto c = static_cast<std::size_t>(of_a_muscle ? 0 : cell.of - size_);
    const auto mean_flow = [&](auto&& of_muscle, auto&& of_cylinder) {
      return mean([&](const Evaluation& a) {
        return of_a_muscle ? of_muscle(a)[cell.of] : of_cylinder(a)[c];
      });
    };
    const double in =
        cell.in - mean_flow([](const Evaluation& a) -> const Lanes& { return a.inflow; },
                            [](const Evaluation& a) -> const auto& { return a.cylinder_inflow; });
    const double mass_out =
        cell.out - mean_flow([](const Evaluation& a) -> const Lanes& { return a.outflow; },
                             [](const Evaluation& a) -> const auto& { return a.cylinder_outflow; });
    (of_a_muscle ? out.in[cell.of] : out.piston_in[c]) += in;
    (of_a_muscle ? out.out[cell.of] : out.piston_out[c]) += mass_out;
    if (of_a_muscle) {
      out.leak[cell.of] += cell.leak - mean([&](const Evaluation& a) { return a.leak[cell.of]; });
      out.mass[cell.of] = cell.full;
      if (const int hose = line(cell.of).hose; hose != none) other(out, hose) = cell.hose;
    } else {
      other(out, sides_[c].mass) = cell.full;
    }
    if (tank_ == none) continue;
    // Tank and cut line sum the flows of all inlets; the line in use takes the correction.
    const bool cut = quick_masses.cut;
    other(out, cut ? cut_ : tank_) += cut ? in : -in;
  }
}

extern template class AirNetwork<4>;
extern template class AirNetwork<8>;
extern template class AirNetwork<48>;

}  // namespace sinew::air
