#include "sinew/muscle/bank.h"

#include <limits>

#include "sinew/actuator/braid.h"

namespace sinew::muscle {

Bank::Bank(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply)
    : size_(static_cast<int>(muscles.size())),
      air_(air),
      supply_y_(units::power(supply.pressure / air.atmosphere, 1.0 / 7.0)),
      muscles_(muscles.begin(), muscles.end()),
      braids_(muscles, air),
      reference_(braids_.reference()) {
  for (const Muscle& m : muscles_) {
    shutters_.emplace_back(m.inlet);
    shutters_.emplace_back(m.exhaust);
    const bool three_way = m.inlet.kind == gas::Valve::Kind::three_way;
    flow_.push_back(gas::flow_constants(m.inlet.flow, air));
    flow_.push_back(gas::flow_constants(three_way ? m.inlet.flow : m.exhaust.flow, air));
  }
  refresh(0.0);
}

double Bank::volume(int i, double length) const {
  const Muscle& m = muscles_[static_cast<std::size_t>(i)];
  return m.count * actuator::volume(m.actuator.braid, length) + m.external_volume;
}

double Bank::mass_at(int i, double pressure, double length) const {
  return gas::density(air_, pressure) * volume(i, length);
}

void Bank::electrical(int valve, double t, bool open) noexcept {
  shutters_[static_cast<std::size_t>(valve)].electrical(t, open);
  // A command can also take a pending change back, so look at all of them.
  next_change_ = std::numeric_limits<double>::infinity();
  for (const gas::Shutter& s : shutters_)
    next_change_ = s.next() < next_change_ ? s.next() : next_change_;
}

void Bank::move_valves(double t) noexcept {
  for (gas::Shutter& s : shutters_) s.advance(t);
  refresh(t);
}

// Shares of area after a change. A 3-way valve that leaves the supply opens to the atmosphere.
void Bank::refresh(double t) noexcept {
  ramping_ = false;
  open_count_ = 0;
  next_change_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size_; ++i) {
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    const auto inlet = static_cast<std::size_t>(2 * i), exhaust = inlet + 1;
    for (std::size_t v : {inlet, exhaust}) {
      share_[v] = shutters_[v].fraction(t);
      next_change_ = shutters_[v].next() < next_change_ ? shutters_[v].next() : next_change_;
    }
    if (m.inlet.kind == gas::Valve::Kind::three_way) share_[exhaust] = 1.0 - share_[inlet];
    const gas::Valve::Profile ramp = gas::Valve::Profile::ramp;
    ramping_ = ramping_ || m.inlet.profile == ramp || m.exhaust.profile == ramp;
    for (std::size_t v : {inlet, exhaust})
      if (share_[v] > 0)
        open_[static_cast<std::size_t>(open_count_++)] = {static_cast<int>(v), share_[v]};
  }
}

double Bank::open_share(int valve, double t) const noexcept {
  const auto v = static_cast<std::size_t>(valve);
  if (!ramping_) return share_[v];
  const Muscle& m = muscles_[v / 2];
  if (m.inlet.kind == gas::Valve::Kind::three_way && valve % 2 == 1)
    return 1.0 - shutters_[v - 1].fraction(t);
  return shutters_[v].fraction(t);
}

void Bank::evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                    Pull& out) const noexcept {
  Lanes y;
  braids_.evaluate(length, rate, mass, reference_, out, y);
  for (int i = 0; i < padded(); i += lanes) out.inflow.four(i) = out.outflow.four(i) = Four{};
  if (any_open()) flows(t, y, out);
}

void Bank::flows(double t, const Lanes& y, Pull& out) const noexcept {
  const auto through = [&](int valve, double share) {
    const int i = valve / 2;
    const gas::FlowConstants& c = flow_[static_cast<std::size_t>(valve)];
    if (valve % 2 == 0)
      out.inflow[i] = share * gas::flow_y(c, supply_y_, y[i]);
    else
      out.outflow[i] = share * gas::flow_y(c, y[i], 1.0);
  };
  if (ramping_)
    for (int valve = 0; valve < 2 * size_; ++valve) through(valve, open_share(valve, t));
  else
    for (int k = 0; k < open_count_; ++k) {
      const Open& open = open_[static_cast<std::size_t>(k)];
      through(open.valve, open.share);
    }
}

}  // namespace sinew::muscle
