#include "sinew/run/setup/stance.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "sinew/actuator/body.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/json/json.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/units/quantity.h"

namespace sinew::run {

namespace {

// Returns a length or a torque as text; the 1e-9 that rounding leaves is shown as 0.
std::string shown(double si, std::string_view unit, std::string_view display) {
  return units::format_quantity(std::abs(si) < 1e-9 ? 0 : si, unit, display, 5);
}

}  // namespace

std::string text_of(const robot::Robot& robot, const Stance& s, const StanceUnits& units) {
  const auto length = [&](double m) { return shown(m, "m", units.length); };
  std::string out = fmt::format("foot at {}, {}{}\n", length(s.foot.x), length(s.foot.y),
                                s.within() ? "" : ": beyond a muscle's lengths");
  for (std::size_t j = 0; j < s.angles.size(); ++j)
    out += fmt::format("  {:<14} {}\n", robot.joints[j].name,
                       units::format_quantity(s.angles[j], "rad", units.angle, 5));
  report::TextTable table({"muscle", "length", "from", "to", ""});
  for (const MuscleAt& m : s.muscles)
    table.add({m.name, length(m.length), length(m.shortest), length(m.longest),
               m.within() ? "" : "beyond"});
  out += table.text("  ");
  if (s.jacobian) {
    const auto per = [&](double si) { return units::convert(si, "m/rad", units.jacobian); };
    const std::string head = fmt::format("  Jacobian [{}]  ", units.jacobian);
    out +=
        fmt::format("{}x: {:9.5f} {:9.5f}\n{:{}}y: {:9.5f} {:9.5f}\n", head, per(s.jacobian->x1),
                    per(s.jacobian->x2), "", head.size(), per(s.jacobian->y1), per(s.jacobian->y2));
  }
  for (std::size_t j = 0; j < s.torques.size(); ++j)
    out += fmt::format("  torque {:<7} {}\n", robot.joints[j].name,
                       shown(s.torques[j], "N m", units.torque));
  return out;
}

std::string json_of(const robot::Robot& robot, const Stance& s) {
  Json out{{"foot_m", {s.foot.x, s.foot.y}}};
  for (std::size_t j = 0; j < s.angles.size(); ++j)
    out["angles_rad"][robot.joints[j].name] = s.angles[j];
  for (const MuscleAt& m : s.muscles)
    out["muscles"][m.name] = {{"length_m", m.length},
                              {"shortest_m", m.shortest},
                              {"longest_m", m.longest},
                              {"within", m.within()}};
  if (s.jacobian)
    out["jacobian_m_per_rad"] = {{s.jacobian->x1, s.jacobian->x2},
                                 {s.jacobian->y1, s.jacobian->y2}};
  for (std::size_t j = 0; j < s.torques.size(); ++j)
    out["torques_Nm"][robot.joints[j].name] = s.torques[j];
  out["within"] = s.within();
  return out.text();
}

namespace {

// Returns the equivalent angle, less whole turns, nearest to the joint's rest angle [rad].
double next_to_rest(const robot::Joint& joint, double angle) {
  return joint.rest_angle + std::remainder(angle - joint.rest_angle, 2 * std::numbers::pi);
}

}  // namespace

Stance stance(const experiment::Experiment& e, const std::vector<double>& angles) {
  Stance out{.angles = angles, .foot = robot::forward(e.robot, angles).foot()};
  std::array<double, robot::max_joints> turned{}, still{};
  for (std::size_t j = 0; j < angles.size(); ++j)
    turned[j] = next_to_rest(e.robot.joints[j], angles[j]);
  air::Lanes<plant::most_muscles> length, rate;
  plant::MuscleRouting::MomentArms<plant::most_muscles> arms;
  plant::MuscleRouting(e.robot).at(turned.data(), still.data(), length, rate, arms);
  for (std::size_t i = 0; i < e.robot.muscles.size(); ++i) {
    const actuator::Actuator a = robot::actuator_of(e.robot.muscles[i], e.actuators);
    out.muscles.push_back({.name = e.robot.muscles[i].name,
                           .length = length[static_cast<int>(i)],
                           .shortest = actuator::shortest_length(a),
                           .longest = a.long_end.length});
  }
  if (robot::is_leg(e.robot))
    out.jacobian = robot::jacobian(robot::two_links(e.robot), angles[0], angles[1]);
  return out;
}

namespace {

std::string unit_in(const config::Origins& origins, std::string_view table, std::string_view key,
                    std::string otherwise) {
  for (const config::Origin& o : origins)
    if (o.path.starts_with(table) && o.path.ends_with(key) && !o.is_default && !o.unit.empty())
      return units::written_unit(o.text);
  return otherwise;
}

robot::TwoLinks need_two_links(const robot::Robot& robot) {
  if (!robot::is_leg(robot))
    config::fail({"foot", 0, 0}, "",
                 fmt::format("{}, which has {} link{}", robot.name, robot.links.size(),
                             robot.links.size() == 1 ? "" : "s"),
                 "a robot of two links, at driven joints", "the angles of its joints");
  return robot::two_links(robot);
}

[[noreturn]] void out_of_reach(const std::string& text, const robot::Inverse& inverse,
                               const StanceUnits& units) {
  const auto length = [&](double m) { return units::format_quantity(m, "m", units.length, 5); };
  config::fail({"foot", 0, 0}, "",
               fmt::format("\"{}\", {} from the first joint", text, length(inverse.distance)),
               fmt::format("{} to {}", length(inverse.shortest), length(inverse.longest)),
               fmt::format("\"{}, {}\", the nearest point that can be reached",
                           length(inverse.nearest.x), length(inverse.nearest.y)));
}

// Returns two quantities with a comma between them.
robot::Point x_and_y(std::string_view option, const std::string& text, std::string_view unit,
                     const config::Range& range, std::string_view example) {
  const std::vector<double> values = config::list_setting(option, text, unit, range);
  if (values.size() != 2)
    config::fail({std::string(option), 0, 0}, "", config::in_quotes(text), "x and y",
                 std::string(example));
  return {values[0], values[1]};
}

std::vector<Stance> branches_to(const experiment::Experiment& e, const std::string& text,
                                const StanceUnits& units) {
  const robot::Point target =
      x_and_y("foot", text, "m", {-1000, 1000, "a foot is on a leg"}, "\"-2 in, -13 in\"");
  std::vector<Stance> out;
  for (const robot::Knee knee : {robot::Knee::above_pi, robot::Knee::below_pi}) {
    const robot::Inverse inverse = robot::inverse(need_two_links(e.robot), target, knee);
    if (!inverse.reached()) out_of_reach(text, inverse, units);
    out.push_back(stance(e, {inverse.angle[0], inverse.angle[1]}));
  }
  return out;
}

Stance branch_at(const experiment::Experiment& e, const std::string& text) {
  const std::vector<double> angles = config::list_setting(
      "angles", text, "rad",
      {-4 * std::numbers::pi, 4 * std::numbers::pi, "two turns; a joint makes less than one"});
  if (angles.size() != e.robot.joints.size())
    config::fail({"angles", 0, 0}, "", config::in_quotes(text),
                 fmt::format("{} angles, as there are joints", e.robot.joints.size()));
  return stance(e, angles);
}

// Adds the torques of [71] to each way to stand.
void add_torques(const experiment::Experiment& e, const std::string& text,
                 std::vector<Stance>& branches) {
  const robot::Point force = x_and_y("force", text, "N", {-1e6, 1e6, "a foot pushes with it"},
                                     "\"0 lbf, -20 lbf\", which presses down");
  for (Stance& b : branches) {
    const auto torques = robot::torques_for(robot::forward(e.robot, b.angles), force);
    b.torques.assign(torques.begin(), torques.begin() + std::ssize(b.angles));
  }
}

}  // namespace

StanceUnits units_of_file(const experiment::Experiment& e, const std::string& force) {
  StanceUnits out;
  out.length = unit_in(e.origins, "link.", ".length", out.length);
  out.angle = unit_in(e.origins, "joint.", ".rest_angle", out.angle);
  if (units::written_unit(force.substr(0, force.find(','))) == "lbf") out.torque = "lbf in";
  return out;
}

std::vector<Stance> stances(const experiment::Experiment& e, const StanceRequest& request,
                            const StanceUnits& units) {
  if (e.robot.joints.empty())
    throw std::invalid_argument(e.robot.name + ": has no joints; try a robot's file");
  std::vector<Stance> out = request.foot.empty() ? std::vector{branch_at(e, request.angles)}
                                                 : branches_to(e, request.foot, units);
  if (!request.force.empty()) add_torques(e, request.force, out);
  return out;
}

}  // namespace sinew::run
