// air/valve_bank.h - the valves and regulators of a machine with their faults: where their shutters
// are from node to node, and what flows through a pair of them.
//
// A pair is an inlet from the supply and an exhaust to the room; a 3-way valve and a regulator
// serve both ways. fault.h has the list of faults. The laws: gas/orifice.h, delay.h, valve.h,
// leak.h.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sinew/air/fault.h"
#include "sinew/air/state.h"
#include "sinew/air/stiff/quick.h"
#include "sinew/gas/air.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/slopes.h"
#include "sinew/gas/valve.h"
#include "sinew/signals/port.h"

namespace sinew::air {

inline constexpr double never = std::numeric_limits<double>::infinity();

// Returns whether the valve is a regulator, which follows a set point.
inline bool regulates(const gas::Valve& valve) { return valve.kind == gas::Valve::Kind::regulator; }

// For at most `Most` muscles and a cylinder.
template <int Most>
class ValveBank {
 public:
  using State = AirState<Most>;
  using Valves = AirValves<Most>;
  using Memory = AirMemory<Most>;
  using Answer = AirAnswer<Most>;

  // The number of valves. Their order: 2 x muscle + (0 inlet | 1 exhaust), then the cylinder's: up
  // inlet, up exhaust, down inlet, down exhaust.
  int valves() const noexcept { return static_cast<int>(taps_.size()); }
  const gas::Valve& valve(int index) const noexcept { return tap(index).valve; }
  const gas::FlowConstants& flow(int valve) const noexcept { return tap(valve).flow; }
  // Replaces the law of a valve's flow, for steps that are cut where it jumps.
  void set_flow(int valve, const gas::FlowConstants& flow) noexcept {
    taps_[static_cast<std::size_t>(valve)].flow = flow;
  }
  bool ramping() const noexcept { return ramping_; }  // some shutter opens or closes gradually

  // All valves without current since ever, all set points at the atmosphere's pressure.
  Valves valves_at_rest() const;

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t, const Valves& valves) const noexcept;

 protected:
  static constexpr int none = -1;

  // One valve, or regulator, and what it lets through.
  struct Tap {
    gas::Valve valve;
    gas::FlowConstants flow;
    int outlet = none;    // Kind::regulator: state of its outlet pressure
    bool listed = false;  // the flow is that of the open share alone
  };
  struct Flows {
    double in = 0, out = 0;  // from the supply, to the room [kg/s]
  };
  // The flows of one evaluation depend on these numbers and on the chambers.
  struct Now {
    double t;         // [s]
    double y_supply;  // of the line to the inlets
    const State& state;
    const Valves& valves;
    const Memory& memory;
    std::uint64_t ahead = 0;  // muscles whose flows are not needed
  };
  // The flows through a pair of valves, their slopes over y and their drift at one y.
  struct Flowing {
    double in = 0, out = 0;                  // [kg/s]
    double in_by = 0, out_by = 0;            // [kg/s]
    double in_by_time = 0, out_by_time = 0;  // [kg/s^2]
  };
  struct Broken {
    gas::LeakConstants leak;
    double y = 1;  // of the supply's line
  };

  // Takes what is broken on purpose; the valves are added one by one.
  ValveBank(const gas::Air& air, std::span<const AirFault> faults) : air_(air), faults_(faults) {
    for (const AirFault& f : faults_.all()) {
      Broken broken{.leak = gas::leak_constants(f.leak, air_)};
      if (f.what == AirFault::What::supply) broken.y = gas::y_of(air_, f.pressure);
      broken_.push_back(broken);
    }
  }

  // Return another number of the state than the masses, its rate in an answer, and a valve.
  static double other(const State& s, int i) noexcept {
    return s.other[static_cast<std::size_t>(i)];
  }
  static double& other(State& s, int i) noexcept { return s.other[static_cast<std::size_t>(i)]; }
  static double& rate_of(Answer& a, int i) noexcept { return a.rate[static_cast<std::size_t>(i)]; }
  const Tap& tap(int valve) const noexcept { return taps_[static_cast<std::size_t>(valve)]; }

