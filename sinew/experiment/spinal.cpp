#include "sinew/experiment/spinal.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sinew/robot/actuator_of.h"
#include "sinew/units/constants.h"

namespace sinew::experiment {
namespace {

signals::Channel channel(int sensor) { return {static_cast<std::uint8_t>(sensor)}; }

control::MuscleConfig muscle_config(const robot::Robot& robot, int muscle,
                                    double counts_per_metre) {
  const robot::Muscle& m = robot.muscles[static_cast<std::size_t>(muscle)];
  const double assumed = robot.low_level.assumed_mount_length;
  const double length = assumed > 0 ? assumed : m.mount_length;
  return {.tension = channel(robot::tension_sensor_of(robot, muscle)),
          .inlet = {static_cast<std::uint8_t>(2 * muscle)},
          .exhaust = {static_cast<std::uint8_t>(2 * muscle + 1)},
          .free_length = static_cast<std::int32_t>(length * counts_per_metre)};
}

// The law runs when the last of the joint's sensors has been read.
int law_tick(const robot::Robot& robot, int joint, int flexor, int extensor) {
  int tick = robot.sensors[static_cast<std::size_t>(robot::angle_sensor_of(robot, joint))].tick;
  for (int muscle : {flexor, extensor}) {
    const int s = robot::tension_sensor_of(robot, muscle);
    tick = std::max(tick, robot.sensors[static_cast<std::size_t>(s)].tick);
  }
  return tick;
}

// 767/(819.2 x 0.17) = 5.5075 by the assumed scales; B.1 rounds to 5.5, for its 1 in cam.
void set_stiffness_factor(const robot::Robot& robot, const robot::Joint& joint,
                          double counts_per_rad, int flexor, control::JointConfig& out) {
  const double arm_inches = joint.moment_arm / units::inch;
  out.moment_arm_factor = static_cast<float>(arm_inches);
  if (robot.low_level.stiffness_factor > 0) {
    out.stiffness_factor = static_cast<float>(robot.low_level.stiffness_factor);
    return;
  }
  const int s = robot::tension_sensor_of(robot, flexor);
  const double volts_per_pound =
      robot.sensors[static_cast<std::size_t>(s)].assumed_scale * units::pound_force;
  out.stiffness_factor =
      static_cast<float>(counts_per_rad / (robot.converter.counts_per_volt() * volts_per_pound));
}

control::JointConfig joint_config(const Experiment& e, int index) {
  const robot::Robot& robot = e.robot;
  const robot::Joint& joint = robot.joints[static_cast<std::size_t>(index)];
  const int flexor = robot::muscle_of(robot, index, robot::Muscle::Role::flexor);
  const int extensor = robot::muscle_of(robot, index, robot::Muscle::Role::extensor);
  const int angle = robot::angle_sensor_of(robot, index);
  const robot::Sensor& sensor = robot.sensors[static_cast<std::size_t>(angle)];
  const double counts_per_metre = sensor.assumed_scale / joint.moment_arm;

  control::JointConfig c;
  c.enabled = joint.enabled;
  c.angle = channel(angle);
  c.flexor = muscle_config(robot, flexor, counts_per_metre);
  c.extensor = muscle_config(robot, extensor, counts_per_metre);
  c.law_tick = static_cast<std::uint16_t>(law_tick(robot, index, flexor, extensor));
  c.angle_at_rest = static_cast<std::int32_t>(std::lround(sensor.assumed_at_rest));
  c.flexion = joint.sign() > 0 ? std::int8_t{1} : std::int8_t{-1};
  c.lengths_swapped = robot.thesis.knee_lengths_swapped && joint.sign() < 0;

  // b in counts, cut as in B.1: 3235^2 = 10465225.
  double thread = robot.low_level.assumed_thread_length;
  if (thread <= 0)
    thread = robot::actuator_of(robot.muscles[static_cast<std::size_t>(flexor)], e.actuators)
                 .braid.thread_length;
  const auto counts = static_cast<std::int32_t>(thread * counts_per_metre);
  c.flexor.thread_length_squared = c.extensor.thread_length_squared = counts * counts;
  set_stiffness_factor(robot, joint, sensor.assumed_scale, flexor, c);
  c.pole_clamp = static_cast<std::int32_t>(
      std::lround(robot.low_level.stiffness_pole_clamp * sensor.assumed_scale));
  return c;
}

control::Truncation truncation(robot::LowLevel::Rounding rounding) {
  using Rounding = robot::LowLevel::Rounding;
  if (rounding == Rounding::truncate_sum) return control::Truncation::sum;
  if (rounding == Rounding::none) return control::Truncation::none;
  return control::Truncation::each_law;
}

}  // namespace

control::SpineConfig spine_config(const Experiment& e) {
  const robot::Robot& robot = e.robot;
  const auto ticks = [](double seconds) {
    return static_cast<std::uint32_t>(std::lround(seconds / signals::tick_seconds));
  };

  control::SpineConfig c;
  c.joints = robot.joints.size();
  for (std::size_t j = 0; j < c.joints; ++j) c.joint[j] = joint_config(e, static_cast<int>(j));

  if (robot.sensors.size() > c.conversion.size())
    throw std::invalid_argument("the low level scans at most 16 sensors");
  for (std::size_t s = 0; s < robot.sensors.size(); ++s) {
    const auto tick = static_cast<std::uint16_t>(robot.sensors[s].tick);
    c.conversion[c.conversions++] = {channel(static_cast<int>(s)),
                                     static_cast<std::uint16_t>(tick - 1), tick};
  }
  c.period = static_cast<std::uint16_t>(robot.low_level.pwm_ticks);
  c.output_delay = static_cast<std::uint16_t>(robot.low_level.output_delay);
  c.truncation = truncation(robot.low_level.rounding);
  c.timing = e.timing;
  c.startup_vent = ticks(e.start.settle);
  c.shutdown_vent = ticks(robot.low_level.vent_time);
  if (const char* wrong = control::problem(c)) throw std::invalid_argument(wrong);
  return c;
}

}  // namespace sinew::experiment
