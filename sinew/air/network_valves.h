// air/network_valves.h - members of AirNetwork: its valves and regulators from node to node.
#pragma once

#include "sinew/air/network.h"
#include "sinew/air/network_setup.h"

namespace sinew::air {

// Returns how much higher the pressure is on the side that the valve holds back  [Pa].
template <int Most>
double AirNetwork<Most>::difference(int valve, const Answer& at_node,
                                    const Valves& valves) const noexcept {
  const int pair = valve / 2;
  const double p = pair >= size_ ? at_node.cylinder_pressure[static_cast<std::size_t>(pair - size_)]
                   : line(pair).more || valves.broken ? at_node.manifold[pair]
                                                      : at_node.pressure[pair];
  return valve % 2 == 0 ? at_node.supply_pressure - p : p - air_.atmosphere;
}

template <int Most>
void AirNetwork<Most>::command(const signals::Edge& edge, double t, const Answer& at_node,
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
    const double dp = difference(edge.valve.index, at_node, valves);
    if (edge.open && v.fails_above > 0 && dp > v.fails_above) return;  // its end will be no edge
    valves[i].shutter.electrical(t, edge.open, gas::delay_at(v, edge.open, dp));
  }
  look_ahead(valves);
}

// A command can also take a pending change back, so look at all of them.
template <int Most>
void AirNetwork<Most>::look_ahead(Valves& valves) const noexcept {
  double next = faults_.next(valves.faults);
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    next = std::min(next, valves[v].shutter.next());
    next = std::min(next, valves[v].next_set_at);
  }
  valves.next_change = next;
}

template <int Most>
void AirNetwork<Most>::move(double t, const Answer& before, Valves& valves) const noexcept {
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    typename Valves::Valve& valve = valves[v];
    valve.shutter.advance(t);
    if (valve.next_set_at > t) continue;
    valve.set = valve.next_set;
    valve.set_y = gas::y_of(air_, valve.set);
    valve.next_set_at = never;
  }
  faults_.advance(t, valves.faults,
                  [&](const AirFault& f, bool begins) { change(f, begins, t, before, valves); });
  refresh(t, valves);
}

// Returns the open share of the valve's area, its seat being sound: the shutter's, or of the other
// way of a 3-way valve, which opens to the atmosphere when it leaves the supply.
template <int Most>
double AirNetwork<Most>::fraction(std::size_t v, double t, const Valves& valves) const noexcept {
  const bool other_way = v % 2 == 1 && taps_[v].valve.kind == gas::Valve::Kind::three_way;
  return other_way ? 1.0 - valves[v - 1].shutter.fraction(t) : valves[v].shutter.fraction(t);
}

// Shares of area after a change. A regulator is always open.
template <int Most>
void AirNetwork<Most>::refresh(double t, Valves& valves) const noexcept {
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
double AirNetwork<Most>::open_share(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_ || regulates(taps_[v].valve)) return valves[v].share;
  return air::open_share(faults_.seat(valve, valves.faults), fraction(v, t, valves));
}

}  // namespace sinew::air
