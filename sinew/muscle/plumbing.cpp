#include "sinew/muscle/plumbing.h"

#include <limits>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/series.h"

namespace sinew::muscle {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using Kind = gas::Valve::Kind;

double lesser(double a, double b) { return a < b ? a : b; }
double greater(double a, double b) { return a > b ? a : b; }

}  // namespace

// How much higher the pressure is on the side that the valve holds back  [Pa].
double Plumbing::difference(int valve, const AirPull& at_node) const noexcept {
  const int pair = valve / 2;
  const double p = pair < size_ ? at_node.manifold[pair]
                                : at_node.cylinder_pressure[static_cast<std::size_t>(pair - size_)];
  return valve % 2 == 0 ? at_node.supply_pressure - p : p - air_.atmosphere;
}

void Plumbing::electrical(int valve, double t, bool open, const AirPull& at_node,
                          Valves& valves) const noexcept {
  const auto i = static_cast<std::size_t>(valve);
  const gas::Valve& v = taps_[i].valve;
  // A 3-way valve has one coil, a regulator has none.
  if (v.kind == Kind::regulator || (v.kind == Kind::three_way && valve % 2 == 1)) return;
  const double dp = difference(valve, at_node);
  if (open && v.fails_above > 0 && dp > v.fails_above) return;  // and its end will be no edge
  valves[i].shutter.electrical(t, open, gas::delay_at(v, open, dp));
  look_ahead(valves);
}

void Plumbing::level(int valve, double t, double share, Valves& valves) const noexcept {
  const auto i = static_cast<std::size_t>(valve);
  const gas::Valve& v = taps_[i].valve;
  if (v.kind != Kind::regulator) return;
  valves[i].next_set = gas::set_point(v.regulator, share, air_.atmosphere);
  valves[i].next_set_at = t;
  look_ahead(valves);
}

// A command can also take a pending change back, so look at all of them.
void Plumbing::look_ahead(Valves& valves) const noexcept {
  valves.next_change = faults_.next(valves.faults);
  for (std::size_t v = 0; v < taps_.size(); ++v)
    valves.next_change =
        lesser(valves.next_change, lesser(valves[v].shutter.next(), valves[v].next_set_at));
}

void Plumbing::move(double t, const AirPull& before, Valves& valves) const noexcept {
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    Valves::Valve& valve = valves[v];
    valve.shutter.advance(t);
    if (valve.next_set_at > t) continue;
    valve.set = valve.next_set;
    valve.next_set_at = never;
  }
  faults_.advance(t, valves.faults,
                  [&](const AirFault& f, bool begins) { change(f, begins, t, before, valves); });
  refresh(t, valves);
}

// Returns the open share of the valve's area, its seat being sound: the shutter's, or of the other
// way of a 3-way valve, which opens to the atmosphere when it leaves the supply.
double Plumbing::fraction(std::size_t v, double t, const Valves& valves) const noexcept {
  const bool other_way = v % 2 == 1 && taps_[v].valve.kind == Kind::three_way;
  return other_way ? 1.0 - valves[v - 1].shutter.fraction(t) : valves[v].shutter.fraction(t);
}

// Shares of area after a change.
void Plumbing::refresh(double t, Valves& valves) const noexcept {
  valves.open_count = 0;
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    const bool regulates = taps_[v].valve.kind == Kind::regulator;
    const double seat = faults_.seat(static_cast<int>(v), valves.faults);
    valves[v].share = regulates ? 1.0 : muscle::open_share(seat, fraction(v, t, valves));
    if (valves[v].share > 0) ++valves.open_count;
  }
  valves.leaking = let_through(valves.faults);
  look_ahead(valves);
}

double Plumbing::open_share(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_ || taps_[v].valve.kind == Kind::regulator) return valves[v].share;
  return muscle::open_share(faults_.seat(valve, valves.faults), fraction(v, t, valves));
}

// Of the air in muscle i  [m^3].
double Plumbing::volume(int i, double length) const noexcept {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  return m.count * actuator::volume(m.actuator, length) + m.external_volume;
}

