#include "sinew/control/gait/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sinew/control/gait/path.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"

namespace sinew::gait {

namespace {

// Returns "hip" of "joint.hip.angle", or nothing if the name does not have that head and tail.
std::string_view middle(std::string_view name, std::string_view head, std::string_view tail) {
  if (name.size() <= head.size() + tail.size()) return {};
  if (!name.starts_with(head) || !name.ends_with(tail)) return {};
  return name.substr(head.size(), name.size() - head.size() - tail.size());
}

Measure at(Measure::Kind kind, int index) {
  return index < 0 ? Measure{Measure::Kind::unknown, -1} : Measure{kind, index};
}

int whole_periods(double seconds, double period) {
  return std::max(1, static_cast<int>(std::lround(seconds / period)));
}

}  // namespace

Plan plan_for(const robot::Robot& robot) {
  Plan plan;
  const robot::Robot leg = robot::only_leg(robot, 0);
  for (const robot::Joint& joint : leg.joints)
    plan.joints.push_back({.name = joint.name,
                           .stiffness = 0,
                           .gains = joint.gains,
                           .enabled = joint.enabled && joint.kind == robot::Joint::Kind::driven,
                           .driven = joint.kind == robot::Joint::Kind::driven,
                           .range = {}});
  return plan;
}

double within(const std::vector<double>& range, double angle) noexcept {
  if (range.size() != 2) return angle;
  const double half = 0.5 * (range[1] - range[0]);
  const double middle = range[0] + half;
  const double from_middle = std::remainder(angle - middle, 2.0 * std::numbers::pi);
  if (std::abs(from_middle) <= half) return angle;
  return robot::normalised(range[from_middle > 0 ? 1 : 0]);
}

Measure find_measure(const robot::Robot& robot, std::string_view name) {
  using Kind = Measure::Kind;
  if (name.empty()) return {};
  if (name == "foot.normal_force") return {Kind::normal_force, -1};
  if (name == "foot.friction_force") return {Kind::friction_force, -1};
  if (const auto joint = middle(name, "joint.", ".angle"); !joint.empty())
    return at(Kind::angle, find_joint(robot, joint));
  if (const auto joint = middle(name, "joint.", ".stiffness"); !joint.empty())
    return at(Kind::stiffness, find_joint(robot, joint));
  if (const auto muscle = middle(name, "muscle.", ".tension"); !muscle.empty())
    return at(Kind::tension, find_muscle(robot, muscle));
  return {Kind::unknown, -1};
}

std::string_view unit_of(std::string_view measure) {
  if (measure == "foot.normal_force" || measure == "foot.friction_force") return "N";
  if (!middle(measure, "muscle.", ".tension").empty()) return "N";
  if (!middle(measure, "joint.", ".angle").empty()) return "rad";
  if (!middle(measure, "joint.", ".stiffness").empty()) return "N m/rad";
  return "";
}

int steps_of_s(const Plan& plan, const Phase& phase) {
  const bool own = plan.thesis_timing && phase.thesis_duration > 0;
  return whole_periods(own ? phase.thesis_duration : phase.duration, plan.high_level_period);
}

int periods(const Plan& plan, const Phase& phase) {
  return steps_of_s(plan, phase) + (plan.thesis_timing ? 1 : 0);  // `timer <= N`
}

int periods_per_step(const Plan& plan) {
  int sum = 0;
  for (const std::string& name : plan.sequence)
    if (const int i = find_phase(plan, name); i >= 0)
      sum += periods(plan, plan.phases[static_cast<std::size_t>(i)]);
  return sum;
}

std::int64_t periods(const Plan& plan) {
  const auto settle = std::llround(plan.settle / plan.high_level_period);
  return settle + std::int64_t{plan.repeat} * periods_per_step(plan);
}

std::int64_t periods(const robot::Robot& robot, const Plan& plan) {
  std::int64_t longest = 0;
  for (const robot::LegParts& leg : robot::legs_of(robot))
    longest = std::max(longest, periods(plan_of_leg(plan, leg)));
  return longest;
}

Plan plan_of_leg(const Plan& plan, const robot::LegParts& leg) {
  Plan out = plan;
  for (const Sequence& other : plan.others)
    if (!leg.plan.empty() && other.name == leg.plan) out.sequence = other.phases;
  return out;
}

int find_phase(const Plan& plan, std::string_view name) {
  const auto found = std::find_if(plan.phases.begin(), plan.phases.end(),
                                  [&](const Phase& phase) { return phase.name == name; });
  return found == plan.phases.end() ? -1 : static_cast<int>(found - plan.phases.begin());
}

// Contradictions of a plan, found before a run.

namespace {

using List = std::vector<robot::Contradiction>;

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string joint_names(const Plan& plan) {
  std::string all;
  for (const JointPlan& joint : plan.joints) all += (all.empty() ? "" : ", ") + joint.name;
  return all;
}

void check_sequence(const Plan& plan, List& out) {
  if (plan.sequence.empty())
    out.push_back(
        {"sequence.phases", "an empty list", "the names of phases", "phases = [\"swing\"]"});
  for (const std::string& name : plan.sequence)
    if (find_phase(plan, name) < 0)
      out.push_back(
          {"sequence.phases", quoted(name), "the name of a phase", "a table [phase." + name + "]"});
}

void check_path(const robot::Robot& robot, const Phase& phase, List& out) {
  const std::string key = "phase." + phase.name;
  if (!phase.has_path()) return;

  if (!robot::is_leg(robot))
    out.push_back({key, "a foot path for " + std::to_string(robot.links.size()) + " links",
                   "a leg: two links at driven joints, beyond them passive ones", "joint_angles"});
  if (phase.points.x.size() != phase.points.y.size())
    out.push_back({key + ".points",
                   std::to_string(phase.points.x.size()) + " x and " +
                       std::to_string(phase.points.y.size()) + " y",
                   "as many of each", "one x and one y per corner"});
  if (phase.points.given() && (phase.x.given() || phase.y.given()))
    out.push_back({key, "points and x or y", "one of them", "leave out x and y"});
  if (!phase.points.given() && phase.x.given() != phase.y.given())
    out.push_back({key, phase.x.given() ? "x without y" : "y without x", "both coordinates",
                   "{ from = …, to = … } or { polynomial = […] }"});
  for (const auto& [name, c] : {std::pair{".x", &phase.x}, std::pair{".y", &phase.y}}) {
    if (std::isfinite(c->from) != std::isfinite(c->to))
      out.push_back({key + name, std::isfinite(c->from) ? "from without to" : "to without from",
                     "both", "{ from = …, to = … }"});
    if (!c->polynomial.empty() && c->straight())
      out.push_back({key + name, "a polynomial and from or to", "one of them", "leave one out"});
  }
}

// Refuses duties together with joint angles for a joint, and unknown disabled joints.
void check_joints(const Plan& plan, const Phase& phase, List& out) {
  for (std::size_t i = 0; i < phase.joints.size() && i < plan.joints.size(); ++i) {
    const JointPhase& joint = phase.joints[i];
    const std::string key = "phase." + phase.name + ".feedforward." + plan.joints[i].name;
    if (joint.feedforward.given() && !joint.angle.empty())
      out.push_back({key, "duties and joint_angles", "one of them", "leave one out"});
  }
  for (const std::string& name : phase.disabled) {
    bool known = false;
    for (const JointPlan& joint : plan.joints) known = known || joint.name == name;
    if (!known)
      out.push_back({"phase." + phase.name + ".disabled", quoted(name), "a joint",
                     "one of " + joint_names(plan)});
  }
}

void check_until(const robot::Robot& robot, const Phase& phase, List& out) {
  const Measure measure = find_measure(robot, phase.until.measure);
  const std::string key = "phase." + phase.name + ".until.measure";
  if (measure.kind == Measure::Kind::unknown)
    out.push_back({key, quoted(phase.until.measure), "a measured quantity",
                   "foot.normal_force, joint.<name>.angle or muscle.<name>.tension"});
  const bool foot =
      measure.kind == Measure::Kind::normal_force || measure.kind == Measure::Kind::friction_force;
  if (foot && !robot::is_leg(robot))
    out.push_back(
        {key, quoted(phase.until.measure), "a leg with two links [75]", "an angle or a tension"});
}

// Refuses a controlled force in a phase without a foot path, or without room to move.
void check_ground_force(const Phase& phase, List& out) {
  const GroundForce& g = phase.ground_force;
  const std::string key = "phase." + phase.name + ".ground_force";
  if (!g.given()) return;
  if (!phase.has_path())
    out.push_back({key, "no foot path", "a phase with x and y, or points", "leave it out"});
  if (!(g.limit > 0))
    out.push_back({key + ".limit", "0", "how far the path may move", "limit = \"0.5 in\""});
}

void check_cylinder(const robot::Robot& robot, const Phase& phase, List& out) {
  using Mode = robot::Cylinder::Mode;
  const CylinderPhase& c = phase.cylinder;
  const std::string key = "phase." + phase.name + ".cylinder";
  if (!c.given()) return;
  if (!robot.cylinder.present || robot.cylinder.mode != Mode::valves)
    out.push_back({key, "a robot whose cylinder does not move by valves",
                   "[cylinder] with mode = \"valves\"", "leave it out"});
  if (!c.position.empty() && !c.polynomial.empty())
    out.push_back({key, "position and polynomial", "one of them", "leave one out"});
  if (c.placed() && c.feedforward.given())
    out.push_back({key, "duties and a place", "one of them", "leave one out"});
  if (c.of == CylinderPhase::Of::foot_y && !phase.has_path())
    out.push_back({key + ".of", "\"foot_y\" in a phase without a foot path", "x and y, or points",
                   "position"});
}

// Checks ranges: their ends are counter-clockwise from the first to the second.
void check_ranges(const Plan& plan, List& out) {
  for (const JointPlan& joint : plan.joints) {
    const std::string key = "control.joint_range." + joint.name;
    if (joint.range.empty()) continue;
    if (joint.range.size() != 2)
      out.push_back({key, std::to_string(joint.range.size()) + " angles",
                     "two: the lowest and the highest", ""});
    else if (!(joint.range[0] < joint.range[1]))
      out.push_back({key, "angles that do not rise", "the lowest first",
                     "add 360 deg to the second where the range holds 0"});
  }
}

void check_times(const Plan& plan, List& out) {
  for (const Phase& phase : plan.phases)
    if (!(phase.duration > 0))
      out.push_back({"phase." + phase.name + ".duration", "no time", "more than 0 s",
                     "at least one high_level_period"});
  if (!(plan.high_level_period > 0))
    out.push_back({"control.high_level_period", "no time", "more than 0 s", "10 ms"});
}

// Checks changes: each must name a driven joint and, if it names a leg, an existing one; it has
// either a value or a release.
void check_changes(const robot::Robot& robot, const Plan& plan, List& out) {
  std::string legs;
  for (const robot::Leg& leg : robot.legs) legs += (legs.empty() ? "" : " or ") + leg.name;
  const std::vector<Setting> known = settings(plan);
  std::string joints;
  for (const JointPlan& joint : plan.joints)
    if (joint.driven) joints += (joints.empty() ? "" : ", ") + joint.name;
  for (std::size_t i = 0; i < plan.changes.size(); ++i) {
    const Change& change = plan.changes[i];
    const std::string key = "change[" + std::to_string(i) + "]";
    if (find_setting(known, change.key) < 0)
      out.push_back({key + ".key", quoted(change.key), "the key of a driven joint", joints});
    if (!change.leg.empty() && robot.legs.empty())
      out.push_back(
          {key + ".leg", quoted(change.leg), "no leg, as the robot has one alone", "leave it out"});
    else if (!change.leg.empty() &&
             std::ranges::count(robot.legs, change.leg, &robot::Leg::name) == 0)
      out.push_back({key + ".leg", quoted(change.leg), legs, "leave it out for every leg"});
    const bool valued = std::isfinite(change.value);
    if (valued && change.release)
      out.push_back({key, "a value and a release", "one of them", "leave one out"});
    if (!valued && !change.release)
      out.push_back({key, "no value", "value, or release = true", "value = \"…\""});
  }
}

std::string point(robot::Point p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.1f, %.1f) mm", 1e3 * p.x, 1e3 * p.y);
  return text;
}

// A stretch of s in which the foot path is out of reach, and its worst point.
struct UnreachableSection {
  double from = 0, to = 0;
  double worst_s = 0, worst = 0;  // [m] beyond the reach
  robot::Point target;
  robot::Inverse inverse;

