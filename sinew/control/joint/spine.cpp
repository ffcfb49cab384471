#include "sinew/control/joint/spine.h"

#include "sinew/control/joint/laws.h"

namespace sinew::control {

using signals::Channel;
using signals::Conversion;
using signals::Edge;
using signals::Reading;
using signals::Scan;
using signals::Status;
using signals::Tick;

namespace {

constexpr float ticks_per_second = 10'000.0f;

enum ValveOfJoint : std::size_t { flexor_inlet, flexor_exhaust, extensor_inlet, extensor_exhaust };

}  // namespace

Spine::Spine(const SpineConfig& config) noexcept : config_(config), command_(rest_command(config)) {
  if (config.startup_vent > 0)
    vent(0, config.startup_vent, Phase::startup, Phase::running);
  else
    seen_.phase = Phase::running;
}

Scan Spine::scan() const noexcept {
  return {config_.period, {config_.conversion.data(), config_.conversions}};
}

// --- time ---------------------------------------------------------------------------------------

// Moves the cursor to the first conversion not before t. The loop visits every period's start, so
// the search is short.
void Spine::locate(Tick t) noexcept {
  while (t - period_start_ >= config_.period) {
    period_start_ += config_.period;
    cursor_ = 0;
  }
  while (cursor_ < config_.conversions && period_start_ + config_.conversion[cursor_].read < t)
    ++cursor_;
}

Tick Spine::next_event(Tick t) noexcept {
  locate(t + 1);
  Tick next = period_start_ > t ? period_start_ : period_start_ + config_.period;
  if (cursor_ < config_.conversions) {
    const Tick read = period_start_ + config_.conversion[cursor_].read;
    if (read < next) next = read;
  }
  if (next_edge_ < next) next = next_edge_;
  return next > t ? next : t + 1;
}

bool Spine::starts_period(Tick t) noexcept {
  locate(t);
  return period_start_ == t;
}

const Conversion* Spine::due(Tick t) noexcept {
  locate(t);
  if (cursor_ == config_.conversions) return nullptr;
  const Conversion& c = config_.conversion[cursor_];
  return period_start_ + c.read == t ? &c : nullptr;
}

void Spine::missed(Tick) noexcept { ++seen_.missed; }

// --- readings -----------------------------------------------------------------------------------

void Spine::take(const Conversion& conversion, Reading reading, Tick t) noexcept {
  store(conversion.channel, reading, t);
  for (std::size_t j = 0; j < config_.joints; ++j)
    if (config_.joint[j].law_tick == conversion.read && seen_.phase == Phase::running)
      run_law(j, t);
}

// A bad reading leaves the last good counts in place.
void Spine::store(Channel channel, Reading reading, Tick t) noexcept {
  const std::size_t i = channel.index;
  if (i >= max_channels) return;
  seen_.reading[i].status = reading.status;
  if (reading.status == Status::ok) {
    // What the laws' integers are made for.
    seen_.reading[i].counts =
        reading.counts < signals::max_counts ? reading.counts : signals::max_counts;
    answered_[i] = true;
    bad_in_a_row_[i] = 0;
    return;
  }
  if (reading.status == Status::late) ++seen_.late;
  if (reading.status == Status::invalid) ++seen_.invalid;

  const bool sticky = reading.status == Status::ended || reading.status == Status::fault;
  const bool too_many = ++bad_in_a_row_[i] == config_.hold_limit;
  if ((sticky || too_many) && seen_.fault == Status::ok) {
    seen_.fault = reading.status;
    seen_.fault_channel = channel;
    shut_down(t);
  }
}

// --- laws ---------------------------------------------------------------------------------------

// Never a law on a channel that has not answered yet, nor twice in a period.
bool Spine::ready(std::size_t j, Tick t) const noexcept {
  const JointConfig& joint = config_.joint[j];
  const Tick last = seen_.joint[j].law_at;
  if (last >= 0 && t - last < config_.period) return false;
  if (!answered_[joint.angle.index]) return false;
  return joint.kind == JointKind::cylinder ||
         (answered_[joint.flexor.tension.index] && answered_[joint.extensor.tension.index]);
}

void Spine::run_law(std::size_t j, Tick t) noexcept {
  if (!ready(j, t)) return;
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  const bool antagonist = joint.kind == JointKind::antagonist;
  JointSeen& seen = seen_.joint[j];

  // The first law sees no speed; nor does a cylinder's, as in the code.
  const std::int32_t angle = seen_.reading[joint.angle.index].counts;
  const std::int32_t previous = antagonist && seen.law_at >= 0 ? previous_angle_[j] : angle;
  const float rate = ticks_per_second / static_cast<float>(config_.period);
  const Exact u_theta =
      angle_law(command.gains, joint.flexion, command.angle, angle, previous, rate);
  previous_angle_[j] = angle;

  seen.law_at = t;
  seen.enabled = joint.enabled && command.enabled;
  seen.angle_output = u_theta.high;
  seen.duties = antagonist ? to_duties(stiffness_output(j), u_theta, config_.truncation)
                           : cylinder_duties(joint.feedforward, u_theta, config_.truncation);
  if (command.open_loop) seen.duties = open_loop_duties(command.duties, joint.kind);
  schedule(j, t);
}

// U_k, from a new stiffness or, near the pole of [27], from the last one.
Exact Spine::stiffness_output(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  const auto counts = [&](Channel c) -> std::int32_t { return seen_.reading[c.index].counts; };
  JointSeen& seen = seen_.joint[j];

  const Stiffness now =
      joint_stiffness(joint, config_.truncation, counts(joint.angle), counts(joint.flexor.tension),
                      counts(joint.extensor.tension));
  if (now.valid) seen.stiffness = now.value;
  seen.pole_held = !now.valid;
  seen.pole_holds += seen.pole_held;

  const Exact u_k = stiffness_law(command.gains.stiffness, command.stiffness, seen.stiffness);
  seen.stiffness_output = u_k.high;
  return u_k;
}

// --- valves -------------------------------------------------------------------------------------

void Spine::schedule(std::size_t j, Tick t) noexcept {
  const JointSeen& seen = seen_.joint[j];
  const auto cycle = [&](ValveOfJoint valve, std::int32_t duty) {
    const std::size_t d = static_cast<std::size_t>(duty);
    const Pulse pulse{config_.timing.closing[d], config_.timing.opening[d], config_.period,
                      config_.output_delay};
    valves_[j][valve].cycle(t, pulse, seen.enabled);
  };
  cycle(flexor_inlet, seen.duties.flexor_inlet);
  cycle(flexor_exhaust, seen.duties.flexor_exhaust);
  cycle(extensor_inlet, seen.duties.extensor_inlet);
  cycle(extensor_exhaust, seen.duties.extensor_exhaust);
  find_next_edge();
}

void Spine::shut_down(Tick t) noexcept {
  if (seen_.phase == Phase::venting || seen_.phase == Phase::off) return;
  vent(t + config_.output_delay, config_.shutdown_vent, Phase::venting, Phase::off);
}

// Also the muscles of disabled joints, as in the thesis's hardware_start_up.
void Spine::vent(Tick from, std::uint32_t ticks, Phase during, Phase after) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j) {
    JointValves& valves = valves_[j];
    valves[flexor_inlet].shut(from);
    valves[extensor_inlet].shut(from);
    valves[flexor_exhaust].pulse(from, from + ticks);
    valves[extensor_exhaust].pulse(from, from + ticks);
  }
  seen_.phase = during;
  next_phase_ = after;
  phase_end_ = from + ticks;
  find_next_edge();
}

