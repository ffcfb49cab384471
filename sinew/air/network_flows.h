// air/network_flows.h - members of AirNetwork: one evaluation of tensions, pressures and flows.
#pragma once

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/network.h"
#include "sinew/air/network_setup.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/series.h"

namespace sinew::air {

// The muscles whose lines are asked one by one: those with more than valves, and all of them while
// something is broken.
template <int Most>
template <class Visit>
void AirNetwork<Most>::each_line(const Valves& valves, Visit visit) const noexcept {
  if (valves.broken)
    for (int i = 0; i < size_; ++i) visit(i);
  else
    for (const int i : more_) visit(i);
}

// Returns y of the line to the inlets behind a tank  [-].
template <int Most>
double AirNetwork<Most>::line_of_tank(const State& state, const Memory& memory,
                                      Answer& out) const noexcept {
  out.tank_pressure = gas::tank_pressure(supply_, air_, other(state, tank_));
  out.supply_pressure = gas::line_pressure(supply_, out.tank_pressure);
  return out.supply_pressure < supply_.pressure
             ? gas::root(of_pressure_, memory.line, out.supply_pressure, air_.atmosphere)
             : supply_y_;
}

// The pressure before the inlets, by tank and faults.
template <int Most>
auto AirNetwork<Most>::inlets(const State& state, const Valves& valves, const Memory& memory,
                              Answer& out) const noexcept -> Inlets {
  out.supply_pressure = out.tank_pressure = supply_.pressure;
  const double y = tank_ != none ? line_of_tank(state, memory, out) : supply_y_;
  const double failed = valves.broken ? failed_line(valves, out) : 0.0;
  return failed > 0 ? Inlets{failed, true} : Inlets{y, false};
}

template <int Most>
void AirNetwork<Most>::evaluate(double t, const Ends& ends, const State& state,
                                const Valves& valves, const Memory& memory, Answer& out,
                                std::uint64_t ahead) const noexcept {
  const Inlets line = inlets(state, valves, memory, out);
  Lanes y;
  if (in_lanes_)
    braids_.evaluate(ends.length, ends.rate, state.mass, memory.reference, out, y);
  else
    one_by_one(ends, state, memory, out, y);
  for (int i = 0; i < braids_.padded(); i += lanes)
    out.inflow.four(i) = out.outflow.four(i) = Four{};
  if (ramping_ || valves.open_count > 0) open_taps(t, line.y, y, valves, out);
  out.cylinder_force = 0;
  if (!plain_ || valves.broken)
    run_options({t, line.y, state, valves, memory, ahead}, line.cut, ends, y, out);
}

// All that a machine has beside muscles between valves.
template <int Most>
void AirNetwork<Most>::run_options(const Now& now, bool cut, const Ends& ends, const Lanes& y,
                                   Answer& out) const noexcept {
  each_line(now.valves, [&](int i) {
    if ((now.ahead >> i & 1) != 0 && line(i).hose == none) {  // flows are its course's affair
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

// Flows of the muscles that have nothing but valves, which may be shut.
template <int Most>
void AirNetwork<Most>::open_taps(double t, double y_supply, const Lanes& y, const Valves& valves,
                                 Answer& out) const noexcept {
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

// Pressures and tensions of muscles that lanes do not hold.
template <int Most>
void AirNetwork<Most>::one_by_one(const Ends& ends, const State& state, const Memory& memory,
                                  Answer& out, Lanes& y) const noexcept {
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

// Returns all of [31]-[35] but the dry friction, by the pressure that the mesh feels, and what
// comes late  [N].
template <int Most>
double AirNetwork<Most>::smooth_tension(int i, double length, double rate, double gauge,
                                        const State& state, const Memory& memory,
                                        Answer& out) const noexcept {
  const Muscle& m = muscle(i);
  const Line& l = line(i);
  double feels = gauge;
  if (l.plays) {
    const actuator::Felt felt = actuator::felt(m.actuator, length, gauge, memory.play[i]);
    feels = felt.gauge_pressure;
    out.play[i] = felt.play;  // moved by remember() alone
  }
  double one = actuator::clamped_tension(m.actuator, length, rate, feels, air_.atmosphere);
  for (std::size_t k = 0; k < l.late.size(); ++k) {
    const int late = l.late[k];
    if (late == none) continue;
    const actuator::Creep& creep = m.actuator.creep;
    one += actuator::creep_tension(m.actuator, creep.share[k], length, other(state, late),
                                   air_.atmosphere);
    this->rate(out, late) = actuator::creep_rate(creep.time[k], feels, other(state, late));
  }
  return m.count * one;
}

// [31]-[35] of the bundle.
template <int Most>
void AirNetwork<Most>::pull(int i, double length, double rate, double pressure, const State& state,
                            const Memory& memory, Answer& out) const noexcept {
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

  // A cord cannot push; without stick [33] as printed, sign(v).
  const bool stick = m.actuator.loss.stick;
  const double cord = std::max(smooth, 0.0);
  out.tension[i] = stick ? cord : std::max(cord + (rate >= 0 ? bound : -bound), 0.0);
  out.clamped[i] = stick ? smooth : smooth + (rate >= 0 ? bound : -bound);
  out.friction_bound[i] = stick ? bound : 0.0;
  out.pressure[i] = pressure;
}

template <int Most>
bool AirNetwork<Most>::shut(int inlet, const Now& now) const noexcept {
  const Valves& valves = now.valves;
  return !valves.leaking && !(open_share(inlet, now.t, valves) > 0) &&
         !(open_share(inlet + 1, now.t, valves) > 0);
}

// Flows through a pair of valves that ends at y: `inlet` and the one after it.
template <int Most>
auto AirNetwork<Most>::through(int inlet, const Now& now, double y) const noexcept -> Flows {
  const auto v = static_cast<std::size_t>(inlet);
  const Tap& tap = taps_[v];
  const Valves& valves = now.valves;
  if (regulates(tap.valve)) {
    const double outlet = tap.outlet == none
                              ? valves[v].set_y
                              : gas::root(of_pressure_, now.memory.outlet[v],
                                          other(now.state, tap.outlet), air_.atmosphere);
    const double flow = gas::flow_y(tap.flow, std::min(outlet, now.y_supply), y);
    return {std::max(flow, 0.0), std::max(-flow, 0.0)};
  }
  Flows flows;
  const double in = open_share(inlet, now.t, valves), out = open_share(inlet + 1, now.t, valves);
  if (in > 0) flows.in = in * gas::flow_y(tap.flow, now.y_supply, y);
  if (out > 0) flows.out = out * gas::flow_y(taps_[v + 1].flow, y, 1.0);
  if (valves.leaking) {
    flows.in += past_seat(inlet, now, now.y_supply, y);
    flows.out += past_seat(inlet + 1, now, y, 1.0);
  }
  return flows;
}

// Returns m' c_p T of a flow between two bodies of air; against its arrow it has the other's
// temperature  [W].
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

// Flows of the valves where the hose holds no air: what they let in goes through it.
template <int Most>
auto AirNetwork<Most>::series(int i, const Now& now, const Chamber& c, Answer& out) const noexcept
    -> Flows {
  const gas::HoseConstants& hose = line(i).hose_flow;
  if (shut(2 * i, now)) return {};
  const bool passes = !blocked(i, now.valves);
  const auto surplus = [&](double y) {
    const Flows f = through(2 * i, now, y);
    return f.in - f.out - (passes ? gas::hose_flow_y(hose, y, c.y) : 0.0);
  };
  const double low = std::min({1.0, now.y_supply, c.y}), high = std::max({1.0, now.y_supply, c.y});
  const double y = gas::balance(surplus, low, high);
  out.manifold[i] = gas::pressure_of_y(air_, y);
  return through(2 * i, now, y);
}

// Returns the air of a hose that is a chamber.
template <int Most>
auto AirNetwork<Most>::hose(int i, const Now& now) const noexcept -> Chamber {
  const Line& l = line(i);
  const double mass = other(now.state, l.hose), volume = muscle(i).hose.volume;
  if (l.hose_energy != none) {
    const double energy = other(now.state, l.hose_energy);
    const double p = gas::pressure_of_energy(energy, volume);
    return {p, gas::y_of(air_, p), gas::temperature(air_, energy, mass)};
  }
  const double y = gas::root(braids_.series(), now.memory.hose[static_cast<std::size_t>(i)],
                             mass / volume, gas::density_at_atmosphere(air_));
  return {gas::pressure_of_y(air_, y), y, air_.temperature};
}

// Air of muscle i: valves, hose, leak.
template <int Most>
void AirNetwork<Most>::run_line(int i, const Now& now, const Ends& ends, const Chamber& c,
                                Answer& out) const noexcept {
  const Line& l = line(i);
  out.manifold[i] = c.pressure;
  out.inflow[i] = out.outflow[i] = out.leak[i] = out.gain[i] = 0;
  if (!flowing(now.valves)) return;
  if ((now.ahead >> i & 1) != 0) {
    out.manifold[i] = hose(i, now).pressure;
    rate(out, l.hose) = 0;
    return;
  }
  const double room = air_.temperature;
  const bool passes = !blocked(i, now.valves);
  Flows valves;
  double arrives = 0, there = room;  // in the muscle [kg/s], from air of this temperature
  if (l.hose != none) {
    const Chamber h = hose(i, now);
    arrives = passes ? gas::hose_flow_y(l.hose_flow, h.y, c.y) : 0.0;
    there = h.temperature;
    valves = through(2 * i, now, h.y);
    out.manifold[i] = h.pressure;
    rate(out, l.hose) = valves.in - valves.out - arrives;
    if (l.hose_energy != none)
      rate(out, l.hose_energy) =
          warming(l.hose_energy, other(now.state, l.hose), now.state,
                  enthalpy(valves.in, room, there) - enthalpy(valves.out, there, room) -
                      enthalpy(arrives, there, c.temperature),
                  0.0);
  } else {
    valves = l.resists || !passes ? series(i, now, c, out) : through(2 * i, now, c.y);
    arrives = passes ? valves.in - valves.out : 0.0;
  }
  double leak = l.leak.tight() ? 0.0 : gas::leak_flow_y(l.leak, c.y);
  if (now.valves.leaking) leak += through_holes(i, now, c.y);
  out.inflow[i] = valves.in;
  out.outflow[i] = valves.out;
  out.leak[i] = leak;
  out.gain[i] = arrives - leak;
  if (l.energy == none) return;
  const Muscle& m = muscle(i);
  const double volume_rate =
      m.count * actuator::volume_slope(m.actuator, ends.length[i]) * ends.rate[i];
  rate(out, l.energy) =
      warming(l.energy, now.state.mass[i], now.state,
              enthalpy(arrives, there, c.temperature) - enthalpy(leak, c.temperature, room),
              c.pressure * volume_rate);
}

template <int Most>
void AirNetwork<Most>::run_cylinder(const Now& now, const Ends& ends, Answer& out) const noexcept {
  const Cylinder& c = *cylinder_;
  if (c.mode == Cylinder::Mode::regulator) {
    // Held pressure: the regulator lets in or relieves what the volume asks for.
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
      const double volume = air::volume(c, side, ends.travel);
      const double mass = other(now.state, slot.mass), density = mass / volume;
      Chamber air{0, 0, room};
      if (slot.energy != none) {
        const double energy = other(now.state, slot.energy);
        const double p = gas::pressure_of_energy(energy, volume);
        air = {p, gas::y_of(air_, p), gas::temperature(air_, energy, mass)};
      } else {
        air.y = gas::root(braids_.series(), now.memory.side[side], density,
                          gas::density_at_atmosphere(air_));
        air.pressure = gas::pressure_of_y(air_, air.y);
      }
      const Flows f = through(2 * (size_ + side), now, air.y);
      out.cylinder_pressure[side] = air.pressure;
      out.cylinder_density[side] = density;
      out.cylinder_inflow[side] = f.in;
      out.cylinder_outflow[side] = f.out;
      rate(out, slot.mass) = f.in - f.out;
      if (slot.energy != none)
        rate(out, slot.energy) =
            warming(slot.energy, mass, now.state,
                    enthalpy(f.in, room, air.temperature) - enthalpy(f.out, air.temperature, room),
                    air.pressure * volume_slope(c, side) * ends.travel_rate);
    }
  }
  out.cylinder_force =
      force(c, out.cylinder_pressure[up], out.cylinder_pressure[down], air_.atmosphere);
}

// Regulators follow their set points; the tank loses what the inlets take.
template <int Most>
void AirNetwork<Most>::run_supply(const Now& now, bool cut, Answer& out) const noexcept {
  for (const int valve : lagging_) {
    const auto v = static_cast<std::size_t>(valve);
    const int outlet = taps_[v].outlet;
    rate(out, outlet) =
        gas::outlet_rate(taps_[v].valve.regulator, other(now.state, outlet), now.valves[v].set);
  }
  if (tank_ == none) return;
  double taken = out.cylinder_inflow[up] + out.cylinder_inflow[down];  // [kg/s]
  for (int i = 0; i < size_; ++i) taken += out.inflow[i];
  rate(out, tank_) = cut ? 0.0 : -taken;
  if (cut_ != none) rate(out, cut_) = cut ? taken : 0.0;
}

}  // namespace sinew::air
