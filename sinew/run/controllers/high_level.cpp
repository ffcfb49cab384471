#include "sinew/run/controllers/high_level.h"

#include <cmath>

#include "sinew/robot/boards.h"
#include "sinew/units/constants.h"

namespace sinew::run {
namespace {

// One lbf in/rad, the controller's unit of stiffness  [N m/rad].
constexpr double stiffness_unit = units::pound_force * units::inch;

// Rounds, since a whole percentage may be inexact: 0.29 x 100 = 28.999...
int percent(double share) { return static_cast<int>(std::lround(share * 100.0)); }

// Returns the scales and offsets that the robot's file gives its controller.
AssumedScales assumed_scales(const robot::Robot& robot) {
  AssumedScales b;
  const auto sensor = [&](int s) -> const robot::Sensor& {
    return robot.sensors[static_cast<std::size_t>(s)];
  };
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const int s = robot::angle_sensor_of(robot, static_cast<int>(j));
    b.rest[j] = robot.joints[j].rest_angle;
    b.angle_channel[j] = s;
    if (s < 0) continue;
    b.counts_per_rad[j] = sensor(s).assumed_scale;
    b.counts_at_rest[j] = sensor(s).assumed_at_rest;
  }
  for (std::size_t m = 0; m < robot.muscles.size(); ++m) {
    const int s = robot::tension_sensor_of(robot, static_cast<int>(m));
    b.tension_channel[m] = s;
    if (s < 0) continue;
    b.newtons_per_count[m] = 1.0 / (sensor(s).assumed_scale * robot.converter.counts_per_volt());
    b.counts_at_zero[m] = sensor(s).assumed_at_rest;
  }
  const int s = robot::cylinder_sensor(robot);
  b.cylinder_channel = s;
  if (s >= 0) {
    b.cylinder_counts_per_metre = sensor(s).assumed_scale;
    b.cylinder_at_rest = sensor(s).assumed_at_rest;
  }
  return b;
}

}  // namespace

HighLevel::HighLevel(const robot::Robot& robot, const gait::Plan& plan, Steering* steering)
    : joints_(static_cast<int>(robot.joints.size())),
      muscles_(static_cast<int>(robot.muscles.size())),
      vents_(plan.finish == gait::Plan::Finish::vent && robot.low_level.vent_time > 0),
      has_cylinder_(robot::has_cylinder_joint(robot)),
      cylinder_gain_(static_cast<float>(robot.cylinder.position_gain * 100.0)),
      gait_period_ticks_(std::llround(plan.high_level_period / signals::tick_seconds)),
      scale_(assumed_scales(robot)),
      legs_(robot, plan),
      changes_(plan, robot::legs_of(robot), steering) {
  for (std::size_t l = 0; l < legs_.count(); ++l) desired_[l] = legs_.desired(l);
}

// A joint without a sensor is assumed to be at rest.
gait::MachineMeasured HighLevel::measure(const MachineState& state) const noexcept {
  gait::MachineMeasured measured;
  const auto counts = [&](int channel) -> double {
    return state.reading(static_cast<std::size_t>(channel)).counts;
  };
  for (int j = 0; j < joints_; ++j) {
    const auto k = static_cast<std::size_t>(j);
    measured.angle[k] = scale_.rest[k];
    if (scale_.angle_channel[k] < 0) continue;
    measured.angle[k] =
        scale_.rest[k] +
        (counts(scale_.angle_channel[k]) - scale_.counts_at_rest[k]) / scale_.counts_per_rad[k];
    measured.velocity[k] = static_cast<double>(state.joint(k).velocity) / scale_.counts_per_rad[k];
    measured.stiffness[k] = static_cast<double>(state.joint(k).stiffness) * stiffness_unit;
  }
  for (int m = 0; m < muscles_; ++m) {
    const auto k = static_cast<std::size_t>(m);
    if (scale_.tension_channel[k] < 0) continue;
    measured.tension[k] = (counts(scale_.tension_channel[k]) - scale_.counts_at_zero[k]) *
                          scale_.newtons_per_count[k];
  }
  if (scale_.cylinder_channel >= 0)
    measured.cylinder = (counts(scale_.cylinder_channel) - scale_.cylinder_at_rest) /
                        scale_.cylinder_counts_per_metre;
  return measured;
}

void HighLevel::restore(const State& state) noexcept {
  legs_.restore(state.legs);
  changes_.restore(state.changes);
  desired_ = state.desired;
  command_ = state.command;
}

const MachineCommand& HighLevel::update(const MachineState& state, signals::Tick t) noexcept {
  legs_.update(measure(state), t / gait_period_ticks_);
  for (std::size_t l = 0; l < legs_.count(); ++l) desired_[l] = legs_.desired(l);
  changes_.apply(t, {desired_.data(), legs_.count()});
  for (std::size_t l = 0; l < legs_.count(); ++l) translate(desired_[l], legs_.parts(l));
  if (has_cylinder_) move_cylinder(desired_[0]);
  return command_;
}

void HighLevel::translate(const gait::Desired& desired, const robot::LegParts& leg) noexcept {
  for (std::size_t i = 0; i < leg.joints.size(); ++i) {
    const auto k = static_cast<std::size_t>(leg.joints[i]);
    const gait::DesiredJoint& want = desired.joint[i];
    control::JointCommand& joint = command_[k];

    // B.1: thetades = (theta - rest) * 767 + potoffset, cut to an integer.
    joint.angle = static_cast<std::int32_t>(
        (want.angle - scale_.rest[k]) * scale_.counts_per_rad[k] + scale_.counts_at_rest[k]);
    joint.stiffness = static_cast<float>(want.stiffness / stiffness_unit);
    joint.gains.angle = static_cast<float>(want.gains.angle * 100.0);
    joint.gains.stiffness = static_cast<float>(want.gains.stiffness * 100.0 * stiffness_unit);
    joint.gains.velocity = static_cast<float>(want.gains.velocity * 100.0);
    joint.enabled = want.enabled;
    joint.open_loop = want.open_loop;
    joint.duties = {.flexor_inlet = percent(want.flexor_inlet),
                    .flexor_exhaust = percent(want.flexor_exhaust),
                    .extensor_inlet = percent(want.extensor_inlet),
                    .extensor_exhaust = percent(want.extensor_exhaust)};
  }
}

// Holds the cylinder at its extended stop, as in the thesis's runs, unless the plan sets another
// position. With several legs the first leg's plan moves it.
void HighLevel::move_cylinder(const gait::Desired& desired) noexcept {
  control::JointCommand& joint = command_[static_cast<std::size_t>(joints_)];
  const double travel = desired.cylinder.given ? desired.cylinder.position : 0.0;
  joint.angle = static_cast<std::int32_t>(
      std::lround(scale_.cylinder_at_rest + travel * scale_.cylinder_counts_per_metre));
  joint.gains.angle = cylinder_gain_;
  joint.enabled = desired.stage != gait::Stage::settling && !desired.vent;
  joint.open_loop = desired.cylinder.open_loop;
  joint.duties = {.flexor_inlet = percent(desired.cylinder.up_inlet),
                  .flexor_exhaust = percent(desired.cylinder.up_exhaust),
                  .extensor_inlet = percent(desired.cylinder.down_inlet),
                  .extensor_exhaust = percent(desired.cylinder.down_exhaust)};
}

}  // namespace sinew::run
