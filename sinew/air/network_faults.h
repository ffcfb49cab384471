// air/network_faults.h - members of AirNetwork: how it breaks. fault.h has the list of faults.
#pragma once

#include "sinew/air/network.h"

namespace sinew::air {

template <int Most>
void AirNetwork<Most>::add_faults() {
  using What = AirFault::What;
  for (const AirFault& f : faults_.all()) {
    Broken broken{.leak = gas::leak_constants(f.leak, air_)};
    if (f.what == What::supply) broken.y = gas::y_of(air_, f.pressure);
    if (f.what == What::supply && tank_ != none && cut_ == none) cut_ = others_++;
    broken_.push_back(broken);
  }
}

// A shutter that is let go sets off as by an edge at t: with its delay, if its coil can lift it.
template <int Most>
void AirNetwork<Most>::change(const AirFault& fault, bool begins, double t, const Answer& before,
                              Valves& valves) const noexcept {
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
  const double dp = difference(fault.of, before, valves);
  const bool lifts = lifted || !(valve.fails_above > 0 && dp > valve.fails_above);
  shutter.free(t, gas::delay_at(valve, shutter.command(), dp), lifts);
  shutter.advance(t);  // of a valve without delay
}

template <int Most>
bool AirNetwork<Most>::let_through(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults,
                 [&](std::size_t k, const AirFault&) { any = any || !broken_[k].leak.tight(); });
  return any;
}

template <int Most>
bool AirNetwork<Most>::is_broken(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults,
                 [&](std::size_t, const AirFault& f) { any = any || !is_share_of_valve(f); });
  return any;
}

// Returns the flow beside a valve's shutter  [kg/s].
template <int Most>
double AirNetwork<Most>::past_seat(int valve, const Now& now, double y_from,
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
double AirNetwork<Most>::through_holes(int i, const Now& now, double y) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == AirFault::What::hole && f.of == i) flow += gas::leak_flow_y(broken_[k].leak, y);
  });
  return flow;
}

template <int Most>
bool AirNetwork<Most>::blocked(int i, const Valves& valves) const noexcept {
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
double AirNetwork<Most>::failed_line(const Valves& valves, Answer& out) const noexcept {
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
double AirNetwork<Most>::slope_of_faults(int pair, const ActingFaults& faults) const noexcept {
  double slope = 0;
  faults_.each(faults, [&](std::size_t k, const AirFault& f) {
    const bool seat = f.what == AirFault::What::seat_leak && f.of / 2 == pair;
    if (seat || (f.what == AirFault::What::hole && f.of == pair))
      slope += (broken_[k].leak.hole.linear_gain + broken_[k].leak.slope) / air_.atmosphere;
  });
  return slope;
}

}  // namespace sinew::air
