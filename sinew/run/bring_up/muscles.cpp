#include "sinew/run/bring_up/muscles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/run/bring_up/wires.h"

namespace sinew::run {

namespace {

// Smallest change of a mean over 50 ms that is not noise [count].
constexpr double seen = 20;
// Tension at which a muscle is full enough to be tried [count].
constexpr double full = 600;
// Largest share of its pull that a shut muscle may lose in a second [1/s]. Dry friction at the
// joint and a soft tendon cause up to this much; more is a leak.
constexpr double leak_limit = 0.10;
// Inlet duty that keeps some air in a muscle that its 3-way valve cannot shut [%].
constexpr std::int32_t three_way_hold = 30;
// Largest share of the rise that may be left after a vent.
constexpr double left_limit = 0.3;

enum : std::size_t { vent, shut, filling, held, emptying };

std::optional<std::size_t> channel_of(const control::Board& board, int sensor) {
  if (sensor < 0) return {};
  const auto at = std::ranges::find(board.channel, static_cast<std::uint8_t>(sensor));
  if (at == board.channel.end()) return {};
  return static_cast<std::size_t>(at - board.channel.begin());
}

// Returns the change of counts at the end of a stage since before the air came.
double over_rest(std::size_t channel, int sign, const Trial& t, std::size_t stage) {
  return sign * (t.stages[stage].after(channel) - t.stages[shut].after(channel));
}

double rise(const BenchMuscle& m, const Trial& t, std::size_t stage) {
  return m.tension ? over_rest(*m.tension, m.tension_sign, t, stage) : 0;
}

double turned(const BenchMuscle& m, const Trial& t, std::size_t stage) {
  return m.angle ? over_rest(*m.angle, m.direction, t, stage) : 0;
}

// Returns the highest rise of its tension while the air came and was held. Its end value is no
// measure, since a joint that yields takes most of the rise back.
double pull(const BenchMuscle& m, const Trial& t) {
  double most = 0;
  if (!m.tension) return most;
  const double rest = t.stages[shut].after(*m.tension);
  for (const std::size_t stage : {filling, held})
    for (const Sample& s : t.stages[stage].samples)
      most = std::max(most, m.tension_sign * (s.counts[*m.tension] - rest));
  return most;
}

// Returns the muscle with the highest rise of tension if it is clearly another one, else nullptr.
const BenchMuscle* other_that_pulls(const std::vector<BenchMuscle>& all, std::size_t which,
                                    const Trial& t) {
  if (!all[which].tension) return nullptr;
  const auto most =
      std::ranges::max_element(all, {}, [&](const BenchMuscle& m) { return pull(m, t); });
  return pull(*most, t) > std::max(seen, 2 * pull(all[which], t)) ? &*most : nullptr;
}

std::string no_air(const BenchMuscle& m) {
  return fmt::format(
      "nothing happened: is the supply's air on, the hose of {} plugged in, its inlet "
      "({}) wired?",
      m.name, m.inlet);
}

// Returns a fault of the path of the air; empty if there is no fault.
std::string wrong_with_filling(const std::vector<BenchMuscle>& all, std::size_t which,
                               const Trial& t) {
  const BenchMuscle& m = all[which];
  const double turn = turned(m, t, held);
  if (const BenchMuscle* other = other_that_pulls(all, which, t)) {
    if (turn > seen)
      return fmt::format(
          "the joint moved as it should, and the tension of {} rose: the cables of {} "
          "and {} have changed places",
          other->name, m.tension_sensor, other->tension_sensor);
    return fmt::format(
        "{} pulled in its place: the inlet ({}) is that of {}, or their hoses have "
        "changed places",
        other->name, m.inlet, other->name);
  }
  const bool pulls = pull(m, t) > seen;
  if (!pulls && std::abs(turn) <= seen) return no_air(m);
  if (m.tension && !pulls)
    return fmt::format("the joint moved and {} did not change: check its cable", m.tension_sensor);
  if (turn < -seen && !m.two_joints)  // the other joint may have moved this one
    return fmt::format("{} goes the wrong way: change the two outer wires of the potentiometer",
                       m.angle_sensor);
  return "";
}

std::string wrong_with_holding(const BenchMuscle& m, double lost) {
  if (!m.tension || !m.has_exhaust || lost <= leak_limit) return "";
  return fmt::format(
      "it loses {:.0f} % in a second with its valves shut; expected {:.0f} % at most: "
      "search for bubbles at its ends, fittings and the exhaust valve",
      100 * lost, 100 * leak_limit);
}

std::string wrong_with_emptying(const BenchMuscle& m, const Trial& t) {
  const double was = m.tension ? rise(m, t, held) : turned(m, t, held);
  const double is = m.tension ? rise(m, t, emptying) : turned(m, t, emptying);
  if (was <= seen || is <= std::max(left_limit * was, seen)) return "";
  return fmt::format(
      "it does not empty ({:.0f} of {:.0f} count are left after a second and a half): "
      "check its exhaust ({})",
      is, was, m.exhaust);
}

// Returns the share of its pull that a muscle loses in a second while it is shut. The first
// moments, in which the joint settles, are left out.
double loss(const BenchMuscle& m, const Trial& t) {
  constexpr double settle = 0.5;
  if (!m.tension) return 0;
  const double rest = t.stages[shut].after(*m.tension);
  for (const Sample& s : t.stages[held].samples)
    if (s.time >= settle) {
      const double from = m.tension_sign * (s.counts[*m.tension] - rest);
      const double time = t.stages[held].seconds() - s.time;
      return from > seen && time > 0 ? (from - rise(m, t, held)) / from / time : 0;
    }
  return 0;
}

}  // namespace

std::vector<BenchMuscle> bench_muscles(const experiment::Experiment& e, const control::Board& board,
                                       const Pins* pins) {
  const std::vector<Wire> valves = valve_wires(e, board, pins);
  std::vector<BenchMuscle> out;
  for (std::size_t j = 0; j < board.joint_controller.joints; ++j) {
    const control::JointConfig& c = board.joint_controller.joint[j];
    const bool three_way = c.kind == control::JointKind::three_way;
    if (c.kind != control::JointKind::antagonist && !three_way) continue;
    const int joint = board.joint[j];
    for (const auto role : {robot::Muscle::Role::flexor, robot::Muscle::Role::extensor}) {
      const bool flexor = role == robot::Muscle::Role::flexor;
      const int number = robot::muscle_of(e.robot, joint, role);
      const control::MuscleConfig& muscle = flexor ? c.flexor : c.extensor;
      if (number < 0 || !muscle.present) continue;
      const robot::Muscle& m = e.robot.muscles[static_cast<std::size_t>(number)];
      const int tension = robot::tension_sensor_of(e.robot, number);
      const int angle = robot::angle_sensor_of(e.robot, joint);
      const auto sensor = [&](int which) {
        return which < 0 ? robot::Sensor{} : e.robot.sensors[static_cast<std::size_t>(which)];
      };
      out.push_back({.name = m.name,
                     .joint = e.robot.joints[static_cast<std::size_t>(joint)].name,
                     .board_joint = j,
                     .flexor = flexor,
                     .two_joints = !m.second.joint.empty(),
                     .has_exhaust = !three_way,
                     .direction = flexor ? c.flexion : -c.flexion,
                     .tension = channel_of(board, tension),
                     .angle = channel_of(board, angle),
                     .tension_sign = sensor(tension).assumed_scale < 0 ? -1 : 1,
                     .inlet = valves[muscle.inlet.index].to_text(),
                     .exhaust = valves[(three_way ? muscle.inlet : muscle.exhaust).index].to_text(),
                     .angle_sensor = sensor(angle).name,
                     .tension_sensor = sensor(tension).name});
    }
  }
  return out;
}

control::Duties fill(const BenchMuscle& m) {
  return m.flexor ? control::Duties{100, 0, 0, 100} : control::Duties{0, 100, 100, 0};
}

std::vector<Stage> stages_for(const BenchMuscle& m, std::size_t joints) {
  const std::vector<control::Duties> all_empty(joints, empty_both);
  std::vector<control::Duties> filled = all_empty, closed = all_empty;
  filled[m.board_joint] = fill(m);
  closed[m.board_joint] = fill(m);
  (m.flexor ? closed[m.board_joint].flexor_inlet : closed[m.board_joint].extensor_inlet) =
      m.has_exhaust ? 0 : three_way_hold;
  std::vector<Stage> out{{0.5, all_empty},
                         {0.3, {}},
                         {0.6, filled},
                         {m.has_exhaust ? 2.0 : 0.5, closed},
                         {1.5, all_empty}};
  if (m.tension)
    out[filling].ends = [start = std::optional<double>(), m](const Sample& s) mutable {
      if (!start) start = s.counts[*m.tension];
      return m.tension_sign * (s.counts[*m.tension] - *start) > full;
    };
  return out;
}

MuscleResult evaluate(const std::vector<BenchMuscle>& all, std::size_t which, const Trial& t) {
  const BenchMuscle& m = all[which];
  MuscleResult out;
  if (!t.problem.empty()) {
    out.wrong.push_back("the board ended the trial: " + t.problem);
    return out;
  }
  const double lost = loss(m, t);
  out.findings = fmt::format("tension {:+.0f} count, {} {:+.0f} count", pull(m, t), m.joint,
                             m.direction * turned(m, t, held));
  if (m.angle) out.findings += fmt::format(", to {:.0f}", t.stages[held].after(*m.angle));
  if (m.has_exhaust) out.findings += fmt::format(", {:.1f} % lost in a second", 100 * lost);
  for (const std::string& wrong :
       {wrong_with_filling(all, which, t), wrong_with_holding(m, lost), wrong_with_emptying(m, t)})
    if (!wrong.empty()) out.wrong.push_back(wrong);
  return out;
}

namespace {

// Distance to the sensor's limits that a run needs for noise and for some swing beyond the end
// [count].
constexpr double margin = 20;
// Smallest distance between a joint's ends that is a stroke [count].
constexpr double least_stroke = 60;

// Index of the stage of a stroke that fills its muscle.
constexpr std::size_t filled = 2;

}  // namespace

std::vector<BenchJoint> bench_joints(const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles) {
  std::vector<BenchJoint> out;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    const BenchMuscle& m = muscles[i];
    if (!m.angle || m.two_joints) continue;
    if (out.empty() || out.back().name != m.joint) {
      const control::SensorLimits& limits = board.limits.sensor[*m.angle];
      out.push_back({m.joint, m.angle_sensor, *m.angle, {}, limits.low, limits.high});
    }
    out.back().muscles.push_back(i);
  }
  return out;
}

