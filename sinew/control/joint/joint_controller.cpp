#include "sinew/control/joint/joint_controller.h"

#include <bit>

namespace sinew::control {

using signals::Channel;
using signals::Conversion;
using signals::Edge;
using signals::Reading;
using signals::Scan;
using signals::Status;
using signals::Tick;

namespace {

enum ValveOfJoint : std::size_t { flexor_inlet, flexor_exhaust, extensor_inlet, extensor_exhaust };

constexpr std::uint32_t fault_vent = 10'000;  // if the machine has no shutdown_vent [ticks]

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config), command_(rest_command(config)) {
  find_partners();
  find_next_edge();
  for (std::size_t j = 0; j < config_.joints; ++j) {
    timed_ |= is_timed(config_.joint[j].kind);
    regulated_ |= config_.joint[j].kind == JointKind::regulated;
  }
  if (config.startup_vent > 0)
    vent(0, config.startup_vent, Phase::startup, Phase::running);
  else
    state_.phase = Phase::running;
}

Scan JointController::scan() const noexcept {
  return {config_.period, {config_.conversion.data(), config_.conversions}};
}

// --- time ---------------------------------------------------------------------------------------

// Moves the cursor to the first conversion at or after t. The loop visits every period's start, so
// the search is short.
void JointController::locate(Tick t) noexcept {
  while (t - period_start_ >= config_.period) {
    period_start_ += config_.period;
    cursor_ = 0;
  }
  while (cursor_ < config_.conversions && period_start_ + config_.conversion[cursor_].read < t)
    ++cursor_;
}

Tick JointController::next_event(Tick t) noexcept {
  locate(t + 1);
  Tick next = period_start_ > t ? period_start_ : period_start_ + config_.period;
  if (cursor_ < config_.conversions) {
    const Tick read = period_start_ + config_.conversion[cursor_].read;
    if (read < next) next = read;
  }
  if (next_edge_ < next) next = next_edge_;
  return next > t ? next : t + 1;
}

bool JointController::starts_period(Tick t) noexcept {
  locate(t);
  return period_start_ == t;
}

const Conversion* JointController::due(Tick t) noexcept {
  locate(t);
  if (cursor_ == config_.conversions) return nullptr;
  const Conversion& c = config_.conversion[cursor_];
  return period_start_ + c.read == t ? &c : nullptr;
}

const Conversion* JointController::begins(Tick t) const noexcept {
  for (std::size_t i = cursor_; i < config_.conversions && i < cursor_ + 2; ++i)
    if (period_start_ + config_.conversion[i].start == t) return &config_.conversion[i];
  return nullptr;
}

void JointController::missed(Tick) noexcept { ++state_.missed; }

// --- readings -----------------------------------------------------------------------------------

void JointController::take(const Conversion& conversion, Reading reading, Tick t) noexcept {
  store(conversion.channel, reading, t);
  for (std::size_t j = 0; j < config_.joints; ++j)
    if (config_.joint[j].law_tick == conversion.read && state_.phase == Phase::running)
      run_law(j, t);
}

// Stores a reading. A bad one leaves the last good counts unchanged.
void JointController::store(Channel channel, Reading reading, Tick t) noexcept {
  const std::size_t i = channel.index;
  if (i >= max_channels) return;
  state_.reading[i].status = reading.status;
  if (reading.status == Status::ok) {
    // the range that the laws' integers are designed for
    state_.reading[i].counts =
        reading.counts < signals::max_counts ? reading.counts : signals::max_counts;
    has_good_reading_[i] = true;
    bad_in_a_row_[i] = 0;
    return;
  }
  if (reading.status == Status::late) ++state_.late;
  if (reading.status == Status::invalid) ++state_.invalid;

  const bool sticky = reading.status == Status::ended || reading.status == Status::fault;
  const bool too_many = ++bad_in_a_row_[i] == config_.hold_limit;
  if ((sticky || too_many) && state_.fault == Status::ok) {
    state_.fault = reading.status;
    state_.fault_channel = channel;
    shut_down(t);
  }
}

// --- valves -------------------------------------------------------------------------------------

const MuscleConfig& JointController::muscle(std::size_t j, Side side) const noexcept {
  return side == flexor ? config_.joint[j].flexor : config_.joint[j].extensor;
}

// Returns whether the muscle exists and this joint drives its valves.
bool JointController::drives(std::size_t j, Side side) const noexcept {
  return muscle(j, side).present && partner_[j][side].drives;
}

// Finds muscles over two joints: two joints with the same inlet share its muscle.
void JointController::find_partners() noexcept {
  for (std::size_t a = 0; a < config_.joints; ++a)
    for (std::size_t b = a + 1; b < config_.joints; ++b)
      for (const Side x : sides)
        for (const Side y : sides) {
          const MuscleConfig &one = muscle(a, x), &other = muscle(b, y);
          if (!one.present || !other.present || one.inlet.index != other.inlet.index) continue;
          const bool b_is_later = config_.joint[b].law_tick >= config_.joint[a].law_tick;
          partner_[a][x] = {static_cast<std::int8_t>(b), y, !b_is_later};
          partner_[b][y] = {static_cast<std::int8_t>(a), x, b_is_later};
        }
}

void JointController::schedule(std::size_t j, Tick t) noexcept {
  const JointState& state = state_.joint[j];
  const auto cycle = [&](std::size_t valve, std::int32_t duty, bool enabled) {
    const std::size_t d = static_cast<std::size_t>(duty);
    const Pulse pulse{config_.timing.closing[d], config_.timing.opening[d], config_.period,
                      config_.output_delay};
    valves_[j][valve].cycle(t, pulse, enabled);
  };
  for (const Side side : sides) {
    if (!drives(j, side)) continue;
    if (config_.joint[j].kind == JointKind::regulated) {
      schedule_level(j, side, t);
      continue;
    }
    const Partner& partner = partner_[j][side];
    const bool enabled =
        state.enabled ||
        (partner.joint >= 0 && state_.joint[static_cast<std::size_t>(partner.joint)].enabled);
    const bool flexes = side == flexor;
    cycle(flexes ? flexor_inlet : extensor_inlet,
          flexes ? state.duties.flexor_inlet : state.duties.extensor_inlet, enabled);
    if (!has_exhausts(config_.joint[j].kind)) continue;
    cycle(flexes ? flexor_exhaust : extensor_exhaust,
          flexes ? state.duties.flexor_exhaust : state.duties.extensor_exhaust, enabled);
  }
  find_next_edge_of(j);
  find_first_edge();
}

// Schedules the host's openings for the period that begins at t. If its first tick was skipped, the
// valves are shut until the next period.
void JointController::schedule_openings(Tick t) noexcept {
  if (period_start_ == opened_) return;
  opened_ = period_start_;
  for (std::size_t j = 0; j < config_.joints; ++j) {
    if (!is_timed(config_.joint[j].kind)) continue;
    JointCommand& command = command_.joint[j];
    state_.joint[j].enabled = config_.joint[j].enabled && command.enabled;
    const bool opens = state_.joint[j].enabled && command.timed && period_start_ == t;
    const Openings openings = opens ? command.openings : Openings{};
    valves_[j][flexor_inlet].open(t, config_.period, openings.inlet);
    if (has_exhausts(config_.joint[j].kind))
      valves_[j][flexor_exhaust].open(t, config_.period, openings.exhaust);
    if (command.timed) command.openings = {};
    find_next_edge_of(j);
  }
  find_first_edge();
}

void JointController::schedule_level(std::size_t j, Side side, Tick t) noexcept {
  const JointState& state = state_.joint[j];
  const std::uint16_t level = side == flexor ? state.levels.flexor : state.levels.extensor;
  levels_[j][side] = {t + config_.output_delay, state.enabled ? level : std::uint16_t{0}};
}

void JointController::shut_down(Tick t) noexcept {
  if (state_.phase == Phase::venting || state_.phase == Phase::off) return;
  vent(t + config_.output_delay, config_.shutdown_vent, Phase::venting, Phase::off);
}

// Drops a law's edges in the skipped ticks; a vent that has not begun starts at t.
void JointController::skip_to(Tick t) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j)
    for (PulseTrain& train : valves_[j]) {
      if (train.next() >= t) continue;
      if (state_.phase == Phase::running || !train.next_opens()) {
        train.shut(t);
        continue;
      }
      const bool startup = state_.phase == Phase::startup;
      phase_end_ = t + (startup ? config_.startup_vent : config_.shutdown_vent);
      train.pulse(t, phase_end_);
    }
  find_next_edge();
}

