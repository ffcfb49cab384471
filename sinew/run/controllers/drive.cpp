#include "sinew/run/controllers/drive.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "sinew/gas/delay.h"

namespace sinew::run {

using signals::Tick;
using DriveKind = experiment::Stand::Drive::Kind;

namespace {

static_assert(std::is_trivially_copyable_v<Drive::State>);

Tick whole_ticks(double seconds) { return std::llround(seconds / signals::tick_seconds); }

}  // namespace

Drive::Drive(const experiment::Experiment& e)
    : drive_(e.stand->drive),
      length_(drive_.lengths.empty() ? signals::Schedule(drive_.desired)
                                     : signals::Schedule(drive_.lengths)),
      duty_(drive_.duties.empty() ? signals::Schedule(drive_.duty)
                                  : signals::Schedule(signals::steps_of(drive_.duties))),
      air_(e.air),
      supply_(e.supply.pressure),
      period_(whole_ticks(drive_.period)) {
  for (const actuator::Actuator& a : e.actuators)
    if (a.name == e.stand->element.actuator)
      bundle_ = {.actuator = a,
                 .count = e.stand->element.count,
                 .external_volume = e.stand->element.external_volume};
  if (const gas::Valve* v = find_valve(e, e.stand->element.inlet)) inlet_ = *v;
  three_way_ = inlet_.kind == gas::Valve::Kind::three_way;
  if (const gas::Valve* v = find_valve(e, e.stand->element.exhaust)) exhaust_ = *v;
  if (three_way_) exhaust_ = inlet_;

  for (std::size_t i = 0; i < e.stand->sensors.size(); ++i)
    if (e.stand->sensors[i].name == drive_.sensor) {
      sensor_ = i;
      length_sensor_ = e.stand->sensors[i];
    }

  const Tick end = experiment::last_tick(e);
  for (const experiment::Stand::Drive::Pulse& p : drive_.pulses) {
    const std::uint8_t valve = p.exhaust ? 1 : 0;
    const Tick at = whole_ticks(p.at), open = whole_ticks(p.open);
    if (at >= end || open == 0) continue;
    planned_.push_back({.at = at, .valve = {valve}, .open = true});
    planned_.push_back({.at = at + open, .valve = {valve}, .open = false});
  }
  // A valve that shuts and opens at one tick opens last and stays open.
  std::ranges::stable_sort(planned_, {},
                           [](const signals::Edge& edge) { return std::pair(edge.at, edge.open); });
  if (bundle_.actuator.braid.turns > 0 && e.stand->start_length > 0)
    state_.assumed_air = air_at(bundle_, air_, e.stand->start_length, e.stand->start_pressure);
  command_[0].enabled = command_[0].timed = true;
  command_[0].openings = {};
}

// Returns the commanded duty of a 3-way valve that holds the muscle at a length.
double Drive::hold(double length) const noexcept {
  const double load = drive_.assumed_load;
  const double p = holding_pressure(bundle_, length, load, air_.atmosphere, supply_);
  const double d = steady_duty(inlet_.flow, exhaust_.flow, air_, supply_, p);
  const gas::Delays delays = gas::delays(inlet_);
  return commanded_duty(d, delays.opening, delays.closing, drive_.period);
}

// Returns, for a 3-way valve, the duty that holds; for two 2-way valves, the missing air as one
// dose per period.
DriveShares Drive::feed_forward(double length) noexcept {
  if (three_way_) return {hold(length), 0};
  const double p = holding_pressure(bundle_, length, drive_.assumed_load, air_.atmosphere, supply_);
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

DriveShares Drive::feedback(double length, const MachineState& state) const noexcept {
  const signals::Reading r = state.reading(sensor_);
  if (state_.first || r.status != signals::Status::ok) return {};
  const double error = robot::quantity(length_sensor_, r.counts) - length;
  if (drive_.law == experiment::Stand::Drive::Law::on_off)
    return on_off(error, drive_.dead_band, three_way_, state_.shares.inlet);
  return proportional(error, drive_.gain, drive_.dead_band, three_way_,
                      three_way_ ? hold(length) : 0.0);
}

DriveShares Drive::decide(const MachineState& state) noexcept {
  const DriveSetpoint& setpoint = state_.setpoint;
  switch (drive_.kind) {
    case DriveKind::none:
    case DriveKind::pulses:
      return {};
    case DriveKind::pwm:
      return {setpoint.duty, three_way_ ? 0.0 : 1 - setpoint.duty};
    case DriveKind::feed_forward:
      return feed_forward(setpoint.length);
    case DriveKind::feedback:
      return feedback(setpoint.length, state);
  }
  return {};
}

// Returns the opening of that share, which begins with the period.
control::Opening Drive::opening(double share) const noexcept {
  const Tick open = std::llround(share * static_cast<double>(period_));
  return {0, static_cast<std::uint16_t>(std::clamp<Tick>(open, 0, period_))};
}

// Converts the planned edges of the period into openings. A valve opens at most once in a period
// and shuts at most once (experiment/check.cpp); if it shuts and opens at one tick, it stays open.
// Edges before t belong to periods whose telemetry was lost.
void Drive::plan_openings(Tick t) noexcept {
  const auto period = static_cast<std::uint16_t>(period_);
  std::array<control::Opening, 2> out{};
  for (std::size_t v = 0; v < out.size(); ++v)
    if (state_.open[v]) out[v] = {0, period};
  for (; state_.next < planned_.size() && planned_[state_.next].at < t + period_; ++state_.next) {
    const signals::Edge& edge = planned_[state_.next];
    control::Opening& opening = out[edge.valve.index];
    if (std::exchange(state_.open[edge.valve.index], edge.open) == edge.open) continue;
    const auto at = static_cast<std::uint16_t>(std::max<Tick>(edge.at - t, 0));
    if (!edge.open)
      opening.until = at;
    else if (opening.from == opening.until)
      opening = {at, period};
    else
      opening = opening.until == at ? control::Opening{opening.from, period}
                                    : control::Opening{at, opening.until};
  }
  command_[0].openings = {out[0], out[1]};
}

// Under pwm the exhaust opens when the inlet shuts, else at the start of the period.
const MachineCommand& Drive::update(const MachineState& state, Tick t) noexcept {
  const double at = static_cast<double>(t) * signals::tick_seconds;
  state_.setpoint = {length_.at(at), duty_.at(at)};
  state_.shares = decide(state);
  state_.first = false;
  if (drive_.kind == DriveKind::pulses) {
    plan_openings(t);
    return command_;
  }
  control::Openings& out = command_[0].openings;
  out = {opening(state_.shares.inlet), opening(state_.shares.exhaust)};
  if (drive_.kind == DriveKind::pwm && !three_way_)
    out.exhaust = {out.inlet.until, static_cast<std::uint16_t>(period_)};
  return command_;
}

}  // namespace sinew::run
