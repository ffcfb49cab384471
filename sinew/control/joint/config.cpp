#include "sinew/control/joint/config.h"

namespace sinew::control {
namespace {

constexpr std::int32_t max_length = 20'000;  // [count]; 3 L^2 fits 32 bits, L a float

bool read_at(const SpineConfig& config, std::uint16_t tick) noexcept {
  for (std::size_t i = 0; i < config.conversions; ++i)
    if (config.conversion[i].read == tick) return true;
  return false;
}

bool converted(const SpineConfig& config, signals::Channel channel) noexcept {
  for (std::size_t i = 0; i < config.conversions; ++i)
    if (config.conversion[i].channel.index == channel.index) return true;
  return false;
}

const char* problem_of_scan(const SpineConfig& config) noexcept {
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

const char* problem_of_muscle(const SpineConfig& config, const MuscleConfig& muscle,
                              JointKind kind) noexcept {
  if (muscle.free_length < 0 || muscle.free_length > max_length) return "free_length out of range";
  if (kind == JointKind::antagonist && !converted(config, muscle.tension))
    return "a tension is not among the conversions";
  return nullptr;
}

const char* problem_of_joint(const SpineConfig& config, const JointConfig& joint) noexcept {
  if (joint.flexion != 1 && joint.flexion != -1) return "flexion must be +1 or -1";
  if (!read_at(config, joint.law_tick)) return "no conversion is read at a joint's law_tick";
  if (!converted(config, joint.angle)) return "a joint's angle is not among the conversions";
  if (joint.thread_length_squared <= 0 || joint.thread_length_squared >= 1 << 30)
    return "thread_length_squared out of range";
  if (joint.angle_at_rest < 0 || joint.angle_at_rest > max_length)
    return "angle_at_rest out of range";
  if (joint.pole_clamp < -max_length || joint.pole_clamp > max_length)
    return "pole_clamp out of range";
  for (const std::int32_t duty :
       {joint.feedforward.flexor_inlet, joint.feedforward.flexor_exhaust,
        joint.feedforward.extensor_inlet, joint.feedforward.extensor_exhaust})
    if (duty < 0 || duty > signals::max_duty) return "feedforward duties must be 0 to 100 %";
  if (const char* p = problem_of_muscle(config, joint.flexor, joint.kind)) return p;
  return problem_of_muscle(config, joint.extensor, joint.kind);
}

// One coil, one pulse train.
bool valves_differ(const SpineConfig& config) noexcept {
  std::array<bool, 256> used{};
  for (std::size_t j = 0; j < config.joints; ++j) {
    const JointConfig& joint = config.joint[j];
    for (const MuscleConfig* m : {&joint.flexor, &joint.extensor})
      for (const signals::Valve v : {m->inlet, m->exhaust}) {
        if (used[v.index]) return false;
        used[v.index] = true;
      }
  }
  return true;
}

}  // namespace

const char* problem(const SpineConfig& config) noexcept {
  if (config.joints > max_joints) return "more joints than max_joints";
  if (config.period == 0) return "the period must not be 0";
  if (config.output_delay < 1 || config.output_delay > config.period)
    return "output_delay must be 1 to period ticks";
  if (!signals::closes_at_zero(config.timing, config.period))
    return "valve timing: duty 0 must close at once and never open";
  if (const char* p = problem_of_scan(config)) return p;
  for (std::size_t j = 0; j < config.joints; ++j)
    if (const char* p = problem_of_joint(config, config.joint[j])) return p;
  if (!valves_differ(config)) return "two muscles use the same valve";
  return nullptr;
}

Command rest_command(const SpineConfig& config) noexcept {
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
