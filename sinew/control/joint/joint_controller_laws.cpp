// The laws of a joint, run when the last of its readings is there.
#include "sinew/control/joint/joint_controller.h"

namespace sinew::control {

using signals::Channel;
using signals::Tick;

namespace {

constexpr float ticks_per_second = 10'000.0f;

}  // namespace

// Never a law on a channel that has not answered yet, nor twice in a period.
bool JointController::ready(std::size_t j, Tick t) const noexcept {
  const JointConfig& joint = config_.joint[j];
  const Tick last = seen_.joint[j].law_at;
  if (joint.kind == JointKind::passive) return false;
  if (last >= 0 && t - last < config_.period) return false;
  for (const Channel c : readings_of(joint))
    if (!answered_[c.index]) return false;
  for (const Partner& partner : partner_[j])
    if (partner.joint >= 0 &&
        !answered_[config_.joint[static_cast<std::size_t>(partner.joint)].angle.index])
      return false;
  return true;
}

void JointController::run_law(std::size_t j, Tick t) noexcept {
  if (!ready(j, t)) return;
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointSeen& seen = seen_.joint[j];
  seen_.overruns += config_.laws_overrun;

  // A cylinder's law sees no speed, as in the code.
  seen.velocity = joint.kind == JointKind::cylinder ? 0.0f : speed(j);
  const Exact u_theta =
      angle_law(command.gains, joint.flexion, command.angle, counts(joint.angle), seen.velocity);

  seen.law_at = t;
  seen.enabled = joint.enabled && command.enabled;
  seen.angle_output = u_theta.high;
  if (joint.kind == JointKind::cylinder)
    seen.duties = cylinder_duties(joint.feedforward, u_theta, config_.truncation);
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

// By the joint's own angle and, of a muscle over two joints, by the other's.
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

// U_k, from a new stiffness or, near the pole of [27], from the last one.
Exact JointController::stiffness_output(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointSeen& seen = seen_.joint[j];
  if (joint.stiffness_source == StiffnessSource::none) return {};

  const Stiffness now = measured_stiffness(j);
  if (now.valid) seen.stiffness = now.value;
  seen.pole_held = !now.valid;
  seen.pole_holds += seen.pole_held;

  const Exact u_k = stiffness_law(command.gains.stiffness, command.stiffness, seen.stiffness);
  seen.stiffness_output = u_k.high;
  return u_k;
}

// What is not there is asked for nothing.
void JointController::set_duties(std::size_t j, Exact u_k, Exact u_theta) noexcept {
  const JointConfig& joint = config_.joint[j];
  asked_[j] = asked(u_k, u_theta, config_.truncation);
  Duties& duties = seen_.joint[j].duties;
  duties = joint.kind == JointKind::three_way ? three_way_duties(joint.bias, asked_[j])
                                              : to_duties(asked_[j], config_.dead_band);
  if (!joint.flexor.present) duties.flexor_inlet = duties.flexor_exhaust = 0;
  if (!joint.extensor.present) duties.extensor_inlet = duties.extensor_exhaust = 0;
}

// While a joint is disabled its integrals wait at zero.
void JointController::set_levels(std::size_t j, Exact u_k, Exact u_theta) noexcept {
  const JointConfig& joint = config_.joint[j];
  const JointCommand& command = command_.joint[j];
  JointSeen& seen = seen_.joint[j];
  RegulatorInput in{.bias = static_cast<float>(joint.bias),
                    .u_k = clamped(u_k.high, law_limit),
                    .u_theta = clamped(u_theta.high, law_limit)};
  if (seen.enabled && !command.open_loop) {
    const std::int32_t error =
        joint.flexion * (clamped(command.angle, -angle_limit, angle_limit) - counts(joint.angle));
    in.angle_step = joint.regulator.angle_integral * static_cast<float>(error);
    if (joint.stiffness_source != StiffnessSource::none)
      in.stiffness_step = joint.regulator.stiffness_integral *
                          (clamped(command.stiffness, stiffness_limit) - seen.stiffness);
  } else {
    regulator_[j] = {};
  }
  seen.levels = regulate(regulator_[j], in);
  if (!joint.flexor.present) seen.levels.flexor = 0;
  if (!joint.extensor.present) seen.levels.extensor = 0;
}

void JointController::open_loop(std::size_t j) noexcept {
  const JointConfig& joint = config_.joint[j];
  JointSeen& seen = seen_.joint[j];
  seen.duties = open_loop_duties(command_.joint[j].duties, joint.kind);
  asked_[j] = {seen.duties.flexor_inlet - seen.duties.flexor_exhaust,
               seen.duties.extensor_inlet - seen.duties.extensor_exhaust};
  if (joint.kind == JointKind::regulated) {
    seen.levels = {level_of(static_cast<float>(seen.duties.flexor_inlet)),
                   level_of(static_cast<float>(seen.duties.extensor_inlet))};
    seen.duties = {};
  }
}

// A muscle over two joints: the later law puts together what both of them ask.
void JointController::share_duties(std::size_t j) noexcept {
  for (const Side side : sides) {
    const Partner& partner = partner_[j][side];
    if (partner.joint < 0 || !partner.drives) continue;
    const auto other = static_cast<std::size_t>(partner.joint);
    const auto of = [](const Pair& pair, Side s) {
      return s == flexor ? pair.flexor : pair.extensor;
    };
    const auto wish = [&](std::size_t joint, Side s) {
      return seen_.joint[joint].enabled ? of(asked_[joint], s) : 0;
    };
    const std::int32_t duty =
        shared_duty(muscle(j, side).share, wish(j, side), muscle(other, partner.side).share,
                    wish(other, partner.side), config_.truncation);
    const Duties both = to_duties({duty, duty}, config_.dead_band);
    const auto put = [&](Duties& duties, Side s) {
      (s == flexor ? duties.flexor_inlet : duties.extensor_inlet) = both.flexor_inlet;
      (s == flexor ? duties.flexor_exhaust : duties.extensor_exhaust) = both.flexor_exhaust;
    };
    put(seen_.joint[j].duties, side);
    put(seen_.joint[other].duties, partner.side);
  }
}

}  // namespace sinew::control
