#include "sinew/control/joint/config.h"

#include "sinew/control/joint/laws.h"

namespace sinew::control {
namespace {

bool read_at(const JointControllerConfig& config, std::uint16_t tick) noexcept {
  for (std::size_t i = 0; i < config.conversions; ++i)
    if (config.conversion[i].read == tick) return true;
  return false;
}

bool converted(const JointControllerConfig& config, signals::Channel channel) noexcept {
  for (std::size_t i = 0; i < config.conversions; ++i)
    if (config.conversion[i].channel.index == channel.index) return true;
  return false;
}

const char* problem_of_scan(const JointControllerConfig& config) noexcept {
  if (config.conversions > max_conversions) return "more conversions than max_conversions";
  std::uint16_t last = 0;
  for (std::size_t i = 0; i < config.conversions; ++i) {
    const signals::Conversion& c = config.conversion[i];
    if (c.channel.index >= max_channels) return "a conversion's channel is beyond max_channels";
    if (c.start >= c.read) return "a conversion must start before it is read";
    if (c.read >= config.period) return "a conversion is read after the end of the period";
    if (i > 0 && c.read <= last) return "conversions must ascend in the tick they are read at";
    last = c.read;
  }
  return nullptr;
}

const char* problem_of_muscle(const MuscleConfig& muscle, JointKind kind) noexcept {
  if (muscle.free_length < 0 || muscle.free_length > max_length) return "free_length out of range";
  if (muscle.thread_length_squared <= 0 || muscle.thread_length_squared > max_thread_length_squared)
    return "thread_length_squared out of range";
  if (!(muscle.share >= 0 && muscle.share <= 1)) return "a muscle's share must be 0 to 1";
  if (!within(muscle.other_travel, max_other_travel)) return "other_travel out of range";
  if (!within(muscle.tension_ratio, max_tension_ratio)) return "tension_ratio out of range";
  if (!within(muscle.pressure_factor, max_pressure_factor)) return "pressure_factor out of range";
  if (muscle.exhaust_inverted && !has_exhausts(kind)) return "no exhaust that could be inverted";
  return nullptr;
}

const char* problem_of_velocity(const VelocityConfig& v) noexcept {
  if (v.estimator == Estimator::weighted_average && (v.samples < 2 || v.samples > max_samples))
    return "a weighted average needs 2 to 16 samples";
  for (const float x :
       {v.decay, v.speed_gain, v.travel, v.travel_gain, v.angle_share, v.speed_share, v.scale})
    if (!within(x, 1e5f)) return "a constant of the velocity estimator is out of range";
  if (!(v.margin >= 0) || !(v.limit >= 0 && v.limit <= speed_limit))
    return "the velocity's margin and limit must not be negative";
  return nullptr;
}

// Returns whether the stiffness source is a muscle that does not exist.
bool source_without_muscle(const JointConfig& joint) noexcept {
  return (joint.stiffness_source == StiffnessSource::flexor_force && !joint.flexor.present) ||
         (joint.stiffness_source == StiffnessSource::extensor_force && !joint.extensor.present);
}

const char* problem_of_joint(const JointControllerConfig& config,
                             const JointConfig& joint) noexcept {
  if (joint.kind == JointKind::passive)
    return joint.flexor.present || joint.extensor.present ? "a passive joint has no muscles"
                                                          : nullptr;
  if (is_timed(joint.kind)) {
    if (!joint.flexor.present || joint.extensor.present) return "a timed joint has one actuator";
    return problem_of_muscle(joint.flexor, joint.kind);
  }
  if (joint.flexion != 1 && joint.flexion != -1) return "flexion must be +1 or -1";
  if (!read_at(config, joint.law_tick)) return "no conversion is read at a joint's law_tick";
  for (const signals::Channel c : readings_of(joint))
    if (!converted(config, c)) return "an angle, tension, pressure or velocity is not converted";
  if (joint.angle_at_rest < 0 || joint.angle_at_rest > max_length)
    return "angle_at_rest out of range";
  if (joint.pole_clamp < -max_length || joint.pole_clamp > max_length)
    return "pole_clamp out of range";
  for (const std::int32_t duty :
       {joint.feedforward.flexor_inlet, joint.feedforward.flexor_exhaust,
        joint.feedforward.extensor_inlet, joint.feedforward.extensor_exhaust, joint.bias})
    if (duty < 0 || duty > signals::max_duty) return "feedforward duties must be 0 to 100 %";
  if (source_without_muscle(joint)) return "the stiffness source is a muscle that is not there";
  if (const char* p = problem_of_velocity(joint.velocity)) return p;
  if (const char* p = problem_of_muscle(joint.flexor, joint.kind)) return p;
  return problem_of_muscle(joint.extensor, joint.kind);
}

// A valve and the joint that uses it. Each coil has one pulse train, so valves must differ, except
// those of a muscle over two joints.
struct Owner {
  std::uint8_t valve = 0, joint = 0;  // first joint that uses the valve
  std::uint8_t times = 0;             // number of uses as an inlet; 0: it is an exhaust
  std::uint8_t exhaust = 0;           // exhaust that belongs to this inlet
};

// List of used valves; small, since a board has a small stack.
struct Owners {
  std::array<Owner, 4 * max_joints> owner{};
  std::size_t count = 0;

