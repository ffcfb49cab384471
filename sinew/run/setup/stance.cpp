#include "sinew/run/setup/stance.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "sinew/actuator/body.h"
#include "sinew/air/lanes.h"
#include "sinew/config/quantity.h"
#include "sinew/json/json.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::run {

namespace {

// Returns a length or a torque as text; the 1e-9 that rounding leaves is shown as 0.
std::string shown(double si, std::string_view unit, std::string_view display) {
  return config::format_quantity(std::abs(si) < 1e-9 ? 0 : si, unit, display, 5);
}

}  // namespace

std::string text_of(const robot::Robot& robot, const Stance& s, const StanceUnits& units) {
  const auto length = [&](double m) { return shown(m, "m", units.length); };
  std::string out = fmt::format("foot at {}, {}{}\n", length(s.foot.x), length(s.foot.y),
                                s.within() ? "" : ": beyond a muscle's lengths");
  for (std::size_t j = 0; j < s.angles.size(); ++j)
    out += fmt::format("  {:<14} {}\n", robot.joints[j].name,
                       config::format_quantity(s.angles[j], "rad", units.angle, 5));
  report::TextTable table({"muscle", "length", "from", "to", ""});
  for (const MuscleAt& m : s.muscles)
    table.add({m.name, length(m.length), length(m.shortest), length(m.longest),
               m.within() ? "" : "beyond"});
  out += table.text("  ");
  if (s.jacobian) {
    const auto per = [&](double si) { return config::convert(si, "m/rad", units.jacobian); };
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

}  // namespace sinew::run
