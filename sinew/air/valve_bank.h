// air/valve_bank.h - valves and regulators of a machine with their faults: the positions of their
// shutters from node to node, and the flow through a pair of them.
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
#include "sinew/air/shutters.h"
#include "sinew/air/state.h"
#include "sinew/air/stiff/quick.h"
#include "sinew/gas/air.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/slopes.h"
#include "sinew/gas/valve.h"
#include "sinew/signals/port.h"

namespace sinew::air {

// Returns whether the valve is a regulator, which follows a set point.
inline bool regulates(const gas::Valve& valve) { return valve.kind == gas::Valve::Kind::regulator; }

// Valves for at most `Most` muscles and a cylinder.
template <int Most>
class ValveBank {
 public:
  using State = AirState<Most>;
  using Valves = AirValves<Most>;
  using Memory = AirMemory<Most>;
  using Evaluation = AirEvaluation<Most>;

  // Returns the number of valves. Their order: 2 x muscle + (0 inlet | 1 exhaust), then the
  // cylinder's: up inlet, up exhaust, down inlet, down exhaust.
  int valves() const noexcept { return static_cast<int>(taps_.size()); }
  const gas::Valve& valve(int index) const noexcept { return tap(index).valve; }
  const gas::FlowConstants& flow(int valve) const noexcept { return tap(valve).flow; }
  // Replaces the law of a valve's flow, for steps that are cut where it jumps.
  void set_flow(int valve, const gas::FlowConstants& flow) noexcept {
    taps_[static_cast<std::size_t>(valve)].flow = flow;
  }
  bool ramping() const noexcept { return ramping_; }  // some shutter opens or closes gradually

  // Returns all valves without current, settled, and all set points at the atmosphere's pressure.
  Valves valves_at_rest() const;

  // Returns the law of a valve that is open or shut.
  const ShutterLaw& shutter_law(int index) const noexcept { return tap(index).shutter; }

  // Returns the open share of the valve's area at t [-].
  double open_share(int valve, double t, const Valves& valves) const noexcept;

 protected:
  static constexpr int none = -1;

  // One valve, or regulator, with its flow constants.
  struct Tap {
    gas::Valve valve;
    gas::FlowConstants flow;
    ShutterLaw shutter;
    int outlet = none;    // Kind::regulator: index of the state of its outlet pressure
    bool listed = false;  // its flow depends on the open share alone
  };
  struct Flows {
    double in = 0, out = 0;  // supply to muscle, muscle to room [kg/s]
  };
  // Inputs of the flows of one evaluation, together with the chambers.
  struct FlowInputs {
    double t;         // [s]
    double y_supply;  // y of the line to the inlets
    const State& state;
    const Valves& valves;
    const Memory& memory;
    std::uint64_t ahead = 0;  // muscles whose flows are not needed, a bit each
  };
  // The flows through a pair of valves, their slopes over y and their drift at constant y.
  struct SlopedFlows {
    double in = 0, out = 0;                  // [kg/s]
    double in_by = 0, out_by = 0;            // [kg/s]
    double in_by_time = 0, out_by_time = 0;  // [kg/s^2]
  };
  struct FaultConstants {
    gas::LeakConstants leak;
    double y = 1;  // y of the supply's line
  };

  // Takes the list of faults; the valves are added one by one.
  ValveBank(const gas::Air& air, std::span<const AirFault> faults) : air_(air), faults_(faults) {
    for (const AirFault& f : faults_.all()) {
      FaultConstants broken{.leak = gas::leak_constants(f.leak, air_)};
      if (f.what == AirFault::What::supply) broken.y = gas::y_of(air_, f.pressure);
      fault_constants_.push_back(broken);
    }
  }

  // Return a state other than the masses, its rate in an evaluation, and a valve.
  static double other(const State& s, int i) noexcept {
    return s.other[static_cast<std::size_t>(i)];
  }
  static double& other(State& s, int i) noexcept { return s.other[static_cast<std::size_t>(i)]; }
  static double& rate_of(Evaluation& a, int i) noexcept {
    return a.rate[static_cast<std::size_t>(i)];
  }
  const Tap& tap(int valve) const noexcept { return taps_[static_cast<std::size_t>(valve)]; }

  // Appends a valve.
  void add_tap(const gas::Valve& valve);
  // Applies an electrical edge of a valve at t, or a regulator's set point from t on. `difference`:
  // pressure difference that the valve holds back [Pa].
  void command(const signals::Edge& edge, double t, double difference,
               Valves& valves) const noexcept;
  // Moves valves, set points and faults to t; difference(valve) is called for valves that a fault
  // releases.
  template <class Difference>
  void move(double t, const Difference& difference, Valves& valves) const noexcept;