  Owner* find(signals::Valve valve) noexcept {
    for (std::size_t i = 0; i < count; ++i)
      if (owner[i].valve == valve.index) return &owner[i];
    return nullptr;
  }
  void add(const Owner& o) noexcept { owner[count++] = o; }
};

constexpr const char* same_valve = "two muscles use the same valve";

// Returns nullptr if `owner`'s valve may also be the inlet of this muscle of joint `j`, or a
// message.
const char* problem_of_inlet(const JointControllerConfig& config, std::size_t j,
                             const MuscleConfig& m, Owner& owner) noexcept {
  const bool both_seal = config.joint[owner.joint].kind == JointKind::antagonist &&
                         config.joint[j].kind == JointKind::antagonist;
  if (owner.times == 0 || owner.joint == j || ++owner.times > 2 || !both_seal ||
      owner.exhaust != m.exhaust.index)
    return same_valve;
  return nullptr;
}

const char* problem_of_valves(const JointControllerConfig& config) noexcept {
  Owners owners;
  for (std::size_t j = 0; j < config.joints; ++j) {
    const JointConfig& joint = config.joint[j];
    const auto number = static_cast<std::uint8_t>(j);
    for (const MuscleConfig* m : {&joint.flexor, &joint.extensor}) {
      if (!m->present) continue;
      if (Owner* owner = owners.find(m->inlet)) {
        if (const char* p = problem_of_inlet(config, j, *m, *owner)) return p;
        continue;
      }
      owners.add({m->inlet.index, number, 1, m->exhaust.index});
      if (!has_exhausts(joint.kind)) continue;
      if (owners.find(m->exhaust) != nullptr) return same_valve;
      owners.add({.valve = m->exhaust.index, .joint = number});
      if (m->exhaust_inverted && config.startup_vent == 0)
        return "an inverted exhaust is open until it is driven: it needs a startup_vent";
    }
  }
  return nullptr;
}

void need(Readings& readings, signals::Channel channel) noexcept {
  readings.channel[readings.count++] = channel;
}

}  // namespace

Readings readings_of(const JointConfig& joint) noexcept {
  Readings out;
  if (joint.kind == JointKind::passive || is_timed(joint.kind)) return out;
  need(out, joint.angle);
  if (joint.kind == JointKind::cylinder) return out;

  using enum StiffnessSource;
  const StiffnessSource from = joint.stiffness_source;
  const bool moves = joint.velocity.speed_gain != 0;
  const bool flexor = from == force || from == flexor_force || moves;
  const bool extensor = from == force || from == extensor_force || moves;
  if (joint.flexor.present && flexor) need(out, joint.flexor.tension);
  if (joint.extensor.present && extensor) need(out, joint.extensor.tension);
  if (joint.flexor.present && from == pressure) need(out, joint.flexor.pressure);
  if (joint.extensor.present && from == pressure) need(out, joint.extensor.pressure);
  if (joint.velocity.estimator == Estimator::sensor) need(out, joint.velocity.channel);
  return out;
}

const char* problem(const JointControllerConfig& config) noexcept {
  if (config.joints > max_joints) return "more joints than max_joints";
  if (config.period == 0) return "the period must not be 0";
  if (config.output_delay < 1 || config.output_delay > config.period)
    return "output_delay must be 1 to period ticks";
  if (!signals::closes_at_zero(config.timing, config.period))
    return "valve timing: duty 0 must close at once and never open";
  if (const char* p = problem_of_scan(config)) return p;
  for (std::size_t j = 0; j < config.joints; ++j)
    if (const char* p = problem_of_joint(config, config.joint[j])) return p;
  if (config.dead_band < 0 || config.dead_band > signals::max_duty)
    return "dead_band must be 0 to 100 %";
  return problem_of_valves(config);
}

Command rest_command(const JointControllerConfig& config) noexcept {
  Command command;
  for (std::size_t j = 0; j < max_joints; ++j) {
    const JointConfig& joint = config.joint[j];
    command.joint[j].angle = joint.angle_at_rest;
    command.joint[j].gains = joint.gains;
    command.joint[j].duties = joint.feedforward;
  }
  return command;
}

}  // namespace sinew::control