  // Adds a valve behind the ones that are there.
  void add_tap(const gas::Valve& valve);
  // An electrical edge of a valve at t, or a regulator's set point from t on. `difference`: how
  // much higher the pressure is on the side that the valve holds back [Pa].
  void command(const signals::Edge& edge, double t, double difference,
               Valves& valves) const noexcept;
  // Valves, set points and faults move to t; difference(valve), of one that a fault lets go.
  template <class Difference>
  void move(double t, const Difference& difference, Valves& valves) const noexcept;

  // These return the flows through a pair of valves that ends at y: `inlet` and the one after it;
  // with their slopes; whether both are shut.
  Flows through(int inlet, const Now& now, double y) const noexcept;
  Flowing sloped_through(int inlet, const Now& now, double since_node, double y,
                         bool sloped) const noexcept;
  bool shut(int inlet, const Now& now) const noexcept;

  double through_holes(int i, const Now& now, double y) const noexcept;
  // Returns whether a fault closes the line of a muscle.
  bool blocked(int i, const Valves& valves) const noexcept;
  double failed_line(const Valves& valves, Answer& out) const noexcept;
  double slope_of_faults(int pair, const ActingFaults& faults) const noexcept;

  gas::Air air_;
  gas::PowerSeries of_pressure_{1.0 / 7.0};  // y of a pressure
  std::vector<Tap> taps_;
  FaultSchedule faults_;
  std::vector<Broken> broken_;  // by each fault
  bool ramping_ = false;

 private:
  double fraction(std::size_t valve, double t, const Valves& valves) const noexcept;
  void look_ahead(Valves& valves) const noexcept;
  void refresh(double t, Valves& valves) const noexcept;
  template <class Difference>
  void change(const AirFault& fault, bool begins, double t, const Difference& difference,
              Valves& valves) const noexcept;
  bool let_through(const ActingFaults& faults) const noexcept;
  bool is_broken(const ActingFaults& faults) const noexcept;
  double past_seat(int valve, const Now& now, double y_from, double y_to) const noexcept;
};

template <int Most>
void ValveBank<Most>::add_tap(const gas::Valve& valve) {
  taps_.push_back({.valve = valve, .flow = gas::flow_constants(valve.flow, air_)});
  ramping_ = ramping_ || valve.profile == gas::Valve::Profile::ramp;
}

template <int Most>
auto ValveBank<Most>::valves_at_rest() const -> Valves {
  Valves valves{};
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    // In its place, so that what lies between its members stays 0 (driven_muscle.h).
    std::construct_at(&valves[v].shutter, taps_[v].valve);
    valves[v].set = air_.atmosphere;
    valves[v].set_y = 1;
    valves[v].next_set_at = never;
  }
  refresh(0.0, valves);
  return valves;
}

template <int Most>
void ValveBank<Most>::command(const signals::Edge& edge, double t, double difference,
                              Valves& valves) const noexcept {
  const std::size_t i = edge.valve.index;
  const gas::Valve& v = taps_[i].valve;
  if (regulates(v)) {
    const double share = static_cast<double>(edge.level) / signals::max_level;
    valves[i].next_set = gas::set_point(v.regulator, share, air_.atmosphere);
    valves[i].next_set_at = t;
  } else {
    // A 3-way valve has one coil.
    if (v.kind == gas::Valve::Kind::three_way && i % 2 == 1) return;
    if (edge.open && v.fails_above > 0 && difference > v.fails_above)
      return;  // its end will be no edge
    valves[i].shutter.electrical(t, edge.open, gas::delay_at(v, edge.open, difference));
  }
  look_ahead(valves);
}

// A command can also take a pending change back, so look at all of them.
template <int Most>
void ValveBank<Most>::look_ahead(Valves& valves) const noexcept {
  double next = faults_.next(valves.faults);
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    next = std::min(next, valves[v].shutter.next());
    next = std::min(next, valves[v].next_set_at);
  }
  valves.next_change = next;
}

template <int Most>
template <class Difference>
void ValveBank<Most>::move(double t, const Difference& difference, Valves& valves) const noexcept {
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    typename Valves::Valve& valve = valves[v];
    valve.shutter.advance(t);
    if (valve.next_set_at > t) continue;
    valve.set = valve.next_set;
    valve.set_y = gas::y_of(air_, valve.set);
    valve.next_set_at = never;
  }
  faults_.advance(t, valves.faults, [&](const AirFault& f, bool begins) {
    change(f, begins, t, difference, valves);
  });
  refresh(t, valves);
}