bool Plumbing::shut(int inlet, const Now& now) const noexcept {
  return !now.valves.leaking && !(open_share(inlet, now.t, now.valves) > 0) &&
         !(open_share(inlet + 1, now.t, now.valves) > 0);
}

// By [40], or from the energy where there is one.
Plumbing::Chamber Plumbing::chamber(const Slot& slot, double volume,
                                    const AirState& state) const noexcept {
  const double mass = state[slot.mass];
  if (slot.energy != none) {
    const double p = gas::pressure_of_energy(state[slot.energy], volume);
    return {p, gas::y_of(air_, p), gas::temperature(air_, state[slot.energy], mass)};
  }
  const double relative = mass / volume / gas::density_at_atmosphere(air_);
  const double y = units::power(relative, air_.polytropic_exponent / 7.0);
  return {gas::pressure_of_y(air_, y), y, air_.temperature};
}

// Through a pair of valves that ends at y: `inlet` and the one after it.
Plumbing::Flows Plumbing::through(int inlet, const Now& now, double y) const noexcept {
  const auto v = static_cast<std::size_t>(inlet);
  const Tap& tap = taps_[v];
  if (tap.valve.kind == Kind::regulator) {
    const double outlet = tap.outlet != none ? now.state[tap.outlet] : now.valves[v].set;
    const double flow = gas::flow_y(tap.flow, lesser(gas::y_of(air_, outlet), now.y_supply), y);
    return {greater(flow, 0.0), greater(-flow, 0.0)};
  }
  Flows flows;
  const double in = open_share(inlet, now.t, now.valves),
               out = open_share(inlet + 1, now.t, now.valves);
  if (in > 0) flows.in = in * gas::flow_y(tap.flow, now.y_supply, y);
  if (out > 0) flows.out = out * gas::flow_y(taps_[v + 1].flow, y, 1.0);
  if (now.valves.leaking) {
    flows.in += past_seat(inlet, now, now.y_supply, y);
    flows.out += past_seat(inlet + 1, now, y, 1.0);
  }
  return flows;
}

// All of [31]-[35] but the dry friction, by the pressure that the mesh feels, and what comes late.
double Plumbing::smooth_tension(int i, double length, double rate, double gauge,
                                const AirState& state, AirPull& out,
                                AirState& derivative) const noexcept {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  const Line& l = lines_[static_cast<std::size_t>(i)];
  double feels = gauge;
  if (l.play != none) {
    const actuator::Felt felt = actuator::felt(m.actuator, length, gauge, state[l.play]);
    feels = felt.gauge_pressure;
    out.play[i] = felt.play;
    derivative[l.play] = 0.0;  // moved by remember() alone
  }
  double one = actuator::tension(m.actuator, length, rate, feels, air_.atmosphere);
  for (std::size_t k = 0; k < l.late.size(); ++k) {
    const int late = l.late[k];
    if (late == none) continue;
    const actuator::Creep& creep = m.actuator.creep;
    one +=
        actuator::creep_tension(m.actuator, creep.share[k], length, state[late], air_.atmosphere);
    derivative[late] = actuator::creep_rate(creep.time[k], feels, state[late]);
  }
  return m.count * one;
}

// [31]-[35] of the bundle.
void Plumbing::pull(int i, double length, double rate, double pressure, const AirState& state,
                    AirPull& out, AirState& derivative) const noexcept {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  const double gauge = pressure - air_.atmosphere;
  const double smooth = smooth_tension(i, length, rate, gauge, state, out, derivative);
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
  const double cord = greater(smooth, 0.0);
  out.tension[i] = stick ? cord : greater(cord + (rate >= 0 ? bound : -bound), 0.0);
  out.clamped[i] = stick ? smooth : smooth + (rate >= 0 ? bound : -bound);
  out.mesh[i] = stick ? bound : 0.0;
  out.pressure[i] = pressure;
}

// m' c_p T of a flow between two bodies of air; against its arrow it has the other's temperature.
double Plumbing::enthalpy(double flow, double from, double to) const noexcept {
  return flow * (gas::heat_capacity_pressure(air_) * (flow > 0 ? from : to));
}

