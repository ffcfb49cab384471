// muscle/plumbing_faults.cpp - how a plumbing breaks: fault.h has the list of faults.
#include "sinew/muscle/plumbing.h"

namespace sinew::muscle {
namespace {

using What = AirFault::What;

// Returns the slope of a leak's flow near equal pressures  [kg/(s Pa)].
double slope_of(const gas::LeakConstants& leak, double atmosphere) {
  return (leak.hole.linear_gain + leak.slope) / atmosphere;
}

}  // namespace

void Plumbing::add_faults() {
  for (const AirFault& f : faults_.all()) {
    Broken broken{.leak = gas::leak_constants(f.leak, air_)};
    if (f.what == What::supply) broken.y = gas::y_of(air_, f.pressure);
    if (f.what == What::supply && tank_ != none && cut_ == none) cut_ = states_++;
    broken_.push_back(broken);
  }
}

// A shutter that is let go sets off as by an edge at t: with its delay, if its coil can lift it.
void Plumbing::change(const AirFault& fault, bool begins, double t, const AirPull& before,
                      Valves& valves) const noexcept {
  if (fault.what != What::stuck_open && fault.what != What::stuck_shut) return;
  const auto v = static_cast<std::size_t>(fault.of);
  gas::Shutter& shutter = valves[v].shutter;
  if (begins) {
    shutter.jam(t, fault.what == What::stuck_open ? 1.0 : 0.0);
    return;
  }
  const gas::Valve& valve = taps_[v].valve;
  const bool lifted = shutter.fraction(t) > 0;
  const double dp = difference(fault.of, before);
  const bool lifts = lifted || !(valve.fails_above > 0 && dp > valve.fails_above);
  shutter.free(t, gas::delay_at(valve, shutter.command(), dp), lifts);
  shutter.advance(t);  // of a valve without delay
}

bool Plumbing::let_through(const ActingFaults& faults) const noexcept {
  bool any = false;
  if (faults.any())
    faults_.each(faults,
                 [&](std::size_t k, const AirFault&) { any = any || !broken_[k].leak.tight(); });
  return any;
}

// Returns the flow beside a valve's shutter  [kg/s].
double Plumbing::past_seat(int valve, const Now& now, double y_from, double y_to) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == What::seat_leak && f.of == valve)
      flow += gas::leak_flow_y(broken_[k].leak, y_from, y_to);
  });
  return flow;
}

// Returns the flow out of muscle i into the room, through what is broken  [kg/s].
double Plumbing::through_holes(int i, const Now& now, double y) const noexcept {
  double flow = 0;
  faults_.each(now.valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what == What::hole && f.of == i) flow += gas::leak_flow_y(broken_[k].leak, y);
  });
  return flow;
}

bool Plumbing::blocked(int i, const Valves& valves) const noexcept {
  bool is = false;
  if (valves.faults.any())
    faults_.each(valves.faults, [&](std::size_t, const AirFault& f) {
      is = is || (f.what == What::blocked && f.of == i);
    });
  return is;
}

// Returns y of the line to the inlets where the supply has failed, whose pressure goes into the
// look; 0 where it has not  [-].
double Plumbing::failed_line(const Valves& valves, AirPull& out) const noexcept {
  double y = 0;
  faults_.each(valves.faults, [&](std::size_t k, const AirFault& f) {
    if (f.what != What::supply) return;
    y = broken_[k].y;
    out.supply_pressure = f.pressure;
  });
  return y;
}

// Returns the slope of all that leaks out of muscle `pair`, and past the seats of its pair of
// valves, near equal pressures  [kg/(s Pa)].
double Plumbing::slope_of_faults(int pair, const ActingFaults& faults) const noexcept {
  double slope = 0;
  faults_.each(faults, [&](std::size_t k, const AirFault& f) {
    const bool seat = f.what == What::seat_leak && f.of / 2 == pair;
    if (seat || (f.what == What::hole && f.of == pair))
      slope += slope_of(broken_[k].leak, air_.atmosphere);
  });
  return slope;
}

}  // namespace sinew::muscle