void JointController::shut_inlets(Tick t) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j) {
    if (!has_exhausts(config_.joint[j].kind)) continue;
    valves_[j][flexor_inlet].shut(t);
    valves_[j][extensor_inlet].shut(t);
  }
  find_next_edge();
}

void JointController::shut_valves(std::size_t j, Tick t) noexcept {
  if (!has_exhausts(config_.joint[j].kind)) return;
  for (PulseTrain& train : valves_[j]) train.shut(t);
  find_next_edge();
}

void JointController::trip(Status status, Channel channel, Tick t) noexcept {
  if (state_.phase == Phase::venting || state_.phase == Phase::off) return;
  state_.fault = status;
  state_.fault_channel = channel;
  const std::uint32_t lasts = config_.shutdown_vent > 0 ? config_.shutdown_vent : fault_vent;
  vent(t, lasts, Phase::venting, Phase::off);
}

// Vents all muscles, also those of disabled joints, as the thesis's hardware_start_up does. A 3-way
// valve without current vents permanently, as does a regulator set to zero.
void JointController::vent(Tick from, std::uint32_t ticks, Phase during, Phase after) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j)
    for (const Side side : sides) {
      if (!drives(j, side)) continue;
      const JointKind kind = config_.joint[j].kind;
      if (kind == JointKind::regulated) {
        levels_[j][side] = {from, 0};
        continue;
      }
      JointValves& valves = valves_[j];
      valves[side == flexor ? flexor_inlet : extensor_inlet].shut(from);
      if (has_exhausts(kind))
        valves[side == flexor ? flexor_exhaust : extensor_exhaust].pulse(from, from + ticks);
    }
  state_.phase = during;
  next_phase_ = after;
  phase_end_ = from + ticks;
  find_next_edge();
}

