#include "sinew/control/setup/supervision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sinew/robot/actuator_of.h"

namespace sinew::control {
namespace {

using Kind = robot::Sensor::Kind;

constexpr double fastest_angle = 60;    // [rad/s]
constexpr double beyond_reach = 0.1;    // share of the way from the rest angle
constexpr double beyond_stroke = 0.25;  // a piston rebounds from its stops
constexpr double beyond_supply = 0.1;   // share of its gauge pressure
constexpr double noise_bound = 6;       // standard deviations, robot/sensing.h
constexpr double nowhere = std::numeric_limits<double>::infinity();

// Distances by which a sensor's quantity can decrease and increase from its rest value.
struct Reach {
  double down = nowhere, up = nowhere;  // both above 0
};

// Returns the smallest radius that a tendon has at a joint [m].
double smallest_arm(const robot::Cam& cam, const robot::Joint& joint) {
  double arm = std::isfinite(cam.radius) ? cam.radius : joint.moment_arm;
  if (!cam.radii.empty()) arm = *std::ranges::min_element(cam.radii);
  return arm;
}

// Returns the reach of a joint. A muscle is stretched by the joint's motion against its pull, at
// most until its threads are straight. Muscles over two joints are ignored, since the other joint
// can slacken them.
Reach reach_of(const Installation& in, const robot::Joint& joint) {
  Reach reach;
  for (const robot::Muscle& m : in.robot.muscles) {
    if (m.joint != joint.name || !m.second.joint.empty()) continue;
    const double arm = smallest_arm(m.cam, joint);
    const double slack = robot::actuator_of(m, in.actuators).braid.thread_length - m.mount_length;
    if (!(arm > 0) || !(slack > 0)) continue;
    const bool raises = (m.role == robot::Muscle::Role::flexor) == (joint.sign() > 0);
    double& there = raises ? reach.down : reach.up;
    there = std::min(there, (1 + beyond_reach) * slack / arm);
  }
  return reach;
}

// Range [low, high] of counts within the reach, by both the real and the assumed scale of a sensor.
class Range {
 public:
  Range(const robot::Sensor& sensor, int top) : sensor_(sensor), top_(top) {}

  // Sets both limits. They exclude the converter's ends, unless the sensor rests at one or the
  // converter has too few bits.
  void inside(const Reach& reach, double real, double assumed) {
    double low = nowhere, high = -nowhere;
    for (const auto& [rest, scale] :
         {std::pair{sensor_.at_rest, real}, std::pair{sensor_.assumed_at_rest, assumed}})
      for (const double at : {rest - scale * reach.down, rest + scale * reach.up}) {
        low = std::min(low, at);
        high = std::max(high, at);
      }
    if (top_ < 15) return;
    const double noise = noise_bound * sensor_.noise;
    const auto [lower, upper] = std::minmax(sensor_.at_rest, sensor_.assumed_at_rest);
    const double first = lower - noise < 1 ? 0 : 1,
                 last = upper + noise > top_ - 1 ? top_ : top_ - 1;
    low_ = bounded(std::floor(low - noise), first, last);
    high_ = bounded(std::ceil(high + noise), first, last);
  }

  // Sets the highest count, that of the supply pressure with a margin.
  void below(double real, double assumed, double most) {
    const double high =
        std::max(sensor_.at_rest + real * most, sensor_.assumed_at_rest + assumed * most);
    high_ = bounded(std::ceil(high * (1 + beyond_supply) + noise_bound * sensor_.noise), 1, top_);
  }

  void put(SensorLimits& out) const {
    out.low = static_cast<std::uint16_t>(low_);
    out.high = static_cast<std::uint16_t>(high_);
  }

 private:
  // Clamps x; infinite values become the ends.
  static double bounded(double x, double low, double high) { return std::clamp(x, low, high); }