// Returns the open share of the valve's area, its seat being sound: the shutter's, or of the other
// way of a 3-way valve, which opens to the atmosphere when it leaves the supply.
template <int Most>
double ValveBank<Most>::fraction(std::size_t v, double t, const Valves& valves) const noexcept {
  const bool other_way = v % 2 == 1 && taps_[v].valve.kind == gas::Valve::Kind::three_way;
  return other_way ? 1.0 - valves[v - 1].shutter.fraction(t) : valves[v].shutter.fraction(t);
}

// Shares of area after a change. A regulator is always open.
template <int Most>
void ValveBank<Most>::refresh(double t, Valves& valves) const noexcept {
  valves.open_count = 0;
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    const double seat = faults_.seat(static_cast<int>(v), valves.faults);
    const double share =
        regulates(taps_[v].valve) ? 1.0 : air::open_share(seat, fraction(v, t, valves));
    valves[v].share = share;
    if (share > 0)
      valves.open[static_cast<std::size_t>(valves.open_count++)] = {static_cast<int>(v), share};
  }
  valves.leaking = let_through(valves.faults);
  valves.broken = is_broken(valves.faults);
  look_ahead(valves);
}

template <int Most>
double ValveBank<Most>::open_share(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_ || regulates(taps_[v].valve)) return valves[v].share;
  return air::open_share(faults_.seat(valve, valves.faults), fraction(v, t, valves));
}

// A shutter that is let go sets off as by an edge at t: with its delay, if its coil can lift it.
template <int Most>
template <class Difference>
void ValveBank<Most>::change(const AirFault& fault, bool begins, double t,
                             const Difference& difference, Valves& valves) const noexcept {
  using What = AirFault::What;
  if (fault.what != What::stuck_open && fault.what != What::stuck_shut) return;
  const auto v = static_cast<std::size_t>(fault.of);
  gas::Shutter& shutter = valves[v].shutter;
  if (begins) {
    shutter.jam(t, fault.what == What::stuck_open ? 1.0 : 0.0);
    shutter.advance(t);
    return;
  }
  const gas::Valve& valve = taps_[v].valve;
  const bool lifted = shutter.fraction(t) > 0;
  const double dp = difference(fault.of);
  const bool lifts = lifted || !(valve.fails_above > 0 && dp > valve.fails_above);
  shutter.free(t, gas::delay_at(valve, shutter.command(), dp), lifts);
  shutter.advance(t);  // of a valve without delay
}

template <int Most>
bool ValveBank<Most>::let_through(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults,
                 [&](std::size_t k, const AirFault&) { any = any || !broken_[k].leak.tight(); });
  return any;
}

template <int Most>
bool ValveBank<Most>::is_broken(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults,
                 [&](std::size_t, const AirFault& f) { any = any || !is_share_of_valve(f); });
  return any;
}

// Returns the flow beside a valve's shutter  [kg/s].
template <int Most>
double ValveBank<Most>::past_seat(int valve, const Now& now, double y_from,
                                  double y_to) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == AirFault::What::seat_leak && f.of == valve)
      flow += gas::leak_flow_y(broken_[k].leak, y_from, y_to);
  });
  return flow;
}

// Returns the flow out of muscle i into the room, through what is broken  [kg/s].
template <int Most>
double ValveBank<Most>::through_holes(int i, const Now& now, double y) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == AirFault::What::hole && f.of == i) flow += gas::leak_flow_y(broken_[k].leak, y);
  });
  return flow;
}

template <int Most>
bool ValveBank<Most>::blocked(int i, const Valves& valves) const noexcept {
  bool is = false;
  if (valves.faults.any())
    faults_.each(valves.faults, [&](std::size_t, const AirFault& f) {
      is = is || (f.what == AirFault::What::blocked && f.of == i);
    });
  return is;
}

