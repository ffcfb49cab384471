#include "sinew/run/controllers/drive.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "sinew/gas/delay.h"

namespace sinew::run {

using signals::Tick;
using DriveKind = experiment::Stand::Drive::Kind;

namespace {

Tick whole_ticks(double seconds) { return std::llround(seconds / signals::tick_seconds); }

bool earlier(const signals::Edge& a, const signals::Edge& b) { return a.at < b.at; }

}  // namespace

DriveSchedule::DriveSchedule(const experiment::Experiment& e)
    : length_(e.stand->drive.lengths.empty() ? signals::Schedule(e.stand->drive.desired)
                                             : signals::Schedule(e.stand->drive.lengths)),
      duty_(e.stand->drive.duties.empty()
                ? signals::Schedule(e.stand->drive.duty)
                : signals::Schedule(signals::steps_of(e.stand->drive.duties))) {}

Drive::Drive(const experiment::Experiment& e, Tick end)
    : drive_(e.stand->drive), air_(e.air), supply_(e.supply.pressure) {
  for (const actuator::Actuator& a : e.actuators)
    if (a.name == e.stand->element.actuator)
      bundle_ = {.actuator = a,
                 .count = e.stand->element.count,
                 .external_volume = e.stand->element.external_volume};
  if (const gas::Valve* v = find_valve(e, e.stand->element.inlet)) inlet_ = *v;
  three_way_ = inlet_.kind == gas::Valve::Kind::three_way;
  if (const gas::Valve* v = find_valve(e, e.stand->element.exhaust)) exhaust_ = *v;
  if (three_way_) exhaust_ = inlet_;

  const Tick period = whole_ticks(drive_.period);
  scan_.period = static_cast<std::uint16_t>(period);
  for (std::size_t i = 0; i < e.stand->sensors.size(); ++i) {
    const auto read =
        static_cast<std::uint16_t>(period - static_cast<Tick>(e.stand->sensors.size() - i));
    conversions_.push_back({{static_cast<std::uint8_t>(i)}, std::uint16_t(read - 1), read});
    if (e.stand->sensors[i].name == drive_.sensor) {
      sensor_ = static_cast<int>(i);
      length_sensor_ = e.stand->sensors[i];
    }
  }
  scan_.conversions = conversions_;
  reading_.resize(e.stand->sensors.size(), {0, signals::Status::late});

  for (const experiment::Stand::Drive::Pulse& p : drive_.pulses) {
    const std::uint8_t valve = p.exhaust ? 1 : 0;
    const Tick at = whole_ticks(p.at);
    if (at >= end) continue;
    planned_.push_back({.at = at, .valve = {valve}, .open = true});
    planned_.push_back({.at = at + whole_ticks(p.open), .valve = {valve}, .open = false});
  }
  std::ranges::stable_sort(planned_, earlier);
  if (bundle_.actuator.braid.turns > 0 && e.stand->start_length > 0)
    state_.assumed_air = air_at(bundle_, air_, e.stand->start_length, e.stand->start_pressure);
}

// Of a 3-way valve, so that the muscle stays there.
double Drive::hold(double length) const noexcept {
  const double load = drive_.believed_load;
  const double p = holding_pressure(bundle_, length, load, air_.atmosphere, supply_);
  const double d = steady_duty(inlet_.flow, exhaust_.flow, air_, supply_, p);
  const gas::Delays delays = gas::delays(inlet_);
  return commanded_duty(d, delays.opening, delays.closing, drive_.period);
}

// 3-way: the duty that holds. Two 2-way valves: the air that is missing, as one dose per period.
DriveShares Drive::feed_forward(double length) noexcept {
  if (three_way_) return {hold(length), 0};
  const double p =
      holding_pressure(bundle_, length, drive_.believed_load, air_.atmosphere, supply_);
  const double missing = air_at(bundle_, air_, length, p) - state_.assumed_air;
  const double flow = missing > 0 ? gas::mass_flow(inlet_.flow, air_, supply_, p)
                                  : gas::mass_flow(exhaust_.flow, air_, p, air_.atmosphere);
  if (!(flow > 0)) return {};
  const gas::Delays delays = gas::delays(missing > 0 ? inlet_ : exhaust_);
  const double open = std::fabs(missing) / flow;
  if (open < signals::tick_seconds) return {};
  const double told = std::min(open + delays.opening - delays.closing, drive_.period);
  state_.assumed_air += (missing > 0 ? flow : -flow) * std::min(open, drive_.period);
  const double share = told / drive_.period;
  return missing > 0 ? DriveShares{share, 0} : DriveShares{0, share};
}

DriveShares Drive::feedback(double length) noexcept {
  const signals::Reading r = reading_[static_cast<std::size_t>(sensor_)];
  if (r.status != signals::Status::ok) return {};  // nothing is known yet
  const double error = robot::quantity(length_sensor_, r.counts) - length;
  if (drive_.law == experiment::Stand::Drive::Law::on_off)
    return on_off(error, drive_.dead_band, three_way_, state_.seen.shares.inlet);
  return proportional(error, drive_.gain, drive_.dead_band, three_way_,
                      three_way_ ? hold(length) : 0.0);
}

DriveShares Drive::decide(const DriveSetpoint& setpoint) noexcept {
  switch (drive_.kind) {
    case DriveKind::none:
    case DriveKind::pulses:
      return {};
    case DriveKind::pwm:
      return {setpoint.duty, three_way_ ? 0.0 : 1 - setpoint.duty};
    case DriveKind::feed_forward:
      return feed_forward(setpoint.length);
    case DriveKind::feedback:
      return feedback(setpoint.length);
  }
  return {};
}

void Drive::set(std::uint8_t valve, Tick at, bool open) noexcept {
  if (state_.open[valve] == open) return;
  state_.open[valve] = open;
  state_.of_period[state_.pending++] = {.at = at, .valve = {valve}, .open = open};
}

// From the start of the period on; a pulse of the whole period has no end in it.
void Drive::pulse(std::uint8_t valve, double share) noexcept {
  const Tick open = std::llround(share * scan_.period);
  set(valve, state_.period_start, open > 0);
  if (open > 0 && open < scan_.period) set(valve, state_.period_start + open, false);
}

void Drive::command(const DriveSetpoint& setpoint) noexcept {
  if (!state_.first) state_.period_start += scan_.period;
  state_.first = false;
  state_.seen.setpoint = setpoint;
  state_.seen.shares = decide(setpoint);
  if (drive_.kind == DriveKind::pulses || drive_.kind == DriveKind::none) return;

  state_.next = state_.pending = 0;
  pulse(0, state_.seen.shares.inlet);
  if (three_way_) return;
  // The exhaust opens where the inlet shuts under pwm, at the start of the period else.
  if (drive_.kind == DriveKind::pwm) {
    const Tick open = std::llround(state_.seen.shares.inlet * scan_.period);
    set(1, state_.period_start, open == 0);
    if (open < scan_.period) set(1, state_.period_start + open, true);
  } else {
    pulse(1, state_.seen.shares.exhaust);
  }
  // Two valves at most, each in order: put them in one row without taking memory.
  for (std::size_t i = 1; i < state_.pending; ++i)
    for (std::size_t k = i; k > 0 && earlier(state_.of_period[k], state_.of_period[k - 1]); --k)
      std::swap(state_.of_period[k], state_.of_period[k - 1]);
}

std::span<const signals::Edge> Drive::waiting() const noexcept {
  const std::span<const signals::Edge> all =
      drive_.kind == DriveKind::pulses
          ? std::span<const signals::Edge>(planned_)
          : std::span<const signals::Edge>(state_.of_period.data(), state_.pending);
  return all.subspan(state_.next);
}

std::span<const signals::Edge> Drive::edges(Tick t) noexcept {
  const std::span<const signals::Edge> all = waiting();
  std::size_t due = 0;
  while (due < all.size() && all[due].at <= t) ++due;
  state_.next += due;
  return all.first(due);
}

const signals::Conversion* Drive::due(Tick t) noexcept {
  const Tick at = t % scan_.period;
  for (const signals::Conversion& c : conversions_)
    if (c.read == at) return &c;
  return nullptr;
}

void Drive::take(const signals::Conversion& c, signals::Reading reading, Tick) noexcept {
  reading_[c.channel.index] = reading;
  if (reading.status == signals::Status::ok || reading.status == signals::Status::late) return;
  state_.seen.fault = reading.status;
  state_.seen.fault_channel = c.channel;
  state_.seen.phase = control::Phase::off;
}

Tick Drive::next_event(Tick t) const noexcept {
  Tick next = state_.period_start + scan_.period;
  if (const auto edges = waiting(); !edges.empty()) next = std::min(next, edges.front().at);
  for (const signals::Conversion& c : conversions_)
    if (state_.period_start + c.read > t) next = std::min(next, state_.period_start + c.read);
  return next;
}

std::size_t Drive::state_size() const noexcept {
  return sizeof(State) + reading_.size() * sizeof(signals::Reading);
}

void Drive::save(std::span<std::byte> out) const noexcept {
  static_assert(std::is_trivially_copyable_v<State>);
  std::memcpy(out.data(), &state_, sizeof state_);
  if (!reading_.empty())
    std::memcpy(out.data() + sizeof state_, reading_.data(), out.size() - sizeof state_);
}

void Drive::restore(std::span<const std::byte> saved) noexcept {
  std::memcpy(&state_, saved.data(), sizeof state_);
  if (!reading_.empty())
    std::memcpy(reading_.data(), saved.data() + sizeof state_, saved.size() - sizeof state_);
}

}  // namespace sinew::run