  // Return the flows through a pair of valves (`inlet` and the next one) that ends at y; the flows
  // with their slopes; and whether both valves are shut and stay so until the next node.
  Flows flows_through(int inlet, const FlowInputs& now, double y) const noexcept;
  SlopedFlows sloped_flows_through(int inlet, const FlowInputs& now, double since_node, double y,
                                   bool sloped) const noexcept;
  bool shut(int inlet, const FlowInputs& now) const noexcept;

  double hole_flow(int i, const FlowInputs& now, double y) const noexcept;
  // Returns whether a fault closes the line of a muscle.
  bool blocked(int i, const Valves& valves) const noexcept;
  double failed_line(const Valves& valves, Evaluation& out) const noexcept;
  double slope_of_faults(int pair, const ActingFaults& faults) const noexcept;

  gas::Air air_;
  gas::PowerSeries of_pressure_{1.0 / 7.0};  // y of a pressure
  std::vector<Tap> taps_;
  FaultSchedule faults_;
  std::vector<FaultConstants> fault_constants_;  // one for each fault
  bool ramping_ = false;

 private:
  double fraction(std::size_t v, double t, const Valves& valves) const noexcept {
    return shutter_fraction(taps_[v].shutter.opposite, v, t, valves);
  }
  double rate_of_share(int valve, double t, const Valves& valves) const noexcept;
  void refresh(double t, Valves& valves) const noexcept;
  template <class Difference>
  void change(const AirFault& fault, bool begins, double t, const Difference& difference,
              Valves& valves) const noexcept;
  bool let_through(const ActingFaults& faults) const noexcept;
  bool is_broken(const ActingFaults& faults) const noexcept;
  double seat_leak_flow(int valve, const FlowInputs& now, double y_from,
                        double y_to) const noexcept;

  bool only_shutters_ = true;  // no faults, regulators, or shutters that open gradually
};

template <int Most>
void ValveBank<Most>::add_tap(const gas::Valve& valve) {
  taps_.push_back({.valve = valve,
                   .flow = gas::flow_constants(valve.flow, air_),
                   .shutter = air::shutter_law(valve, taps_.size())});
  ramping_ = ramping_ || valve.profile == gas::Valve::Profile::ramp;
  only_shutters_ = faults_.empty() && !ramping_ && only_shutters_ && !regulates(valve);
}

template <int Most>
auto ValveBank<Most>::valves_at_rest() const -> Valves {
  Valves valves{};
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    // Constructed in place, so that the padding between its members stays 0 (driven_muscle.h).
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
  }
  const double after = regulates(v)
                           ? next_of(valves[i])
                           : command_shutter(taps_[i].shutter, t, edge.open, difference, valves[i]);
  note_command(
      i, after, taps_.size(), [&] { return faults_.next(valves.faults); }, valves);
}

template <int Most>
template <class Difference>
void ValveBank<Most>::move(double t, const Difference& difference, Valves& valves) const noexcept {
  if (only_shutters_)
    return move_shutters(
        t, taps_.size(), [&](std::size_t v) -> const ShutterLaw& { return taps_[v].shutter; },
        valves);
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

// Updates the open shares after a change. A regulator is always open.
template <int Most>
void ValveBank<Most>::refresh(double t, Valves& valves) const noexcept {
  valves.open_count = 0;
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    const double seat = faults_.seat(static_cast<int>(v), valves.faults);
    const double share =
        regulates(taps_[v].valve) ? 1.0 : air::open_share(seat, fraction(v, t, valves));
    valves[v].share = share;
    valves.next_of[v] = next_of(valves[v]);
    if (share > 0) add_open(v, valves);
  }
  valves.leaking = let_through(valves.faults);
  valves.broken = is_broken(valves.faults);
  find_next_change(taps_.size(), faults_.next(valves.faults), valves);
}

template <int Most>
double ValveBank<Most>::open_share(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_ || regulates(taps_[v].valve)) return valves[v].share;
  return air::open_share(faults_.seat(valve, valves.faults), fraction(v, t, valves));
}

// Returns the rate of the open share from t on, while the shutter moves gradually [1/s].
template <int Most>
double ValveBank<Most>::rate_of_share(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_ || regulates(taps_[v].valve)) return 0;
  const double rate =
      taps_[v].shutter.opposite ? -valves[v - 1].shutter.rate(t) : valves[v].shutter.rate(t);
  return (1.0 - faults_.seat(valve, valves.faults)) * rate;
}