// U' of a chamber: enthalpy gained, work done on the outside, heat from the wall.
void Plumbing::warm(const Slot& slot, const AirState& state, double gained, double work,
                    AirState& derivative) const noexcept {
  if (slot.energy == none) return;
  derivative[slot.energy] =
      gained - work + gas::heat_flow(air_, state[slot.energy], state[slot.mass]);
}

// Flows of the valves where the hose holds no air: what they let in goes through it.
Plumbing::Flows Plumbing::series(int i, const Now& now, const Chamber& c,
                                 AirPull& out) const noexcept {
  const gas::HoseConstants& hose = lines_[static_cast<std::size_t>(i)].hose_flow;
  if (shut(2 * i, now)) return {};
  const bool passes = !blocked(i, now.valves);
  const auto surplus = [&](double y) {
    const Flows f = through(2 * i, now, y);
    return f.in - f.out - (passes ? gas::hose_flow_y(hose, y, c.y) : 0.0);
  };
  const double low = lesser(1.0, lesser(now.y_supply, c.y)),
               high = greater(1.0, greater(now.y_supply, c.y));
  const double y = gas::balance(surplus, low, high);
  out.manifold[i] = gas::pressure_of_y(air_, y);
  return through(2 * i, now, y);
}

// The same where the hose is a chamber: it takes what the valves let in, and hands on `passed`.
Plumbing::Flows Plumbing::buffered(int i, const Now& now, const Chamber& h, const Chamber& c,
                                   double passed, AirPull& out,
                                   AirState& derivative) const noexcept {
  const Slot& slot = lines_[static_cast<std::size_t>(i)].hose;
  const Flows valves = through(2 * i, now, h.y);
  out.manifold[i] = h.pressure;
  derivative[slot.mass] = valves.in - valves.out - passed;
  const double room = air_.temperature;
  warm(slot, now.state,
       enthalpy(valves.in, room, h.temperature) - enthalpy(valves.out, h.temperature, room) -
           enthalpy(passed, h.temperature, c.temperature),
       0.0, derivative);
  return valves;
}

// Air of muscle i: valves, hose, leak.
void Plumbing::line(int i, const Now& now, double length, double rate, const Chamber& c,
                    AirPull& out, AirState& derivative) const noexcept {
  const Line& l = lines_[static_cast<std::size_t>(i)];
  if (quiet(now.valves) && l.leak.tight()) {
    out.inflow[i] = out.outflow[i] = out.leak[i] = derivative[l.chamber.mass] = 0;
    return;
  }
  const double room = air_.temperature;
  const bool passes = !blocked(i, now.valves);
  Flows valves;
  double arrives, there = room;  // in the muscle [kg/s], from air of this temperature
  if (l.hose.mass != none) {
    const Chamber h = chamber(l.hose, muscles_[static_cast<std::size_t>(i)].hose.volume, now.state);
    arrives = passes ? gas::hose_flow_y(l.hose_flow, h.y, c.y) : 0.0;
    there = h.temperature;
    valves = buffered(i, now, h, c, arrives, out, derivative);
  } else {
    valves = l.resists || !passes ? series(i, now, c, out) : through(2 * i, now, c.y);
    arrives = passes ? valves.in - valves.out : 0.0;
  }
  double leak = l.leak.tight() ? 0.0 : gas::leak_flow_y(l.leak, c.y);
  if (now.valves.leaking) leak += through_holes(i, now, c.y);
  out.inflow[i] = valves.in;
  out.outflow[i] = valves.out;
  out.leak[i] = leak;
  derivative[l.chamber.mass] = arrives - leak;
  if (l.chamber.energy == none) return;
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  const double volume_rate = m.count * actuator::volume_slope(m.actuator, length) * rate;
  warm(l.chamber, now.state,
       enthalpy(arrives, there, c.temperature) - enthalpy(leak, c.temperature, room),
       c.pressure * volume_rate, derivative);
}

