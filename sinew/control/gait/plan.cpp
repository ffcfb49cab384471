#include "sinew/control/gait/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"

namespace sinew::gait {
namespace {

// "joint.hip.angle" -> "hip", where the name has that head and tail.
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
  return whole_periods(own ? phase.thesis_duration : phase.duration, plan.brain_period);
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
  const auto settle = std::llround(plan.settle / plan.brain_period);
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

}  // namespace sinew::gait