// A released shutter starts as after an edge at t: with its delay, if its coil can lift it.
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
  shutter.advance(t);  // needed if the valve has no delay
}

template <int Most>
bool ValveBank<Most>::let_through(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults, [&](std::size_t k, const AirFault&) {
      any = any || !fault_constants_[k].leak.tight();
    });
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

// Returns the flow that bypasses a valve's shutter [kg/s].
template <int Most>
double ValveBank<Most>::seat_leak_flow(int valve, const FlowInputs& now, double y_from,
                                       double y_to) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == AirFault::What::seat_leak && f.of == valve)
      flow += gas::leak_flow_y(fault_constants_[k].leak, y_from, y_to);
  });
  return flow;
}

// Returns the flow from muscle i to the room through holes by faults [kg/s].
template <int Most>
double ValveBank<Most>::hole_flow(int i, const FlowInputs& now, double y) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == AirFault::What::hole && f.of == i)
      flow += gas::leak_flow_y(fault_constants_[k].leak, y);
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

// Returns y of the line to the inlets if the supply has failed, and writes the line's pressure to
// `out`; else returns 0 [-].
template <int Most>
double ValveBank<Most>::failed_line(const Valves& valves, Evaluation& out) const noexcept {
  double y = 0;
  faults_.each(valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what != AirFault::What::supply) return;
    y = fault_constants_[k].y;
    out.supply_pressure = f.pressure;
  });
  return y;
}

// Returns the slope near equal pressures of the leaks by faults of muscle `pair`, and past the
// seats of its valves [kg/(s Pa)].
template <int Most>
double ValveBank<Most>::slope_of_faults(int pair, const ActingFaults& faults) const noexcept {
  double slope = 0;
  faults_.each(faults, [&](std::size_t k, const AirFault& f) {
    const bool seat = f.what == AirFault::What::seat_leak && f.of / 2 == pair;
    if (seat || (f.what == AirFault::What::hole && f.of == pair))
      slope += (fault_constants_[k].leak.hole.linear_gain + fault_constants_[k].leak.slope) /
               air_.atmosphere;
  });
  return slope;
}

template <int Most>
bool ValveBank<Most>::shut(int inlet, const FlowInputs& now) const noexcept {
  const Valves& valves = now.valves;
  const auto stays_shut = [&](int valve) {
    return !(open_share(valve, now.t, valves) > 0) && rate_of_share(valve, now.t, valves) == 0;
  };
  return !valves.leaking && stays_shut(inlet) && stays_shut(inlet + 1);
}

template <int Most>
auto ValveBank<Most>::flows_through(int inlet, const FlowInputs& now, double y) const noexcept
    -> Flows {
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
    flows.in += seat_leak_flow(inlet, now, now.y_supply, y);
    flows.out += seat_leak_flow(inlet + 1, now, y, 1.0);
  }
  return flows;
}

// Regulators follow their lag since the node; shutters move linearly between two nodes.
template <int Most>
auto ValveBank<Most>::sloped_flows_through(int inlet, const FlowInputs& now, double since_node,
                                           double y, bool sloped) const noexcept -> SlopedFlows {
  const auto v = static_cast<std::size_t>(inlet);
  const Tap& tap = taps_[v];
  const Valves& valves = now.valves;
  SlopedFlows o;
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
  const double in_rate = sloped ? rate_of_share(inlet, now.t, valves) : 0.0,
               out_rate = sloped ? rate_of_share(inlet + 1, now.t, valves) : 0.0;
  if (in > 0 || in_rate != 0) {
    const gas::SlopedFlow whole = quick::flow(sloped, tap.flow, now.y_supply, y);
    add(whole, in, {}, 0);
    o.in_by_time = in_rate * whole.flow;
  }
  if (out > 0 || out_rate != 0) {
    const gas::SlopedFlow whole = quick::flow(sloped, taps_[v + 1].flow, y, 1.0);
    add({}, 0, whole, out);
    o.out_by_time = out_rate * whole.flow;
  }
  if (valves.leaking)
    faults_.each(valves.faults, [&](std::size_t k, const AirFault& f) {
      if (f.what != AirFault::What::seat_leak || f.of / 2 != inlet / 2) return;
      if (f.of == inlet)
        add(gas::sloped_leak_flow_y(fault_constants_[k].leak, now.y_supply, y), 1, {}, 0);
      else
        add({}, 0, gas::sloped_leak_flow_y(fault_constants_[k].leak, y, 1.0), 1);
    });
  return o;
}

extern template class ValveBank<4>;
extern template class ValveBank<8>;
extern template class ValveBank<48>;

}  // namespace sinew::air
