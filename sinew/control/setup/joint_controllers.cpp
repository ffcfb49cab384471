#include "sinew/control/setup/joint_controllers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/control/setup/boards.h"
#include "sinew/control/setup/estimators.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/kinematics.h"
#include "sinew/units/constants.h"
#include "sinew/units/quantity.h"

namespace sinew::control {
namespace {

using Role = robot::Muscle::Role;
using List = std::vector<robot::Contradiction>;

// Unit of stiffness in the controller, lbf in/rad [N m/rad].
constexpr double stiffness_unit = units::pound_force * units::inch;

signals::Channel channel(int sensor) {
  return {static_cast<std::uint8_t>(sensor < 0 ? 0 : sensor)};
}

const robot::Sensor& sensor(const robot::Robot& robot, int index) {
  return robot.sensors[static_cast<std::size_t>(index)];
}

double period_of(const robot::Robot& robot) {
  return robot.low_level.pwm_ticks * signals::tick_seconds;
}

// Lever arm of a muscle's tendon at a joint that it pulls.
struct Pull {
  double arm = 0;   // of a cam that is not round: the radius at rest [m]
  double sign = 1;  // +1: raises the joint's angle
};

Pull pull(const robot::Muscle& m, const robot::Joint& joint) {
  const bool first = m.joint == joint.name;
  const Role role = first ? m.role : m.second.role;
  const double sign = role == Role::flexor ? joint.sign() : -joint.sign();
  return {robot::cam_radius(first ? m.cam : m.second.cam, joint, joint.rest_angle), sign};
}

// Returns the force of a count by the assumed scale [N]; 0 without a transducer.
double newtons_per_count(const robot::Robot& robot, int muscle) {
  const int s = robot::tension_sensor_of(robot, muscle);
  if (s < 0) return 0;
  return 1.0 / (robot.converter.counts_per_volt() * sensor(robot, s).assumed_scale);
}

// A muscle in the units of its joint's laws.
class MuscleSide {
 public:
  MuscleSide(const Installation& in, int joint, int muscle)
      : in_(in),
        joint_(in.robot.joints[static_cast<std::size_t>(joint)]),
        index_(muscle),
        muscle_(in.robot.muscles[static_cast<std::size_t>(muscle)]),
        pull_(pull(muscle_, joint_)),
        counts_per_rad_(sensor(in.robot, robot::angle_sensor_of(in.robot, joint)).assumed_scale),
        counts_per_metre_(counts_per_rad_ / pull_.arm) {}

  // Returns the torque of a count of its tension [N m].
  double torque_per_count() const { return pull_.arm * newtons_per_count(in_.robot, index_); }

  // Return lengths for the stiffness law, before truncation to whole counts [count].
  double free_length() const {
    const double assumed = in_.robot.low_level.assumed_mount_length;
    return counts_per_metre_ * (assumed > 0 ? assumed : muscle_.mount_length);
  }
  double thread_length() const {
    const double assumed = in_.robot.low_level.assumed_thread_length;
    const actuator::Actuator a = robot::actuator_of(muscle_, in_.actuators);
    return counts_per_metre_ * (assumed > 0 ? assumed : a.braid.thread_length);
  }

  void add_misfits(double flexor_torque_per_count, List& out) const;

  MuscleConfig config(double flexor_torque_per_count) const {
    const actuator::Actuator a = robot::actuator_of(muscle_, in_.actuators);
    MuscleConfig c;
    c.tension = channel(robot::tension_sensor_of(in_.robot, index_));
    c.inlet = {static_cast<std::uint8_t>(2 * index_)};
    c.exhaust = {static_cast<std::uint8_t>(2 * index_ + 1)};
    c.free_length = static_cast<std::int32_t>(free_length());
    // b in counts, truncated as in B.1: 3235^2 = 10465225.
    const auto b = static_cast<std::int32_t>(thread_length());
    c.thread_length_squared = b * b;
    if (flexor_torque_per_count > 0)
      c.tension_ratio = static_cast<float>(torque_per_count() / flexor_torque_per_count);
    set_pressure(a, c);
    set_second(c);
    return c;
  }

