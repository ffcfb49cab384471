#include "sinew/control/supervise/supervisor.h"

namespace sinew::control {

using signals::Channel;
using signals::Conversion;
using signals::Edge;
using signals::Reading;
using signals::Status;
using signals::Tick;

namespace {

// Returns a limit as a signed number; a larger one is clamped.
std::int32_t shown(std::uint32_t limit) noexcept {
  constexpr std::uint32_t most = 0x7fffffffu;
  return static_cast<std::int32_t>(limit < most ? limit : most);
}

std::int32_t distance(std::int32_t a, std::int32_t b) noexcept { return a < b ? b - a : a - b; }

bool within(std::int32_t x, std::int32_t low, std::int32_t high) noexcept {
  return x >= low && x <= high;
}

bool possible(const Duties& d) noexcept {
  for (const std::int32_t duty :
       {d.flexor_inlet, d.flexor_exhaust, d.extensor_inlet, d.extensor_exhaust})
    if (!within(duty, 0, signals::max_duty)) return false;
  return true;
}

}  // namespace

const char* problem(const SuperviseConfig& config) noexcept {
  for (const SensorLimits& s : config.sensor) {
    if (s.low > s.high) return "a sensor's plausible range ends before it begins";
    if (s.max_step == 0) return "a sensor's max_step must not be 0";
    if (s.joint >= static_cast<std::int8_t>(max_joints)) return "a sensor's joint is not there";
  }
  for (const CommandLimits& c : config.command) {
    if (c.low > c.high || c.low < -angle_limit || c.high > angle_limit)
      return "the range of a commanded angle must lie within the laws'";
    if (c.max_step <= 0) return "a command's max_step must be above 0";
    if (!(c.max_stiffness >= 0 && c.max_stiffness <= stiffness_limit) ||
        !(c.max_gain >= 0 && c.max_gain <= gain_limit))
      return "limits of stiffness and gains must not be beyond the laws'";
  }
  if (config.bad_readings == 0 || config.hold_commands == 0 || config.frozen_scans == 0)
    return "counts in a row must not be 0";
  if (config.vent_commands < config.hold_commands) return "hold comes before vent";
  if (config.gap_shut == 0 || config.gap_vent < config.gap_shut)
    return "gap_shut must be at least 1 and not above gap_vent";
  return nullptr;
}

Supervisor::Supervisor(const JointControllerConfig& machine, const SuperviseConfig& limits) noexcept
    : controller_(machine), limits_(limits), good_(rest_command(machine)) {}

// Returns whether the run has not ended yet.
bool Supervisor::active() const noexcept {
  return state().phase == Phase::startup || state().phase == Phase::running;
}

void Supervisor::trip(const Trip& trip, Tick vent_at) noexcept {
  if (!active()) return;
  supervised_.trip = trip;
  controller_.trip(Status::fault, trip.channel, vent_at);
}

void Supervisor::end_run(Trip::Cause cause, std::uint32_t limit, Tick t) noexcept {
  trip({.cause = cause, .at = t, .high = shown(limit)}, t);
}

// --- the clock ----------------------------------------------------------------------------------

// Checks, at the first call of a new tick, that it is the announced one.
void Supervisor::enter(Tick t) noexcept {
  if (t <= now_) return;
  const Tick announced = now_ < 0 ? t : every_tick_ ? now_ + 1 : controller_.next_event(now_);
  now_ = t;
  if (t > announced) gap(announced, t);
}

void Supervisor::gap(Tick announced, Tick t) noexcept {
  constexpr Tick most = 0x7fffffff;
  const auto late = static_cast<std::uint32_t>(t - announced < most ? t - announced : most);
  ++supervised_.gaps;
  if (late > supervised_.worst_gap) supervised_.worst_gap = late;

  controller_.skip_to(t);
  if (late >= limits_.gap_vent) {
    trip({.cause = Trip::Cause::gap, .at = t, .high = shown(limits_.gap_vent)}, t);
    return;
  }
  if (!active()) return;
  if (late >= limits_.gap_shut) controller_.shut_inlets(t);
  for (Tick skipped = announced; skipped < t; ++skipped)
    if (const Conversion* c = controller_.due(skipped)) skip(*c, t);
}

// Handles a reading that was not taken in time. If it should have started a joint's law, the
// joint's valves are shut, since they would otherwise keep their state for a period.
void Supervisor::skip(const Conversion& conversion, Tick t) noexcept {
  count_scan(conversion.channel);
  if (state().phase != Phase::running) return;
  for (std::size_t j = 0; j < config().joints; ++j)
    if (config().joint[j].law_tick == conversion.read) controller_.shut_valves(j, t);
}

Tick Supervisor::next_event(Tick t) noexcept {
  enter(t);
  return controller_.next_event(t);
}

bool Supervisor::starts_period(Tick t) noexcept {
  enter(t);
  return controller_.starts_period(t);
}

std::span<const Edge> Supervisor::edges(Tick t) noexcept {
  enter(t);
  if (bad_commands_ == limits_.vent_commands) {
    trip({.cause = Trip::Cause::command,
          .at = t,
          .high = shown(limits_.vent_commands),
          .joint = bad_joint_},
         t);
  } else if (supervised_.holding && state().phase == Phase::running) {
    for (std::size_t j = 0; j < config().joints; ++j) controller_.shut_valves(j, t);
  }
  return controller_.edges(t);
}

const Conversion* Supervisor::due(Tick t) noexcept {
  enter(t);
  return controller_.due(t);
}

// --- readings -----------------------------------------------------------------------------------

// Passes a rejected reading on as one that is invalid.
void Supervisor::take(const Conversion& conversion, Reading reading, Tick t) noexcept {
  enter(t);
  const std::size_t i = conversion.channel.index;
  // After the end of a run readings are no longer checked or counted, since no law uses them.
  const bool judged = supervised_.trip.cause == Trip::Cause::none;
  if (judged && i < max_channels && reading.status == Status::ok) {
    supervised_.sensor[i].counts = reading.counts;
    const Trip::Cause wrong = violated_limit(i, reading.counts);
    if (wrong == Trip::Cause::none) {
      watch_frozen(conversion.channel, reading.counts, t);
      accept(i, reading.counts);
    } else {
      reject(conversion.channel, reading.counts, wrong, t);
      reading.status = Status::invalid;
    }
  }
  if (reading.status != Status::ok) count_scan(conversion.channel);
  controller_.take(conversion, reading, t);
}

// Counts a scan without a good reading.
void Supervisor::count_scan(Channel channel) noexcept {
  if (channel.index >= max_channels) return;
  std::uint16_t& scans = watch_[channel.index].scans;
  if (scans < signals::max_counts) ++scans;
}

Trip::Cause Supervisor::violated_limit(std::size_t i, std::uint16_t counts) const noexcept {
  const SensorLimits& limit = limits_.sensor[i];
  const Watch& watch = watch_[i];
  if (counts < limit.low || counts > limit.high) return Trip::Cause::range;
  if (watch.agreed == 0) return Trip::Cause::none;
  return distance(counts, watch.good) > limit.max_step * watch.scans ? Trip::Cause::rate
                                                                     : Trip::Cause::none;
}

void Supervisor::accept(std::size_t i, std::uint16_t counts) noexcept {
  Watch& watch = watch_[i];
  if (watch.agreed < limits_.bad_readings) ++watch.agreed;
  watch.good = counts;
  watch.scans = 1;
  watch.bad = 0;
}

void Supervisor::reject(Channel channel, std::uint16_t counts, Trip::Cause cause, Tick t) noexcept {
  const SensorLimits& limit = limits_.sensor[channel.index];
  Watch& watch = watch_[channel.index];
  ++supervised_.sensor[channel.index].rejected;
  ++supervised_.rejected;
  watch.equal = 0;
  // Among a sensor's first readings it is unknown which one is wrong.
  if (cause == Trip::Cause::rate && watch.agreed < limits_.bad_readings) watch.agreed = 0;
  if (++watch.bad != limits_.bad_readings) return;
  Trip wrong{.cause = cause, .at = t, .channel = channel, .counts = counts, .before = watch.good};
  if (cause == Trip::Cause::range) {
    wrong.low = limit.low;
    wrong.high = limit.high;
  } else {
    wrong.high = limit.max_step;
  }
  trip(wrong, t + 1);
}

// Returns whether the last law has opened a valve that moves the measured quantity.
bool Supervisor::driven(const SensorLimits& limit) const noexcept {
  if (limit.joint < 0 || state().phase != Phase::running) return false;
  const JointState& joint = state().joint[static_cast<std::size_t>(limit.joint)];
  if (!joint.enabled) return false;
  const Duties& d = joint.duties;
  return (limit.of_flexor && d.flexor_inlet + d.flexor_exhaust > 0) ||
         (limit.of_extensor && d.extensor_inlet + d.extensor_exhaust > 0);
}

void Supervisor::watch_frozen(Channel channel, std::uint16_t counts, Tick t) noexcept {
  const SensorLimits& limit = limits_.sensor[channel.index];
  Watch& watch = watch_[channel.index];
  const bool at_end = counts <= limit.low || counts >= limit.high;
  if (watch.agreed == 0 || counts != watch.good || !driven(limit) ||
      (limit.rests_at_ends && at_end)) {
    watch.equal = 0;
    return;
  }
  ++watch.equal;
  SensorStatistics& statistics = supervised_.sensor[channel.index];
  if (watch.equal >= limits_.frozen_scans) {
    statistics.frozen += watch.equal == limits_.frozen_scans ? watch.equal : 1;
    if (watch.equal > statistics.longest) statistics.longest = watch.equal;
  }
  if (limit.frozen_limit > 0 && watch.equal == limit.frozen_limit)
    trip({.cause = Trip::Cause::frozen,
          .at = t,
          .channel = channel,
          .counts = counts,
          .before = counts,
          .high = shown(limit.frozen_limit)},
         t + 1);
}

// --- commands -----------------------------------------------------------------------------------

bool Supervisor::possible(std::size_t j, const JointCommand& command) const noexcept {
  const CommandLimits& limit = limits_.command[j];
  if (!within(command.angle, limit.low, limit.high)) return false;
  if (commanded_ && distance(command.angle, good_.joint[j].angle) > limit.max_step) return false;
  if (!within(command.stiffness, limit.max_stiffness)) return false;
  for (const float gain : {command.gains.angle, command.gains.stiffness, command.gains.velocity})
    if (!within(gain, limit.max_gain)) return false;
  if (command.timed) return is_timed(config().joint[j].kind) && possible(command.openings);
  return !command.open_loop || control::possible(command.duties);
}

bool Supervisor::possible(const Openings& openings) const noexcept {
  const std::uint16_t period = config().period;
  for (const Opening& o : {openings.inlet, openings.exhaust})
    if (o.from > period || o.until > period) return false;
  return true;
}

// Checks the commands of joints that have laws; passive joints ignore theirs.
void Supervisor::command(const Command& command) noexcept {
  for (std::size_t j = 0; j < config().joints; ++j) {
    if (config().joint[j].kind == JointKind::passive || possible(j, command.joint[j])) continue;
    return reject_command(static_cast<std::uint8_t>(j));
  }
  bad_commands_ = 0;
  supervised_.holding = false;
  good_ = command;
  commanded_ = true;
  controller_.command(command);
}

// Keeps the last good command; from the third rejected one in a row all valves are shut.
void Supervisor::reject_command(std::uint8_t joint) noexcept {
  ++supervised_.rejected_commands;
  bad_joint_ = joint;
  if (bad_commands_ < limits_.vent_commands) ++bad_commands_;
  if (bad_commands_ == limits_.hold_commands) hold();
}

void Supervisor::hold() noexcept {
  if (supervised_.holding) return;
  supervised_.holding = true;
  ++supervised_.holds;
  Command shut = good_;
  for (JointCommand& j : shut.joint) j.enabled = false;
  controller_.command(shut);
}

}  // namespace sinew::control