// Returns the edges of a tick. It is the first call of a tick and also changes the phase.
std::span<const Edge> JointController::edges(Tick t) noexcept {
  if (t >= phase_end_) state_.phase = next_phase_;
  if (timed_ && state_.phase == Phase::running) {
    locate(t);
    schedule_openings(t);
  }
  out_count_ = 0;
  if (next_edge_ <= t) {
    collect_edges(t);
    if (regulated_) collect_levels(t);
    for (std::size_t j = 0; j < config_.joints; ++j)
      if (next_of_[j] <= t) find_next_edge_of(j);
    find_first_edge();
  }
  return {out_.data(), out_count_};
}

// Outputs closing edges first, so that a muscle is never open to supply and room at once.
void JointController::collect_edges(Tick t) noexcept {
  static_assert(max_joints * valves_per_joint <= 32);
  std::uint32_t opening = 0;
  for (std::size_t j = 0; j < config_.joints; ++j) {
    if (next_of_[j] > t) continue;
    for (std::size_t v = 0; v < valves_per_joint; ++v) {
      const PulseTrain& train = valves_[j][v];
      if (train.next() > t) continue;
      if (!train.next_opens()) drive(j, v, t);
      if (train.next() <= t && train.next_opens()) opening |= 1u << (j * valves_per_joint + v);
    }
  }
  for (; opening != 0; opening &= opening - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(opening));
    drive(i / valves_per_joint, i % valves_per_joint, t);
  }
}

// Outputs the train's next edge.
void JointController::drive(std::size_t j, std::size_t valve, Tick t) noexcept {
  if (out_count_ == out_.size()) return;
  const MuscleConfig& m = muscle(j, valve <= flexor_exhaust ? flexor : extensor);
  const bool exhaust = valve == flexor_exhaust || valve == extensor_exhaust;
  PulseTrain& train = valves_[j][valve];
  const bool open = train.next_opens();
  train.drive();
  out_[out_count_++] =
      exhaust ? Edge{t, m.exhaust, open != m.exhaust_inverted} : Edge{t, m.inlet, open};
}

void JointController::collect_levels(Tick t) noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j) {
    if (next_of_[j] > t) continue;
    for (const Side side : sides) {
      PendingLevel& pending = levels_[j][side];
      if (pending.at > t || out_count_ == out_.size()) continue;
      out_[out_count_++] = {t, muscle(j, side).inlet, pending.level > 0, pending.level};
      pending.at = PulseTrain::never;
    }
  }
}

void JointController::find_next_edge() noexcept {
  for (std::size_t j = 0; j < config_.joints; ++j) find_next_edge_of(j);
  find_first_edge();
}