std::vector<Stage> stroke_of(const BenchMuscle& m, std::size_t joints) {
  const std::vector<control::Duties> all_empty(joints, empty_both);
  std::vector<control::Duties> one_full = all_empty;
  one_full[m.board_joint] = fill(m);
  return {{0.5, all_empty}, {0.1, {}}, {1.5, one_full}, {1.5, all_empty}};
}

double end_of_stroke(const BenchJoint& joint, const Trial& t) {
  return t.stages[filled].after(joint.angle);
}

std::vector<std::string> wrong_with_ends(const BenchJoint& joint,
                                         const std::vector<BenchMuscle>& muscles,
                                         const std::vector<double>& ends) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i] < joint.lowest + margin || ends[i] > joint.top - margin)
      out.push_back(
          fmt::format("{} reads {:.0f} where {} has pulled {} to its end; expected {:.0f} to "
                      "{:.0f}: a run would "
                      "end there; turn the sensor on its shaft, or put a stop to the joint",
                      joint.angle_sensor, ends[i], muscles[joint.muscles[i]].name, joint.name,
                      joint.lowest + margin, joint.top - margin));
  if (ends.size() == 2) {
    const double stroke = muscles[joint.muscles[0]].direction * (ends[0] - ends[1]);
    if (stroke < least_stroke)
      out.push_back(
          fmt::format("{} goes {:.0f} count from end to end; expected {:.0f} at least: is "
                      "something in its way, or a tendon loose?",
                      joint.name, stroke, least_stroke));
  }
  return out;
}

}  // namespace sinew::run
