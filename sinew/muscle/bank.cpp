#include "sinew/muscle/bank.h"

#include <algorithm>
#include <stdexcept>

#include "sinew/actuator/braid.h"

namespace sinew::muscle {

Bank::Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
           std::span<const AirFault> faults)
    : size_(static_cast<int>(muscles.size())),
      air_(air),
      supply_y_(units::power(supply.pressure / air.atmosphere, 1.0 / 7.0)),
      muscles_(muscles.begin(), muscles.end()),
      braids_(muscles, air),
      faults_(faults) {
  if (!std::ranges::all_of(faults, is_share_of_valve))
    throw std::invalid_argument("a bank has no fault but of valves");
  for (const Muscle& m : muscles_) {
    const gas::Valve::Profile ramp = gas::Valve::Profile::ramp;
    ramping_ = ramping_ || m.inlet.profile == ramp || m.exhaust.profile == ramp;
    const bool three_way = m.inlet.kind == gas::Valve::Kind::three_way;
    flow_.push_back(gas::flow_constants(m.inlet.flow, air));
    flow_.push_back(gas::flow_constants(three_way ? m.inlet.flow : m.exhaust.flow, air));
  }
}

Bank::Valves Bank::valves_at_rest() const {
  Valves valves;
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    valves.shutter[2 * i] = gas::Shutter(muscles_[i].inlet);
    valves.shutter[2 * i + 1] = gas::Shutter(muscles_[i].exhaust);
  }
  refresh(0.0, valves);
  return valves;
}

double Bank::volume(int i, double length) const {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  return m.count * actuator::volume(m.actuator.braid, length) + m.external_volume;
}

double Bank::mass_at(int i, double pressure, double length) const {
  return gas::density(air_, pressure) * volume(i, length);
}

void Bank::electrical(int valve, double t, bool open, Valves& valves) const noexcept {
  valves.shutter[static_cast<std::size_t>(valve)].electrical(t, open);
  look_ahead(valves);
}

// A command can also take a pending change back, so look at all of them.
void Bank::look_ahead(Valves& valves) const noexcept {
  valves.next_change = faults_.next(valves.faults);
  for (int v = 0; v < 2 * size_; ++v) {
    const double next = valves.shutter[static_cast<std::size_t>(v)].next();
    valves.next_change = next < valves.next_change ? next : valves.next_change;
  }
}

void Bank::move(double t, Valves& valves) const noexcept {
  for (int v = 0; v < 2 * size_; ++v) valves.shutter[static_cast<std::size_t>(v)].advance(t);
  faults_.advance(t, valves.faults, [&](const AirFault& f, bool begins) {
    gas::Shutter& shutter = valves.shutter[static_cast<std::size_t>(f.of)];
    if (f.what == AirFault::What::seat_leak) return;
    if (begins)
      shutter.jam(t, f.what == AirFault::What::stuck_open ? 1.0 : 0.0);
    else
      shutter.free(t);
    shutter.advance(t);  // of a valve without delay
  });
  refresh(t, valves);
}

// Returns the open share of the valve's area, its seat being sound: the shutter's, or of the other
// way of a 3-way valve, which opens to the atmosphere when it leaves the supply.
double Bank::fraction(int valve, double t, const Valves& valves) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  const bool other_way =
      valve % 2 == 1 && muscles_[v / 2].inlet.kind == gas::Valve::Kind::three_way;
  return other_way ? 1.0 - valves.shutter[v - 1].fraction(t) : valves.shutter[v].fraction(t);
}

// Shares of area after a change.
void Bank::refresh(double t, Valves& valves) const noexcept {
  valves.open_count = 0;
  for (int v = 0; v < 2 * size_; ++v) {
    double& share = valves.share[static_cast<std::size_t>(v)];
    share = muscle::open_share(faults_.seat(v, valves.faults), fraction(v, t, valves));
    if (share > 0) valves.open[static_cast<std::size_t>(valves.open_count++)] = {v, share};
  }
  look_ahead(valves);
}

double Bank::open_share(int valve, double t, const Valves& valves) const noexcept {
  if (!ramping_) return valves.share[static_cast<std::size_t>(valve)];
  return muscle::open_share(faults_.seat(valve, valves.faults), fraction(valve, t, valves));
}

void Bank::evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                    const Valves& valves, const Reference& reference, Pull& out) const noexcept {
  Lanes y;
  braids_.evaluate(length, rate, mass, reference, out, y);
  for (int i = 0; i < padded(); i += lanes) out.inflow.four(i) = out.outflow.four(i) = Four{};
  if (any_open(valves)) flows(t, y, valves, out);
}

void Bank::flows(double t, const Lanes& y, const Valves& valves, Pull& out) const noexcept {
  const auto through = [&](int valve, double share) {
    const int i = valve / 2;
    const gas::FlowConstants& c = flow_[static_cast<std::size_t>(valve)];
    if (valve % 2 == 0)
      out.inflow[i] = share * gas::flow_y(c, supply_y_, y[i]);
    else
      out.outflow[i] = share * gas::flow_y(c, y[i], 1.0);
  };
  if (ramping_)
    for (int valve = 0; valve < 2 * size_; ++valve) through(valve, open_share(valve, t, valves));
  else
    for (int k = 0; k < valves.open_count; ++k) {
      const Valves::Open& open = valves.open[static_cast<std::size_t>(k)];
      through(open.valve, open.share);
    }
}

}  // namespace sinew::muscle