// Returns y of the line to the inlets where the supply has failed, whose pressure goes into the
// look; 0 where it has not  [-].
template <int Most>
double ValveBank<Most>::failed_line(const Valves& valves, Answer& out) const noexcept {
  double y = 0;
  faults_.each(valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what != AirFault::What::supply) return;
    y = broken_[k].y;
    out.supply_pressure = f.pressure;
  });
  return y;
}

// Returns the slope of all that leaks out of muscle `pair`, and past the seats of its pair of
// valves, near equal pressures  [kg/(s Pa)].
template <int Most>
double ValveBank<Most>::slope_of_faults(int pair, const ActingFaults& faults) const noexcept {
  double slope = 0;
  faults_.each(faults, [&](std::size_t k, const AirFault& f) {
    const bool seat = f.what == AirFault::What::seat_leak && f.of / 2 == pair;
    if (seat || (f.what == AirFault::What::hole && f.of == pair))
      slope += (broken_[k].leak.hole.linear_gain + broken_[k].leak.slope) / air_.atmosphere;
  });
  return slope;
}

template <int Most>
bool ValveBank<Most>::shut(int inlet, const Now& now) const noexcept {
  const Valves& valves = now.valves;
  return !valves.leaking && !(open_share(inlet, now.t, valves) > 0) &&
         !(open_share(inlet + 1, now.t, valves) > 0);
}

// Flows through a pair of valves that ends at y: `inlet` and the one after it.
template <int Most>
auto ValveBank<Most>::through(int inlet, const Now& now, double y) const noexcept -> Flows {
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

// A pair of valves that ends at y, with its slopes. Regulators follow their lag meanwhile.
template <int Most>
auto ValveBank<Most>::sloped_through(int inlet, const Now& now, double since_node, double y,
                                     bool sloped) const noexcept -> Flowing {
  const auto v = static_cast<std::size_t>(inlet);
  const Tap& tap = taps_[v];
  const Valves& valves = now.valves;
  Flowing o;
  if (regulates(tap.valve)) {
    double outlet = valves[v].set_y, outlet_rate = 0;
    if (tap.outlet != none) {
      const double tau = tap.valve.regulator.time_constant, set = valves[v].set;
      const double off = (other(now.state, tap.outlet) - set) * quick::decay(since_node / tau);
      outlet = gas::root(of_pressure_, now.memory.outlet[v], set + off, air_.atmosphere);
      outlet_rate = -off / tau * outlet / (7.0 * (set + off));
    }
    if (outlet > now.y_supply) outlet = now.y_supply, outlet_rate = 0;
    const gas::SlopedFlow f = quick::flow(sloped, tap.flow, outlet, y);
    const bool gives = f.flow > 0;
    (gives ? o.in : o.out) = gives ? f.flow : -f.flow;
    (gives ? o.in_by : o.out_by) = gives ? f.by_b : -f.by_b;
    (gives ? o.in_by_time : o.out_by_time) = (gives ? f.by_a : -f.by_a) * outlet_rate;
    return o;
  }
  const auto add = [&](const gas::SlopedFlow& in, double in_share, const gas::SlopedFlow& out,
                       double out_share) {
    o.in += in_share * in.flow;
    o.in_by += in_share * in.by_b;
    o.out += out_share * out.flow;
    o.out_by += out_share * out.by_a;
  };
  const double in = open_share(inlet, now.t, valves), out = open_share(inlet + 1, now.t, valves);
  if (in > 0) add(quick::flow(sloped, tap.flow, now.y_supply, y), in, {}, 0);
  if (out > 0) add({}, 0, quick::flow(sloped, taps_[v + 1].flow, y, 1.0), out);
  if (valves.leaking)
    faults_.each(valves.faults, [&](std::size_t k, const AirFault& f) {
      if (f.what != AirFault::What::seat_leak || f.of / 2 != inlet / 2) return;
      if (f.of == inlet)
        add(gas::sloped_leak_flow_y(broken_[k].leak, now.y_supply, y), 1, {}, 0);
      else
        add({}, 0, gas::sloped_leak_flow_y(broken_[k].leak, y, 1.0), 1);
    });
  return o;
}

extern template class ValveBank<4>;
extern template class ValveBank<8>;
extern template class ValveBank<48>;

}  // namespace sinew::air