  robot::Contradiction contradiction(const std::string& phase) const {
    char found[160], expected[80];
    std::snprintf(
        found, sizeof found,
        "a path out of reach for s = %.3f to %.3f; at s = %.3f %s is %.1f mm from the hip", from,
        to, worst_s, point(target).c_str(), 1e3 * inverse.distance);
    std::snprintf(expected, sizeof expected, "%.1f to %.1f mm", 1e3 * inverse.shortest,
                  1e3 * inverse.longest);
    return {"phase." + phase, found, expected, "the nearest point " + point(inverse.nearest)};
  }
};

void check_reach(const robot::TwoLinks& leg, const Plan& plan, const Phase& phase, List& out) {
  const int steps = steps_of_s(plan, phase);
  UnreachableSection section;
  bool inside = true;

  for (int k = 0; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    const robot::Point target = foot_at(phase, s);
    const robot::Inverse inverse = robot::inverse(leg, target);

    if (inverse.reached()) {
      if (!inside) out.push_back(section.contradiction(phase.name));
      inside = true;
      continue;
    }
    if (inside) section = UnreachableSection{s, s, s, -1, {}, {}};
    inside = false;
    section.to = s;
    const double beyond = std::hypot(target.x - inverse.nearest.x, target.y - inverse.nearest.y);
    if (!(beyond <= section.worst)) {
      section.worst_s = s;
      section.worst = beyond;
      section.target = target;
      section.inverse = inverse;
    }
  }
  if (!inside) out.push_back(section.contradiction(phase.name));
}

}  // namespace

