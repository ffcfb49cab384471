#include "sinew/run/stand/drive.h"

#include <algorithm>
#include <cmath>

#include "sinew/gas/delay.h"

namespace sinew::rig {

using signals::Tick;

namespace {

Tick ticks(double seconds) { return std::llround(seconds / signals::tick_seconds); }

bool earlier(const signals::Edge& a, const signals::Edge& b) { return a.at < b.at; }

}  // namespace

Wishes::Wishes(const Experiment& e)
    : length_(e.drive.lengths.empty() ? plant::Schedule(e.drive.desired)
                                      : plant::Schedule(e.drive.lengths)),
      duty_(e.drive.duties.empty() ? plant::Schedule(e.drive.duty)
                                   : plant::Schedule(steps_of(e.drive.duties))) {}

Controller::Controller(const Experiment& e, Tick end)
    : drive_(e.drive), air_(e.air), supply_(e.supply.pressure) {
  for (const actuator::Actuator& a : e.actuators)
    if (a.name == e.element.actuator)
      bundle_ = {
          .actuator = a, .count = e.element.count, .external_volume = e.element.external_volume};
  if (const gas::Valve* v = find_valve(e, e.element.inlet)) inlet_ = *v;
  three_way_ = inlet_.kind == gas::Valve::Kind::three_way;
  if (const gas::Valve* v = find_valve(e, e.element.exhaust)) exhaust_ = *v;
  if (three_way_) exhaust_ = inlet_;

  const Tick period = ticks(drive_.period);
  scan_.period = static_cast<std::uint16_t>(period);
  for (std::size_t i = 0; i < e.sensors.size(); ++i) {
    const auto read = static_cast<std::uint16_t>(period - static_cast<Tick>(e.sensors.size() - i));
    conversions_.push_back({{static_cast<std::uint8_t>(i)}, std::uint16_t(read - 1), read});
    if (e.sensors[i].name == drive_.sensor) {
      sensor_ = static_cast<int>(i);
      length_sensor_ = e.sensors[i];
    }
  }
  scan_.conversions = conversions_;
  seen_.reading.resize(e.sensors.size(), {0, signals::Status::late});

  for (const Drive::Pulse& p : drive_.pulses) {
    const std::uint8_t valve = p.exhaust ? 1 : 0;
    const Tick at = ticks(p.at);
    if (at >= end) continue;
    planned_.push_back({.at = at, .valve = {valve}, .open = true});
    planned_.push_back({.at = at + ticks(p.open), .valve = {valve}, .open = false});
  }
  std::ranges::stable_sort(planned_, earlier);
  pending_.reserve(planned_.size() + 8);
  if (bundle_.actuator.braid.turns > 0 && e.start_length > 0)
    believed_air_ = air_at(bundle_, air_, e.start_length, e.start_pressure);
}

// Of a 3-way valve, so that the muscle stays there.
double Controller::hold(double length) const noexcept {
  const double load = drive_.believed_load;
  const double p = holding_pressure(bundle_, length, load, air_.atmosphere, supply_);
  const double d = steady_duty(inlet_.flow, exhaust_.flow, air_, supply_, p);
  const gas::Delays delays = gas::delays(inlet_);
  return commanded_duty(d, delays.opening, delays.closing, drive_.period);
}

// 3-way: the duty that holds. Two 2-way valves: the air that is missing, as one dose per period.
Shares Controller::feed_forward(double length) noexcept {
  if (three_way_) return {hold(length), 0};
  const double p =
      holding_pressure(bundle_, length, drive_.believed_load, air_.atmosphere, supply_);
  const double missing = air_at(bundle_, air_, length, p) - believed_air_;
  const double flow = missing > 0 ? gas::mass_flow(inlet_.flow, air_, supply_, p)
                                  : gas::mass_flow(exhaust_.flow, air_, p, air_.atmosphere);
  if (!(flow > 0)) return {};
  const gas::Delays delays = gas::delays(missing > 0 ? inlet_ : exhaust_);
  const double open = std::fabs(missing) / flow;
  if (open < signals::tick_seconds) return {};
  const double told = std::min(open + delays.opening - delays.closing, drive_.period);
  believed_air_ += (missing > 0 ? flow : -flow) * std::min(open, drive_.period);
  const double share = told / drive_.period;
  return missing > 0 ? Shares{share, 0} : Shares{0, share};
}

Shares Controller::feedback(double length) noexcept {
  const signals::Reading r = seen_.reading[static_cast<std::size_t>(sensor_)];
  if (r.status != signals::Status::ok) return {};  // nothing is known yet
  const double error = plant::quantity(length_sensor_, r.counts) - length;
  if (drive_.law == Drive::Law::on_off)
    return on_off(error, drive_.dead_band, three_way_, seen_.shares.inlet);
  return proportional(error, drive_.gain, drive_.dead_band, three_way_,
                      three_way_ ? hold(length) : 0.0);
}

Shares Controller::decide(const Wish& wish) noexcept {
  switch (drive_.kind) {
    case Drive::Kind::none:
    case Drive::Kind::pulses:
      return {};
    case Drive::Kind::pwm:
      return three_way_ ? Shares{wish.duty, 0} : Shares{wish.duty, 1 - wish.duty};
    case Drive::Kind::feed_forward:
      return feed_forward(wish.length);
    case Drive::Kind::feedback:
      return feedback(wish.length);
  }
  return {};
}

void Controller::set(std::uint8_t valve, Tick at, bool open) noexcept {
  if (open_[valve] == open) return;
  open_[valve] = open;
  pending_.push_back({.at = at, .valve = {valve}, .open = open});
}

// From the start of the period on; a pulse of the whole period has no end in it.
void Controller::pulse(std::uint8_t valve, double share) noexcept {
  const Tick open = std::llround(share * scan_.period);
  set(valve, period_start_, open > 0);
  if (open > 0 && open < scan_.period) set(valve, period_start_ + open, false);
}

void Controller::command(const Wish& wish) noexcept {
  if (!first_) period_start_ += scan_.period;
  first_ = false;
  seen_.wish = wish;
  seen_.shares = decide(wish);

  pending_.clear();
  next_pending_ = 0;
  if (drive_.kind == Drive::Kind::pulses) {
    const Tick end = period_start_ + scan_.period;
    for (; next_planned_ < planned_.size() && planned_[next_planned_].at < end; ++next_planned_)
      pending_.push_back(planned_[next_planned_]);
    return;
  }
  if (drive_.kind == Drive::Kind::none) return;
  pulse(0, seen_.shares.inlet);
  if (three_way_) return;
  // The exhaust opens where the inlet shuts under pwm, at the start of the period else.
  if (drive_.kind == Drive::Kind::pwm) {
    const Tick open = std::llround(seen_.shares.inlet * scan_.period);
    set(1, period_start_, open == 0);
    if (open < scan_.period) set(1, period_start_ + open, true);
  } else {
    pulse(1, seen_.shares.exhaust);
  }
  // Two valves at most, each in order: put them in one row without taking memory.
  for (std::size_t i = 1; i < pending_.size(); ++i)
    for (std::size_t k = i; k > 0 && earlier(pending_[k], pending_[k - 1]); --k)
      std::swap(pending_[k], pending_[k - 1]);
}

std::span<const signals::Edge> Controller::edges(Tick t) noexcept {
  const std::size_t begin = next_pending_;
  while (next_pending_ < pending_.size() && pending_[next_pending_].at <= t) ++next_pending_;
  return {pending_.data() + begin, next_pending_ - begin};
}

const signals::Conversion* Controller::due(Tick t) noexcept {
  const Tick at = t % scan_.period;
  for (const signals::Conversion& c : conversions_)
    if (c.read == at) return &c;
  return nullptr;
}

void Controller::take(const signals::Conversion& c, signals::Reading reading, Tick) noexcept {
  seen_.reading[c.channel.index] = reading;
  if (reading.status == signals::Status::ok || reading.status == signals::Status::late) return;
  seen_.fault = reading.status;
  seen_.phase = control::Phase::off;
}

Tick Controller::next_event(Tick t) const noexcept {
  Tick next = period_start_ + scan_.period;
  if (next_pending_ < pending_.size()) next = std::min(next, pending_[next_pending_].at);
  for (const signals::Conversion& c : conversions_)
    if (period_start_ + c.read > t) next = std::min(next, period_start_ + c.read);
  return next;
}

}  // namespace sinew::rig
