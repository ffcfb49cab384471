// cli/kinematics.cpp - `sinew kinematics`: foot to joint angles and back, and the torques behind a
// force. Lengths and angles are printed in the units of the robot's file where nobody
// asks for others.
#include "sinew/robot/kinematics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/option_groups.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/robot/legs.h"
#include "sinew/run/setup/stance.h"

namespace sinew::cli {

namespace {

struct KinematicsOptions {
  std::string file, leg, foot, angles, force, units;
  bool json = false;
};

std::string unit_in(const config::Origins& origins, std::string_view table, std::string_view key,
                    std::string otherwise) {
  for (const config::Origin& o : origins)
    if (o.path.starts_with(table) && o.path.ends_with(key) && !o.is_default && !o.unit.empty())
      return unit_text(o.text);
  return otherwise;
}

// Those that somebody asked for; else the units in which the robot's file speaks, by its first link
// and its first joint, and of the torques by the force that is given.
run::StanceUnits stance_units(const experiment::Experiment& e, const KinematicsOptions& options) {
  const std::string& force = options.force;
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si);
  if (asked.asked) {
    const std::string length = asked.units.of("m").name;
    return {length, asked.units.of("rad").name, asked.units.of("N m").name, length + "/rad"};
  }
  run::StanceUnits out;
  out.length = unit_in(e.origins, "link.", ".length", out.length);
  out.angle = unit_in(e.origins, "joint.", ".rest_angle", out.angle);
  if (unit_text(force.substr(0, force.find(','))) == "lbf") out.torque = "lbf in";
  return out;
}

robot::TwoLinks need_two_links(const robot::Robot& robot) {
  if (!robot::is_leg(robot))
    throw std::invalid_argument(
        fmt::format("{}: has {} link{}; --foot needs two, at driven joints; try --angles",
                    robot.name, robot.links.size(), robot.links.size() == 1 ? "" : "s"));
  return robot::two_links(robot);
}

[[noreturn]] void out_of_reach(const std::string& text, const robot::Inverse& inverse,
                               const run::StanceUnits& units) {
  const auto length = [&](double m) { return config::format_quantity(m, "m", units.length, 5); };
  config::fail({"--foot", 0, 0}, "",
               fmt::format("\"{}\", {} from the first joint", text, length(inverse.distance)),
               fmt::format("{} to {}", length(inverse.shortest), length(inverse.longest)),
               fmt::format("\"{}, {}\", the nearest point that can be reached",
                           length(inverse.nearest.x), length(inverse.nearest.y)));
}

// Two quantities with a comma between them.
robot::Point x_and_y(std::string_view option, const std::string& text, std::string_view unit,
                     const Range& range, std::string_view example) {
  const std::vector<double> values = argument_list(option, text, unit, range);
  if (values.size() != 2)
    config::fail({std::string(option), 0, 0}, "", config::in_quotes(text), "x and y",
                 std::string(example));
  return {values[0], values[1]};
}

std::vector<run::Stance> branches_to(const experiment::Experiment& e, const std::string& text,
                                     const run::StanceUnits& units) {
  const robot::Point target =
      x_and_y("--foot", text, "m", {-1000, 1000, "a foot is on a leg"}, "\"-2 in, -13 in\"");
  std::vector<run::Stance> out;
  for (const robot::Knee knee : {robot::Knee::above_pi, robot::Knee::below_pi}) {
    const robot::Inverse inverse = robot::inverse(need_two_links(e.robot), target, knee);
    if (!inverse.reached()) out_of_reach(text, inverse, units);
    out.push_back(run::stance(e, {inverse.angle[0], inverse.angle[1]}));
  }
  return out;
}

run::Stance branch_at(const experiment::Experiment& e, const std::string& text) {
  const std::vector<double> angles = argument_list(
      "--angles", text, "rad",
      {-4 * std::numbers::pi, 4 * std::numbers::pi, "two turns; a joint makes less than one"});
  if (angles.size() != e.robot.joints.size())
    config::fail({"--angles", 0, 0}, "", config::in_quotes(text),
                 fmt::format("{} angles, as there are joints", e.robot.joints.size()));
  return run::stance(e, angles);
}

// [71] in each way to stand.
void add_torques(const experiment::Experiment& e, const std::string& text,
                 std::vector<run::Stance>& branches) {
  const robot::Point force = x_and_y("--force", text, "N", {-1e6, 1e6, "a foot pushes with it"},
                                     "\"0 lbf, -20 lbf\", which presses down");
  for (run::Stance& b : branches) {
    const auto torques = robot::torques_for(robot::forward(e.robot, b.angles), force);
    b.torques.assign(torques.begin(), torques.begin() + std::ssize(b.angles));
  }
}

// Leaves the one leg that is asked for, its parts named as within it; where it hangs is the origin.
void choose_leg(experiment::Experiment& e, const std::string& leg) {
  const std::vector<std::string_view> names = config::names_of(e.robot.legs);
  if (names.empty() && leg.empty()) return;
  const auto found = std::ranges::find(names, leg);
  if (found == names.end())
    config::fail(
        {"--leg", 0, 0}, "", leg.empty() ? "none" : config::in_quotes(leg),
        names.empty() ? "nothing: " + e.robot.name + " has one leg" : config::either(names),
        names.empty() ? "" : "--leg " + std::string(names.front()));
  e.robot = robot::only_leg(e.robot, static_cast<std::size_t>(found - names.begin()));
}

ExitCode run_kinematics(const KinematicsOptions& options) {
  auto file = experiment::load_machine_file(options.file);
  choose_leg(file.experiment, options.leg);
  const experiment::Experiment& e = file.experiment;
  if (e.robot.joints.empty())
    throw std::invalid_argument(options.file + ": has no joints; try a robot's file");
  const run::StanceUnits units = stance_units(e, options);
  std::vector<run::Stance> branches = options.foot.empty()
                                          ? std::vector{branch_at(e, options.angles)}
                                          : branches_to(e, options.foot, units);
  if (!options.force.empty()) add_torques(e, options.force, branches);
  if (options.json) {
    Json out{{"robot", e.robot.name}};
    if (!options.leg.empty()) out["leg"] = options.leg;
    for (const run::Stance& b : branches)
      out["branches"].push_back(Json::parse(json_of(e.robot, b)));
    fmt::print("{}\n", out.text(2));
    return ok;
  }
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (i > 0) fmt::print("\n");
    fmt::print("{}", text_of(e.robot, branches[i], units));
  }
  return ok;
}

}  // namespace

void add_kinematics(CLI::App& app, Action& action) {
  auto options = std::make_shared<KinematicsOptions>();
  CLI::App& sub =
      subcommand(app, "kinematics", "foot to joint angles, muscle lengths and torques, and back",
                 "sinew kinematics robots/leg/robot.toml --foot \"-2 in, -13 in\" "
                 "--force \"0 lbf, -20 lbf\"");
  sub.add_option("ROBOT", options->file, "robot or experiment file")->required();
  sub.add_option("--leg", options->leg, "of a robot with several: its name");
  CLI::App& target = alternatives(sub, "target");
  target.add_option("--foot", options->foot, "x, y about the first joint: all ways to stand there");
  target.add_option("--angles", options->angles, "one per joint, in the robot's order");
  sub.add_option("--force", options->force,
                 "x, y of what the foot pushes with: the joints' torques for it, [71]");
  add_units(sub, options->units, "of what is printed, else those of the robot's file");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.callback([=, &action] { action = [=] { return run_kinematics(*options); }; });
}

}  // namespace sinew::cli