namespace {

// Adds contradictions, each one once even if several legs have it.
void add_new(const List& more, List& out) {
  for (const robot::Contradiction& c : more)
    if (std::ranges::none_of(out,
                             [&](const auto& o) { return o.key == c.key && o.found == c.found; }))
      out.push_back(c);
}

List of_phases(const robot::Robot& leg, const Plan& plan) {
  List out;
  for (const Phase& phase : plan.phases) {
    check_path(leg, phase, out);
    check_joints(plan, phase, out);
    check_until(leg, phase, out);
    check_ground_force(phase, out);
    check_cylinder(leg, phase, out);
  }
  return out;
}

// Checks the orders of phases that legs name.
void check_others(const robot::Robot& robot, const Plan& plan, List& out) {
  for (const Sequence& other : plan.others) {
    const std::string key = "plan." + other.name + ".phases";
    if (other.phases.empty())
      out.push_back({key, "an empty list", "the names of phases", "phases = [\"swing\"]"});
    for (const std::string& name : other.phases)
      if (find_phase(plan, name) < 0)
        out.push_back({key, quoted(name), "the name of a phase", "a table [phase." + name + "]"});
  }
  for (const robot::Leg& leg : robot.legs)
    if (!leg.plan.empty() && std::ranges::none_of(plan.others, [&](const Sequence& other) {
          return other.name == leg.plan;
        }))
      out.push_back({"leg." + leg.name + ".plan", quoted(leg.plan), "the name of a plan",
                     "a table [plan." + leg.plan + "] with phases"});
}

}  // namespace

List contradictions(const robot::Robot& robot, const Plan& plan) {
  List out;
  check_times(plan, out);
  check_sequence(plan, out);
  check_others(robot, plan, out);
  for (std::size_t l = 0; l < robot::legs_of(robot).size(); ++l)
    add_new(of_phases(robot::only_leg(robot, l), plan), out);
  check_ranges(plan, out);
  check_changes(robot, plan, out);
  return out;
}

List unreachable(const robot::Robot& robot, const Plan& plan) {
  List out;
  if (!(plan.high_level_period > 0)) return out;
  for (std::size_t l = 0; l < robot::legs_of(robot).size(); ++l) {
    const robot::Robot leg = robot::only_leg(robot, l);
    if (!robot::is_leg(leg)) continue;
    List of_leg;
    for (const Phase& phase : plan.phases)
      if (phase.has_path()) check_reach(robot::two_links(leg), plan, phase, of_leg);
    add_new(of_leg, out);
  }
  return out;
}

}  // namespace sinew::gait