  const robot::Sensor& sensor_;
  int top_;
  double low_ = 0, high_ = signals::max_counts;
};

void set_plausible(const Installation& in, const robot::Sensor& s, SensorLimits& out) {
  const robot::Robot& robot = in.robot;
  const double per_volt = robot.converter.counts_per_volt();
  Range range(s, robot.converter.top());
  if (!s.plausible.empty()) {
    out.low = static_cast<std::uint16_t>(s.plausible[0]);
    out.high = static_cast<std::uint16_t>(s.plausible[1]);
    return;
  }
  if (s.kind == Kind::angle) {
    const auto j = static_cast<std::size_t>(robot::find_joint(robot, s.of));
    range.inside(reach_of(in, robot.joints[j]), per_volt / s.scale, s.assumed_scale);
  } else if (s.kind == Kind::cylinder) {
    const double around = beyond_stroke * robot.cylinder.stroke;
    range.inside({around, robot.cylinder.stroke + around}, per_volt / s.scale, s.assumed_scale);
  } else if (s.kind == Kind::pressure && s.scale > 0 && s.assumed_scale > 0) {
    range.below(per_volt * s.scale, per_volt * s.assumed_scale, in.supply_pressure - in.atmosphere);
  }
  range.put(out);
}

// Sets the largest change from one scan to the next, with the noise of both readings included.
void set_rate(const Installation& in, const robot::Sensor& s, SensorLimits& out) {
  double rate = s.max_rate;  // [count/s]
  if (!std::isfinite(rate) && s.kind == Kind::angle)
    rate = fastest_angle *
           std::max(std::abs(s.assumed_scale), in.robot.converter.counts_per_volt() / s.scale);
  if (!std::isfinite(rate)) return;
  const double period = in.robot.low_level.pwm_ticks * signals::tick_seconds;
  const double step = std::ceil(rate * period + 2 * noise_bound * s.noise);
  out.max_step = static_cast<std::uint16_t>(std::clamp<double>(step, 1, signals::max_counts));
}

// Sets the joint whose valves move the quantity; regulated muscles have none. A cylinder's valves
// work all the time, even at its stop, so its position is checked only if the file requests it.
void set_driver(const robot::Robot& robot, const JointControllerConfig& joint_controller,
                const robot::Sensor& s, SensorLimits& out) {
  int joint = -1;
  if (s.kind == Kind::angle) joint = robot::find_joint(robot, s.of);
  if (s.kind == Kind::cylinder && has_cylinder_joint(robot) && std::isfinite(s.frozen_limit))
    joint = static_cast<int>(robot.joints.size());
  if (s.kind == Kind::tension || s.kind == Kind::pressure) {
    const auto m = static_cast<std::size_t>(robot::find_muscle(robot, s.of));
    joint = robot::find_joint(robot, robot.muscles[m].joint);
    out.of_flexor = robot.muscles[m].role == robot::Muscle::Role::flexor;
    out.of_extensor = !out.of_flexor;
    out.rests_at_ends = true;
  }
  if (joint < 0 ||
      joint_controller.joint[static_cast<std::size_t>(joint)].kind == JointKind::regulated)
    return;
  out.joint = static_cast<std::int8_t>(joint);
  if (std::isfinite(s.frozen_limit)) {
    const double period = robot.low_level.pwm_ticks * signals::tick_seconds;
    out.frozen_limit =
        static_cast<std::uint32_t>(std::max(1.0, std::ceil(s.frozen_limit / period)));
  }
}

// Limits commanded angles to one converter range beyond either end.
void set_commands(const Installation& in, SuperviseConfig& out) {
  const double period = in.robot.low_level.pwm_ticks * signals::tick_seconds;
  for (std::size_t j = 0; j < in.robot.joints.size(); ++j) {
    const int s = robot::angle_sensor_of(in.robot, static_cast<int>(j));
    if (s < 0) continue;
    CommandLimits& limit = out.command[j];
    limit.low = -signals::max_counts;
    limit.high = 2 * signals::max_counts;
    const double rate = in.robot.low_level.command_rate;
    if (!std::isfinite(rate)) continue;
    const double step =
        std::abs(in.robot.sensors[static_cast<std::size_t>(s)].assumed_scale) * rate * period;
    limit.max_step = static_cast<std::int32_t>(std::clamp(std::ceil(step), 1.0, 1e5));
  }
}

std::string sensor_text(const Trip& trip) {
  using enum Trip::Cause;
  if (trip.cause == range)
    return fmt::format("{} count three times in a row, outside its plausible {} to {} count",
                       trip.counts, trip.low, trip.high);
  if (trip.cause == rate)
    return fmt::format(
        "{} count, further from its last good {} count than its max_rate allows, {} count in a "
        "scan, three times in a row",
        trip.counts, trip.before, trip.high);
  return fmt::format(
      "{} count in {} scans in a row while its muscles were driven, its "
      "frozen_limit",
      trip.counts, trip.high);
}

}  // namespace

SuperviseConfig supervise_config(const Installation& in) {
  SuperviseConfig out;
  const JointControllerConfig joint_controller = joint_controller_config(in);
  for (std::size_t i = 0; i < in.robot.sensors.size() && i < out.sensor.size(); ++i) {
    set_plausible(in, in.robot.sensors[i], out.sensor[i]);
    set_rate(in, in.robot.sensors[i], out.sensor[i]);
    set_driver(in.robot, joint_controller, in.robot.sensors[i], out.sensor[i]);
  }
  set_commands(in, out);
  if (const char* wrong = problem(out)) throw std::invalid_argument(wrong);
  return out;
}

std::string to_text(const Trip& trip, const robot::Robot& robot, int board) {
  using enum Trip::Cause;
  const double at = static_cast<double>(trip.at) * signals::tick_seconds;
  const bool several = robot::boards_of(robot).size() > 1;
  const std::string on = several ? fmt::format(" on board {}", board) : "";
  if (trip.cause == none) return "";
  if (trip.cause == gap)
    return fmt::format("the clock{} at {:.4f} s: a tick came {} ticks or more too late", on, at,
                       trip.high);
  const double limit = static_cast<double>(trip.high) * signals::tick_seconds;
  if (trip.cause == host)
    return fmt::format("the host{} at {:.4f} s: no command for {:g} s", on, at, limit);
  if (trip.cause == held)
    return fmt::format(
        "the board{} at {:.4f} s: all valves were shut for {:g} s, as long as they may be", on, at,
        limit);
  if (trip.cause == requested) return fmt::format("shut down{} at {:.4f} s, as requested", on, at);
  if (trip.cause == command) {
    const std::size_t j = trip.joint;
    const std::string name =
        j < robot.joints.size() ? "joint " + robot.joints[j].name : "the cylinder";
    return fmt::format(
        "the commands for {}{} at {:.4f} s: {} in a row were not numbers, out of "
        "range or faster than low_level.command_rate",
        name, on, at, trip.high);
  }
  const std::string name = trip.channel.index < robot.sensors.size()
                               ? robot.sensors[trip.channel.index].name
                               : fmt::format("{}", trip.channel.index);
  return fmt::format("sensor {}{} at {:.4f} s: {}", name, on, at, sensor_text(trip));
}

}  // namespace sinew::control