// The first call of a tick: here the phase changes.
std::span<const Edge> Spine::edges(Tick t) noexcept {
  if (t >= phase_end_) seen_.phase = next_phase_;
  out_count_ = 0;
  if (next_edge_ <= t) {
    hand_out(t, false);
    hand_out(t, true);
    find_next_edge();
  }
  return {out_.data(), out_count_};
}

// Closing edges go first, so that no muscle is open to both sides even for an instant.
void Spine::hand_out(Tick t, bool open) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j) {
    const JointConfig& joint = config_.joint[j];
    const signals::Valve index[] = {joint.flexor.inlet, joint.flexor.exhaust, joint.extensor.inlet,
                                    joint.extensor.exhaust};
    for (std::size_t v = 0; v < valves_per_joint; ++v) {
      PulseTrain& train = valves_[j][v];
      if (train.next() > t || train.next_opens() != open || out_count_ == out_.size()) continue;
      train.drive();
      out_[out_count_++] = {t, index[v], open};
    }
  }
}

void Spine::find_next_edge() noexcept {
  next_edge_ = PulseTrain::never;
  for (std::size_t j = 0; j < config_.joints; ++j)
    for (const PulseTrain& train : valves_[j])
      if (train.next() < next_edge_) next_edge_ = train.next();
}

}  // namespace sinew::control