void JointController::find_next_edge_of(std::size_t j) noexcept {
  Tick next = PulseTrain::never;
  for (const PulseTrain& train : valves_[j])
    if (train.next() < next) next = train.next();
  for (const PendingLevel& pending : levels_[j])
    if (pending.at < next) next = pending.at;
  next_of_[j] = next;
}

void JointController::find_first_edge() noexcept {
  next_edge_ = PulseTrain::never;
  for (std::size_t j = 0; j < config_.joints; ++j)
    if (next_of_[j] < next_edge_) next_edge_ = next_of_[j];
}

// --- the laws of a joint, run when the last of its readings has arrived ---

namespace {

constexpr float ticks_per_second = 10'000.0f;

}  // namespace

// Returns whether a law may run: all its channels have had a reading, and it has not run in this
// period.
bool JointController::ready(std::size_t j, Tick t) const noexcept {
  const JointConfig& joint = config_.joint[j];
  const Tick last = state_.joint[j].law_at;
  if (joint.kind == JointKind::passive || is_timed(joint.kind)) return false;
  if (last >= 0 && t - last < config_.period) return false;
  for (const Channel c : readings_of(joint))
    if (!has_good_reading_[c.index]) return false;
  for (const Partner& partner : partner_[j])
    if (partner.joint >= 0 &&
        !has_good_reading_[config_.joint[static_cast<std::size_t>(partner.joint)].angle.index])
      return false;
  return true;
}

void JointController::run_law(std::size_t j, Tick t) noexcept {
  if (!ready(j, t)) return;
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointState& state = state_.joint[j];
  state_.overruns += config_.laws_overrun;

  // A cylinder's law has no speed, as in the thesis's code.
  state.velocity = joint.kind == JointKind::cylinder ? 0.0f : speed(j);
  const Exact u_theta =
      angle_law(command.gains, joint.flexion, command.angle, counts(joint.angle), state.velocity);

  state.law_at = t;
  state.enabled = joint.enabled && command.enabled;
  state.angle_output = u_theta.high;
  if (joint.kind == JointKind::cylinder)
    state.duties = cylinder_duties(joint.feedforward, u_theta, config_.truncation);
  else if (joint.kind == JointKind::regulated)
    set_levels(j, stiffness_output(j), u_theta);
  else
    set_duties(j, stiffness_output(j), u_theta);
  if (command.open_loop) open_loop(j);
  share_duties(j);
  schedule(j, t);
}

float JointController::speed(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  Motion now{.angle = counts(joint.angle),
             .rate = ticks_per_second / static_cast<float>(config_.period)};
  if (joint.velocity.speed_gain != 0) {
    const auto pull = [&](const MuscleConfig& m) {
      return m.present ? m.tension_ratio * static_cast<float>(counts(m.tension)) : 0.0f;
    };
    const float flexing = pull(joint.flexor) - pull(joint.extensor);
    now.push = joint.flexion > 0 ? flexing : -flexing;
  }
  if (joint.velocity.estimator == Estimator::sensor) now.sensor = counts(joint.velocity.channel);
  return estimate(joint.velocity, velocity_[j], now);
}

// Returns the muscles' lengths from the joint's own angle and, for a muscle over two joints, the
// other's.
Pair JointController::lengths(std::size_t j) const noexcept {
  const JointConfig& joint = config_.joint[j];
  Pair length = muscle_lengths(joint, counts(joint.angle));
  const auto other = [&](Side side) -> std::int32_t {
    const std::int8_t partner = partner_[j][side].joint;
    if (partner < 0) return 0;
    const JointConfig& theirs = config_.joint[static_cast<std::size_t>(partner)];
    const std::int32_t turned = counts(theirs.angle) - theirs.angle_at_rest;
    return truncated(two_product(muscle(j, side).other_travel, static_cast<float>(turned)));
  };
  length.flexor += other(flexor);
  length.extensor += other(extensor);
  return length;
}

Stiffness JointController::measured_stiffness(std::size_t j) const noexcept {
  const JointConfig& joint = config_.joint[j];
  if (joint.stiffness_source == StiffnessSource::pressure)
    return {
        joint_stiffness_from_pressure(
            joint, lengths(j), {counts(joint.flexor.pressure), counts(joint.extensor.pressure)}),
        true};
  return joint_stiffness(joint, config_.truncation, lengths(j),
                         {counts(joint.flexor.tension), counts(joint.extensor.tension)});
}