void Plumbing::cylinder(const Now& now, double travel, double travel_rate, AirPull& out,
                        AirState& derivative) const noexcept {
  const Cylinder& c = *cylinder_;
  if (c.mode == Cylinder::Mode::regulator) {
    // Held pressure: the regulator lets in or relieves what the volume asks for.
    const double held = lesser(c.pressure, out.supply_pressure);
    const double flow = gas::density(air_, held) * volume_slope(c, down) * travel_rate;
    out.cylinder_pressure = {air_.atmosphere, held};
    out.cylinder_inflow[down] = greater(flow, 0.0);
    out.cylinder_outflow[down] = greater(-flow, 0.0);
  } else {
    const double room = air_.temperature;
    for (const Side side : {up, down}) {
      const Slot& slot = sides_[side];
      if (slot.mass == none) {  // single-acting: open to the room
        out.cylinder_pressure[side] = air_.atmosphere;
        continue;
      }
      const Chamber air = chamber(slot, muscle::volume(c, side, travel), now.state);
      const Flows f = through(2 * (size_ + side), now, air.y);
      out.cylinder_pressure[side] = air.pressure;
      out.cylinder_inflow[side] = f.in;
      out.cylinder_outflow[side] = f.out;
      derivative[slot.mass] = f.in - f.out;
      warm(slot, now.state,
           enthalpy(f.in, room, air.temperature) - enthalpy(f.out, air.temperature, room),
           air.pressure * volume_slope(c, side) * travel_rate, derivative);
    }
  }
  out.cylinder_force =
      force(c, out.cylinder_pressure[up], out.cylinder_pressure[down], air_.atmosphere);
}

void Plumbing::muscles_in_lanes(const Lanes& length, const Lanes& rate, const AirState& state,
                                AirPull& out, Lanes& y) const noexcept {
  Lanes l, v, mass;  // lanes beyond the last muscle repeat it
  for (int i = 0; i < braids_.padded(); ++i) {
    const int m = i < size_ ? i : size_ - 1;
    l[i] = length[m];
    v[i] = rate[m];
    mass[i] = state[m];
  }
  braids_.evaluate(l, v, mass, state.reference, out, y);
}

void Plumbing::evaluate(double t, const Lanes& length, const Lanes& rate, double travel,
                        double travel_rate, const AirState& state, const Valves& valves,
                        AirPull& out, AirState& derivative) const noexcept {
  out.tank_pressure =
      tank_ != none ? gas::tank_pressure(supply_, air_, state[tank_]) : supply_.pressure;
  out.supply_pressure =
      tank_ != none ? gas::line_pressure(supply_, out.tank_pressure) : supply_.pressure;
  double y_supply =
      out.supply_pressure < supply_.pressure ? gas::y_of(air_, out.supply_pressure) : supply_y_;
  const double failed = valves.faults.any() ? failed_line(valves, out) : 0.0;
  if (failed > 0) y_supply = failed;

  const Now now{t, y_supply, state, valves};

  Lanes y;
  if (in_lanes_) muscles_in_lanes(length, rate, state, out, y);
  double taken = 0;  // from the supply [kg/s]
  for (int i = 0; i < size_; ++i) {
    Chamber c{out.pressure[i], y[i], air_.temperature};
    if (!in_lanes_) {
      c = chamber(lines_[static_cast<std::size_t>(i)].chamber, volume(i, length[i]), state);
      pull(i, length[i], rate[i], c.pressure, state, out, derivative);
      out.drift[i] = 0;
    }
    out.manifold[i] = c.pressure;
    line(i, now, length[i], rate[i], c, out, derivative);
    taken += out.inflow[i];
  }
  out.cylinder_force = 0;
  out.cylinder_pressure = out.cylinder_inflow = out.cylinder_outflow = {};
  if (cylinder_) cylinder(now, travel, travel_rate, out, derivative);
  taken += out.cylinder_inflow[up] + out.cylinder_inflow[down];

  for (std::size_t v = 0; v < taps_.size(); ++v)
    if (const int outlet = taps_[v].outlet; outlet != none)
      derivative[outlet] = gas::outlet_rate(taps_[v].valve.regulator, state[outlet], valves[v].set);
  if (tank_ != none) derivative[tank_] = failed > 0 ? 0.0 : -taken;
  if (cut_ != none) derivative[cut_] = failed > 0 ? taken : 0.0;
}

}  // namespace sinew::muscle