 private:
  // Returns the factor of [26] for counts of that many pascals.
  double pressure_factor(double pascals) const {
    const actuator::Actuator a = robot::actuator_of(muscle_, in_.actuators);
    return 6.0 * muscle_.count * actuator::braid_factor(a.braid) * pull_.arm * pull_.arm /
           counts_per_metre_ * pascals / stiffness_unit;
  }

  // Sets [26] and [30] in counts of gauge pressure.
  void set_pressure(const actuator::Actuator& a, MuscleConfig& c) const {
    const int s = robot::pressure_sensor_of(in_.robot, index_);
    if (s < 0) return;
    const robot::Sensor& from = sensor(in_.robot, s);
    const double pascals = 1.0 / (in_.robot.converter.counts_per_volt() * from.assumed_scale);
    c.pressure = channel(s);
    c.pressure_at_zero = static_cast<std::int32_t>(std::lround(from.assumed_at_rest));
    c.pressure_factor = static_cast<float>(pressure_factor(pascals));
    const actuator::Effectiveness& e = a.effectiveness;
    // Convert to a polynomial of gauge pressure, also from one of absolute pressure.
    const double zero =
        e.argument == actuator::Effectiveness::Argument::absolute ? in_.atmosphere : 0.0;
    const double c0 = e.c0 + zero * (e.c1 + zero * e.c2), c1 = e.c1 + 2 * zero * e.c2;
    c.effectiveness = {static_cast<float>(e.scale * c0), static_cast<float>(e.scale * c1 * pascals),
                       static_cast<float>(e.scale * e.c2 * pascals * pascals)};
    c.valid_from = static_cast<float>(e.valid_from / pascals);
    c.valid_to = static_cast<float>(e.valid_to / pascals);
  }

  // For a muscle over two joints: sets its share of the duty by moment arm, and its length gained
  // per count of the other joint's angle.
  void set_second(MuscleConfig& c) const {
    if (muscle_.second.joint.empty()) return;
    const bool first = muscle_.joint == joint_.name;
    const int j = robot::find_joint(in_.robot, first ? muscle_.second.joint : muscle_.joint);
    const robot::Joint& other = in_.robot.joints[static_cast<std::size_t>(j)];
    const Pull there = pull(muscle_, other);
    const double scale = sensor(in_.robot, robot::angle_sensor_of(in_.robot, j)).assumed_scale;
    c.share = static_cast<float>(pull_.arm / (pull_.arm + there.arm));
    c.other_travel = static_cast<float>(-there.sign * there.arm / scale * counts_per_metre_);
  }