// Returns U_k from a new stiffness or, near the pole of [27], from the last one.
Exact JointController::stiffness_output(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointState& state = state_.joint[j];
  if (joint.stiffness_source == StiffnessSource::none) return {};

  const Stiffness now = measured_stiffness(j);
  if (now.valid) state.stiffness = now.value;
  state.pole_held = !now.valid;
  state.pole_holds += state.pole_held;

  const Exact u_k = stiffness_law(command.gains.stiffness, command.stiffness, state.stiffness);
  state.stiffness_output = u_k.high;
  return u_k;
}

// Sets the duties; those of an absent muscle are 0.
void JointController::set_duties(std::size_t j, Exact u_k, Exact u_theta) noexcept {
  const JointConfig& joint = config_.joint[j];
  signed_duties_[j] = signed_duties(u_k, u_theta, config_.truncation);
  Duties& duties = state_.joint[j].duties;
  duties = joint.kind == JointKind::three_way ? three_way_duties(joint.bias, signed_duties_[j])
                                              : to_duties(signed_duties_[j], config_.dead_band);
  if (!joint.flexor.present) duties.flexor_inlet = duties.flexor_exhaust = 0;
  if (!joint.extensor.present) duties.extensor_inlet = duties.extensor_exhaust = 0;
}

// Sets the levels. While a joint is disabled its integrals are zero.
void JointController::set_levels(std::size_t j, Exact u_k, Exact u_theta) noexcept {
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointState& state = state_.joint[j];
  RegulatorInput in{.bias = static_cast<float>(joint.bias),
                    .u_k = clamped(u_k.high, law_limit),
                    .u_theta = clamped(u_theta.high, law_limit)};
  if (state.enabled && !command.open_loop) {
    const std::int32_t error =
        joint.flexion * (clamped(command.angle, -angle_limit, angle_limit) - counts(joint.angle));
    in.angle_step = joint.regulator.angle_integral * static_cast<float>(error);
    if (joint.stiffness_source != StiffnessSource::none)
      in.stiffness_step = joint.regulator.stiffness_integral *
                          (clamped(command.stiffness, stiffness_limit) - state.stiffness);
  } else {
    regulator_[j] = {};
  }
  state.levels = regulate(regulator_[j], in);
  if (!joint.flexor.present) state.levels.flexor = 0;
  if (!joint.extensor.present) state.levels.extensor = 0;
}

void JointController::open_loop(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  JointState& state = state_.joint[j];
  state.duties = open_loop_duties(command_.joint[j].duties, joint.kind);
  signed_duties_[j] = {state.duties.flexor_inlet - state.duties.flexor_exhaust,
                       state.duties.extensor_inlet - state.duties.extensor_exhaust};
  if (joint.kind == JointKind::regulated) {
    state.levels = {level_of(static_cast<float>(state.duties.flexor_inlet)),
                    level_of(static_cast<float>(state.duties.extensor_inlet))};
    state.duties = {};
  }
}

// Combines the duties of both joints for a muscle over two joints, at the later law.
void JointController::share_duties(std::size_t j) noexcept {
  for (const Side side : sides) {
    const Partner& partner = partner_[j][side];
    if (partner.joint < 0 || !partner.drives) continue;
    const auto other = static_cast<std::size_t>(partner.joint);
    const auto of = [](const Pair& pair, Side s) {
      return s == flexor ? pair.flexor : pair.extensor;
    };
    const auto duty_of = [&](std::size_t joint, Side s) {
      return state_.joint[joint].enabled ? of(signed_duties_[joint], s) : 0;
    };
    const std::int32_t duty =
        shared_duty(muscle(j, side).share, duty_of(j, side), muscle(other, partner.side).share,
                    duty_of(other, partner.side), config_.truncation);
    const Duties both = to_duties({duty, duty}, config_.dead_band);
    const auto put = [&](Duties& duties, Side s) {
      (s == flexor ? duties.flexor_inlet : duties.extensor_inlet) = both.flexor_inlet;
      (s == flexor ? duties.flexor_exhaust : duties.extensor_exhaust) = both.flexor_exhaust;
    };
    put(state_.joint[j].duties, side);
    put(state_.joint[other].duties, partner.side);
  }
}

}  // namespace sinew::control