  const Installation& in_;
  const robot::Joint& joint_;
  int index_;
  const robot::Muscle& muscle_;
  Pull pull_;
  double counts_per_rad_, counts_per_metre_;
};

// If a number does not fit, the cause may be the sensor's scale or the cam as well as the length.
void MuscleSide::add_misfits(double flexor_torque_per_count, List& out) const {
  const robot::LowLevel& low = in_.robot.low_level;
  const std::string muscle = "muscle." + muscle_.name;
  const std::string angle =
      "sensor." + sensor(in_.robot, robot::angle_sensor_of(
                                        in_.robot, robot::find_joint(in_.robot, joint_.name)))
                      .name;
  const auto number = [](double x) { return units::format_number(std::round(x)); };
  const std::string remedy = "another length, " + angle + ".assumed.scale or moment_arm";

  if (!(free_length() < max_length + 1.0))
    out.push_back(
        {low.assumed_mount_length > 0 ? "low_level.assumed_mount_length" : muscle + ".mount_length",
         number(free_length()) + " count of " + angle + " at muscle " + muscle_.name,
         "at most " + std::to_string(max_length) + " count", remedy});
  const double longest = std::sqrt(static_cast<double>(max_thread_length_squared));
  if (!(thread_length() >= 1 && thread_length() < longest))
    out.push_back({low.assumed_thread_length > 0
                       ? "low_level.assumed_thread_length"
                       : "actuator." + muscle_.actuator + ".braid.thread_length",
                   number(thread_length()) + " count of " + angle + " at muscle " + muscle_.name,
                   "1 to " + number(longest) + " count", remedy});
  const int s = robot::tension_sensor_of(in_.robot, index_);
  const double ratio =
      flexor_torque_per_count > 0 ? torque_per_count() / flexor_torque_per_count : 1.0;
  if (s >= 0 && !(ratio <= max_tension_ratio))
    out.push_back({"sensor." + sensor(in_.robot, s).name + ".assumed.scale",
                   "a count " + number(ratio) + " times as strong as the flexor's",
                   "at most " + number(max_tension_ratio) + " times",
                   "the scales of both muscles' transducers"});
  if (const int p = robot::pressure_sensor_of(in_.robot, index_); p >= 0) {
    const double pascals =
        1.0 / (in_.robot.converter.counts_per_volt() * sensor(in_.robot, p).assumed_scale);
    if (!(pressure_factor(pascals) <= max_pressure_factor))
      out.push_back({"sensor." + sensor(in_.robot, p).name + ".assumed.scale",
                     "a count of " + number(pascals) + " Pa", "a finer one",
                     "what the transducer gives for one Pa"});
  }
}

JointKind kind_of(const Installation& in, const std::vector<int>& muscles) {
  for (const int m : muscles)
    for (const gas::Valve& v : in.valves) {
      if (v.name != in.robot.muscles[static_cast<std::size_t>(m)].inlet) continue;
      if (v.kind == gas::Valve::Kind::three_way) return JointKind::three_way;
      if (v.kind == gas::Valve::Kind::regulator) return JointKind::regulated;
    }
  return JointKind::antagonist;
}

StiffnessSource source(robot::StiffnessSource from) {
  using From = robot::StiffnessSource;
  using To = StiffnessSource;
  if (from == From::flexor_force) return To::flexor_force;
  if (from == From::extensor_force) return To::extensor_force;
  if (from == From::pressures) return To::pressure;
  return from == From::none ? To::none : To::force;
}

// Sets the stiffness factor: 767/(819.2 x 0.17) = 5.5075 by the assumed scales; B.1 rounds to 5.5,
// for its 1 in cam.
void set_stiffness_factor(const robot::Robot& robot, double arm, double counts_per_rad, int muscle,
                          JointConfig& out) {
  out.moment_arm_factor = static_cast<float>(arm / units::inch);
  if (robot.low_level.stiffness_factor > 0) {
    out.stiffness_factor = static_cast<float>(robot.low_level.stiffness_factor);
    return;
  }
  const int s = robot::tension_sensor_of(robot, muscle);
  if (s < 0) return;
  const double volts_per_pound = sensor(robot, s).assumed_scale * units::pound_force;
  out.stiffness_factor =
      static_cast<float>(counts_per_rad / (robot.converter.counts_per_volt() * volts_per_pound));
}

// Sets the integral gains per law, in percent and the controller's unit of stiffness.
void set_pressure_law(const robot::PressureLaw& law, double period, JointConfig& c) {
  c.bias = static_cast<std::int32_t>(std::lround(law.bias * 100.0));
  c.regulator.angle_integral = static_cast<float>(law.angle_integral * period * 100.0);
  c.regulator.stiffness_integral =
      static_cast<float>(law.stiffness_integral * period * 100.0 * stiffness_unit);
}

void set_muscles(const Installation& in, int index, JointConfig& c) {
  const robot::Robot& robot = in.robot;
  const int flexor = robot::muscle_of(robot, index, Role::flexor);
  const int extensor = robot::muscle_of(robot, index, Role::extensor);
  const int leading = flexor >= 0 ? flexor : extensor;
  const MuscleSide lead(in, index, leading);
  const double torque = lead.torque_per_count();
  const auto config = [&](int muscle) {
    MuscleConfig none;
    none.present = false;
    return muscle < 0 ? none : MuscleSide(in, index, muscle).config(torque);
  };
  c.flexor = config(flexor);
  c.extensor = config(extensor);

  std::vector<int> muscles;
  for (const int m : {flexor, extensor})
    if (m >= 0) muscles.push_back(m);
  c.kind = kind_of(in, muscles);
  const robot::Joint& joint = robot.joints[static_cast<std::size_t>(index)];
  const robot::Muscle& m = robot.muscles[static_cast<std::size_t>(leading)];
  const int angle = robot::angle_sensor_of(robot, index);
  set_stiffness_factor(robot, pull(m, joint).arm, sensor(robot, angle).assumed_scale, leading, c);
  c.velocity = velocity_config(robot, index, torque, 1.0 / period_of(robot));
}

// Returns the tick of the last reading that the law needs.
std::uint16_t law_tick(const robot::Robot& robot, const JointConfig& c) {
  int tick = 0;
  for (const signals::Channel needed : readings_of(c))
    tick = std::max(tick, sensor(robot, needed.index).tick);
  return static_cast<std::uint16_t>(tick);
}

JointConfig joint_config(const Installation& in, int index) {
  const robot::Robot& robot = in.robot;
  const robot::Joint& joint = robot.joints[static_cast<std::size_t>(index)];
  JointConfig c;
  if (joint.kind == robot::Joint::Kind::passive) {
    c.kind = JointKind::passive;
    c.flexor.present = c.extensor.present = false;
    return c;
  }
  const int angle = robot::angle_sensor_of(robot, index);
  c.enabled = joint.enabled;
  c.angle = channel(angle);
  c.angle_at_rest = static_cast<std::int32_t>(std::lround(sensor(robot, angle).assumed_at_rest));
  c.flexion = joint.sign() > 0 ? std::int8_t{1} : std::int8_t{-1};
  c.lengths_swapped = robot.thesis.knee_lengths_swapped && joint.sign() < 0;
  c.stiffness_source = source(joint.stiffness_source);
  c.pole_clamp = static_cast<std::int32_t>(
      std::lround(robot.low_level.stiffness_pole_clamp * sensor(robot, angle).assumed_scale));
  set_pressure_law(joint.pressure_law, period_of(robot), c);
  set_muscles(in, index, c);
  c.law_tick = law_tick(robot, c);
  return c;
}

// Returns the configuration of joint 0 of B.1, which is the last one here: up is its flexor, down
// its extensor; its valves come after those of the muscles.
JointConfig cylinder_config(const robot::Robot& robot) {
  const robot::Cylinder& from = robot.cylinder;
  const int travel = robot::cylinder_sensor(robot);
  const auto valve = [&](std::size_t i) {
    return signals::Valve{static_cast<std::uint8_t>(2 * robot.muscles.size() + i)};
  };
  const auto percent = [](double share) {
    return static_cast<std::int32_t>(std::lround(share * 100.0));
  };
  JointConfig c;
  c.kind = JointKind::cylinder;
  c.angle = channel(travel);
  c.angle_at_rest = static_cast<std::int32_t>(std::lround(sensor(robot, travel).assumed_at_rest));
  c.flexion = sensor(robot, travel).assumed_scale > 0 ? std::int8_t{1} : std::int8_t{-1};
  c.flexor.inlet = valve(0), c.flexor.exhaust = valve(1);
  c.extensor.inlet = valve(2), c.extensor.exhaust = valve(3);
  c.gains.angle = static_cast<float>(from.position_gain * 100.0);
  c.feedforward = {percent(from.up_feedforward), percent(from.up_feedforward),
                   percent(from.down_feedforward), percent(from.down_feedforward)};
  c.law_tick = law_tick(robot, c);
  return c;
}

Truncation truncation(robot::LowLevel::Rounding rounding) {
  using Rounding = robot::LowLevel::Rounding;
  if (rounding == Rounding::truncate_sum) return Truncation::sum;
  if (rounding == Rounding::none) return Truncation::none;
  return Truncation::each_law;
}

void set_scan(const robot::Robot& robot, JointControllerConfig& c) {
  if (robot.sensors.size() > c.conversion.size())
    throw std::invalid_argument("the low level scans at most " +
                                std::to_string(c.conversion.size()) + " sensors");
  for (std::size_t s = 0; s < robot.sensors.size(); ++s) {
    const auto tick = static_cast<std::uint16_t>(robot.sensors[s].tick);
    c.conversion[c.conversions++] = {channel(static_cast<int>(s)),
                                     static_cast<std::uint16_t>(tick - 1), tick};
  }
}

}  // namespace

// The thesis's interrupt runs a hundred times per period, for every period (5.2).
bool laws_overrun(const robot::Robot& robot) {
  return robot.low_level.interrupt_time > period_of(robot) / 100.0 * (1.0 + 1e-9);
}

std::vector<robot::Contradiction> misfits(const Installation& in) {
  const robot::Robot& robot = in.robot;
  List out;
  const int joints = static_cast<int>(robot.joints.size());
  for (int j = 0; j < joints; ++j) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
    if (joint.kind == robot::Joint::Kind::passive) continue;
    const int flexor = robot::muscle_of(robot, j, Role::flexor);
    const int extensor = robot::muscle_of(robot, j, Role::extensor);
    const double torque = MuscleSide(in, j, flexor >= 0 ? flexor : extensor).torque_per_count();
    for (const int m : {flexor, extensor})
      if (m >= 0) MuscleSide(in, j, m).add_misfits(torque, out);
    const double clamp = robot.low_level.stiffness_pole_clamp *
                         sensor(robot, robot::angle_sensor_of(robot, j)).assumed_scale;
    if (!(std::abs(clamp) <= max_length))
      out.push_back({"low_level.stiffness_pole_clamp",
                     units::format_number(std::round(clamp)) + " count of joint " + joint.name,
                     "within " + std::to_string(max_length) + " count of 0",
                     "a smaller one, or the sensor's assumed.scale"});
  }
  if (robot.low_level.output_delay > robot.low_level.pwm_ticks)
    out.push_back({"low_level.output_delay", std::to_string(robot.low_level.output_delay),
                   "at most pwm_ticks, " + std::to_string(robot.low_level.pwm_ticks), "1"});
  if (!out.empty()) return out;
  try {
    (void)boards(in);
  } catch (const std::invalid_argument& refused) {
    out.push_back({"low_level", refused.what(), "what the low level can work with", ""});
  }
  return out;
}

JointControllerConfig joint_controller_config(const Installation& in) {
  const robot::Robot& robot = in.robot;
  const robot::LowLevel& low = robot.low_level;
  const auto ticks = [](double seconds) {
    return static_cast<std::uint32_t>(std::lround(seconds / signals::tick_seconds));
  };

  if (robot.joints.size() + has_cylinder_joint(robot) > max_joints)
    throw std::invalid_argument("one board has at most 8 joints");
  JointControllerConfig c;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    c.joint[c.joints++] = joint_config(in, static_cast<int>(j));
  if (has_cylinder_joint(robot)) c.joint[c.joints++] = cylinder_config(robot);
  set_scan(robot, c);
  c.period = static_cast<std::uint16_t>(low.pwm_ticks);
  c.output_delay = static_cast<std::uint16_t>(low.output_delay);
  c.truncation = truncation(low.rounding);
  c.timing = in.timing;
  c.dead_band = static_cast<std::int32_t>(std::lround(low.dead_band * 100.0));
  c.startup_vent = ticks(in.settle);
  c.shutdown_vent = ticks(low.vent_time);
  c.hold_limit = static_cast<std::uint32_t>(low.hold_limit);
  c.laws_overrun = laws_overrun(robot);
  if (const char* wrong = problem(c)) throw std::invalid_argument(wrong);
  return c;
}

}  // namespace sinew::control
