// cli/calculators.cpp - the calculators: actuator, valve and kinematics.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/actuator/actuator.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/air.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/valve.h"
#include "sinew/gas/valve_flow.h"
#include "sinew/json/json.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"
#include "sinew/run/setup/actuator_text.h"
#include "sinew/run/setup/stance.h"
#include "sinew/run/setup/valve_text.h"
#include "sinew/signals/pulse.h"

namespace sinew::cli {

namespace {

// --- quantities and ranges of them ---

using config::above_zero;
using config::air_pressure;
using config::air_volume;
using config::from_zero;
using config::greatest_pressure;
using config::polytropic;
using config::pulses;
using config::Range;

Range gauge_air_pressure(double atmosphere);

// One quantity in SI; throws config::Error that begins with the option's name.
inline double argument(std::string_view option, std::string_view text, std::string_view unit,
                       double atmosphere, const Range& range = {}) {
  return config::quantity_setting(option, text, unit, atmosphere, range);
}

// "2.5in:3.9in:0.1in", first and last included; or one quantity. A pressure's step is a difference:
// "20 psi gauge:110 psi gauge:10 psi".
struct Values {
  std::vector<double> si;
  std::string display;  // the unit that was written, for columns of a table
};
Values arguments(std::string_view option, std::string_view text, std::string_view unit,
                 double atmosphere, const Range& range = {});

// Returns the unit behind the number of a quantity that was understood: "in" of "3.4 in"; "1" for
// none.
std::string unit_text(std::string_view text);

// "-2 in, -13 in": as many quantities as there are commas and one.
std::vector<double> argument_list(std::string_view option, std::string_view text,
                                  std::string_view unit, const Range& range = {});

constexpr double most_values = 10000;

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(at, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

[[noreturn]] void refuse_value(std::string_view option, std::string_view text, std::string expected,
                         std::string try_this) {
  config::fail({std::string(option), 0, 0}, "", config::in_quotes(text), std::move(expected),
               std::move(try_this));
}

// "1 in:2 in:0.1 in" in the unit that was written, or else in a usual one; a step of pressures is
// neither gauge nor absolute.
std::string example_of(std::string_view unit, std::string_view written) {
  if (unit == "1") return "\"0:1:0.1\"";
  std::string usual = unit_text(written);
  if (config::parse_quantity("1 " + usual, unit).mistake) usual = config::usual_units(unit).front();
  std::string step = usual;
  for (const std::string_view point : {" gauge", " abs"})
    if (step.ends_with(point)) step.resize(step.size() - point.size());
  return fmt::format("\"1 {0}:2 {0}:0.1 {1}\"", usual, step);
}

std::string unit_text(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" +"), text.size()));
  double number = 0;
  const char* last = text.data() + text.size();
  std::string unit(std::from_chars(text.data(), last, number).ptr, last);
  unit.erase(unit.find_last_not_of(' ') + 1);
  unit.erase(0, std::min(unit.find_first_not_of(' '), unit.size()));
  return unit.empty() ? "1" : unit;
}

Range gauge_air_pressure(double atmosphere) {
  Range out = air_pressure;
  out.low -= atmosphere;
  out.high -= atmosphere;
  return out;
}

Values arguments(std::string_view option, std::string_view text, std::string_view unit,
                 double atmosphere, const Range& range) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 1 && parts.size() != 3)
    refuse_value(option, text, "a quantity, or from:to:step", example_of(unit, parts[0]));
  Values out{{argument(option, parts[0], unit, atmosphere, range)}, unit_text(parts[0])};
  if (parts.size() == 1) return out;

  const std::string_view step_unit = config::difference_unit(unit);
  std::string step_text(parts[2]);
  for (const std::string_view point : {" gauge", " abs"})
    if (step_unit == "Pa diff" && step_text.ends_with(point))
      refuse_value(option, parts[2], "a step, which is a difference of two pressures",
             config::in_quotes(step_text.substr(0, step_text.size() - point.size())));
  if (step_unit == "Pa diff" && !step_text.ends_with("diff")) step_text += " diff";
  const double first = out.si[0];
  const double last = argument(option, parts[1], unit, atmosphere, range);
  const double step = argument(option, step_text, step_unit, atmosphere);

  // The last value belongs to it although steps round.
  const double steps = step != 0 ? std::floor((last - first) / step + 1e-9) : -1;
  if (!(steps >= 0))
    refuse_value(option, text, "a step that leads from the first to the last",
           example_of(unit, parts[0]));
  if (steps >= most_values) refuse_value(option, text, "at most 10000 values", "a larger step");
  for (int i = 1; i <= static_cast<int>(steps); ++i) out.si.push_back(first + i * step);
  return out;
}

std::vector<double> argument_list(std::string_view option, std::string_view text,
                                  std::string_view unit, const Range& range) {
  std::vector<double> out;
  for (const std::string_view part : split(text, ','))
    out.push_back(argument(option, part, unit, units::atmosphere, range));
  return out;
}

// --- actuator ---

struct ActuatorOptions {
  std::string file, name, length, pressure, velocity, external_volume = "0 m3", units;
  bool json = false, quiet = false;
};

using Point = actuator::OperatingPoint;

// A braid has a length; a half more than its threads is as far as the stiffness of its long end
// says anything.
Range possible_lengths(const actuator::Actuator& a) {
  return {a.caps.length, a.caps.length + 1.5 * a.braid.thread_length,
          "from the caps alone to one and a half threads", true};
}

// Each word of doubt once.
void warn(const std::vector<Point>& points, const Messages& messages) {
  std::vector<std::string> said;
  for (const Point& p : points)
    for (const std::string& text : p.beyond)
      if (std::ranges::find(said, text) == said.end()) said.push_back(text);
  for (const std::string& text : said)
    messages.warning(text + (points.size() > 1 ? " (rows with *)" : ""));
}

ExitCode run_actuator(const ActuatorOptions& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const actuator::Actuator& a =
      config::named(file.experiment.actuators, options.name, "--name", "actuator");
  const Values lengths =
      arguments("--length", options.length, "m", air.atmosphere, possible_lengths(a));
  const Values pressures = arguments("--pressure", options.pressure, "Pa gauge", air.atmosphere,
                                     gauge_air_pressure(air.atmosphere));
  const double external =
      argument("--external-volume", options.external_volume, "m3", air.atmosphere, air_volume);

  const double velocity = options.velocity.empty()
                              ? Point::not_asked
                              : argument("--velocity", options.velocity, "m/s", air.atmosphere,
                                         {-100, 100, "a muscle's end is slower than 100 m/s"});

  const actuator::Surroundings around{air.atmosphere, air.polytropic_exponent, external};
  std::vector<Point> points;
  for (const double pressure : pressures.si)
    for (const double length : lengths.si)
      points.push_back(actuator::operating_point(a, length, pressure, around, velocity));

  if (options.json) {
    Json out{{"actuator", a.name},
             {"atmosphere_Pa", air.atmosphere},
             {"polytropic_exponent", air.polytropic_exponent},
             {"external_volume_m3", external},
             {"shortest_length_m", actuator::shortest_length(a)},
             {"greatest_length_m", a.long_end.length}};
    for (const Point& p : points) out["points"].push_back(Json::parse(run::json_of(p)));
    fmt::print("{}\n", out.text(2));
    return ok;
  }
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si);
  const units::ShownUnits* shown = asked.asked ? &asked.units : nullptr;
  fmt::print("{}", points.size() == 1
                       ? run::text_of(points[0], shown)
                       : run::table_of(points, lengths.display, pressures.display, shown));
  warn(points, Messages(options.quiet));
  return ok;
}

// --- valve ---

struct ValveOptions {
  std::string file, name, upstream, downstream, volume, wall_time, exponent, duty,
      frequency = "100 Hz", units;
  bool json = false, quiet = false;
};

std::vector<run::Delivered> deliveries(const gas::Valve& valve, const ValveOptions& options) {
  std::vector<run::Delivered> out;
  if (options.duty.empty()) return out;
  const gas::Delays delays = gas::delays(valve);
  const double period =
      1.0 / argument("--frequency", options.frequency, "1/s", units::atmosphere, pulses);
  constexpr Range share = from_zero(1, "a share of the period");
  for (const double duty : arguments("--duty", options.duty, "1", units::atmosphere, share).si)
    out.push_back({duty, signals::delivered_duty(duty, period, delays.opening, delays.closing)});
  return out;
}

// Returns the times by an energy balance: its two limits and, where a wall time is given, what lies
// between them; or those by an exponent.
std::vector<run::Transfers> transfers(const gas::Valve& valve, gas::Air air, double volume,
                                      const gas::ValveFlow& f, const ValveOptions& options) {
  std::vector<run::Transfers> out;
  const auto add = [&](std::string words, gas::Exchange exchange) {
    out.push_back({std::move(words), gas::transfers(valve.flow, air, volume, f, exchange)});
  };
  if (!options.exponent.empty()) {
    const Range exponents{1, gas::heat_capacity_ratio, "isothermal to adiabatic"};
    air.polytropic_exponent =
        argument("--exponent", options.exponent, "1", air.atmosphere, exponents);
    add(fmt::format("exponent {:.4g}", air.polytropic_exponent), gas::Exchange::polytrope);
    return out;
  }
  if (!options.wall_time.empty())
    air.wall_time = argument("--wall-time", options.wall_time, "s", air.atmosphere,
                             above_zero(3600, "longer walls are adiabatic"));
  add("adiabatic walls", gas::Exchange::adiabatic);
  if (air.wall_time > 0)
    add(fmt::format("walls of {:.4g} ms", 1e3 * air.wall_time), gas::Exchange::walls);
  add("isothermal walls", gas::Exchange::isothermal);
  return out;
}

ExitCode run_valve(const ValveOptions& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const gas::Valve& valve = config::named(file.experiment.valves, options.name, "NAME", "valve");
  const double up =
      argument("--upstream", options.upstream, "Pa abs", air.atmosphere, air_pressure);
  const double down =
      argument("--downstream", options.downstream, "Pa abs", air.atmosphere, air_pressure);

  const gas::ValveFlow f = gas::flow_through(valve.flow, air, up, down);
  std::vector<run::Transfers> times;
  double volume = 0;
  if (!options.volume.empty()) {
    volume = argument("--volume", options.volume, "m3", air.atmosphere,
                      above_zero(air_volume.high, air_volume.why));
    times = transfers(valve, air, volume, f, options);
  }
  const std::vector<run::Delivered> duties = deliveries(valve, options);

  if (const std::string doubt = run::doubt_of(valve, f); !doubt.empty())
    Messages(options.quiet).warning(doubt);
  if (options.json) {
    fmt::print("{}\n", (Json::parse(run::json_of(valve, f, times, duties))).text(2));
    return ok;
  }
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si);
  const units::ShownUnits* shown = asked.asked ? &asked.units : nullptr;
  fmt::print("{}{}{}", run::text_of(valve, f, shown),
             run::text_of(times, volume, f, shown, air.atmosphere),
             run::text_of(duties, options.frequency));
  return ok;
}

// --- kinematics ---

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

void add_actuator(CLI::App& app, Action& action) {
  auto options = std::make_shared<ActuatorOptions>();
  CLI::App& sub =
      subcommand(app, "actuator", "tension, stiffness and geometry of one braided actuator",
                 "sinew actuator robots/leg/actuator.toml --length 2.5in:3.9in:0.2in --pressure "
                 "\"60 psi gauge\" --velocity \"-2 in/s\"");
  sub.add_option("FILE", options->file, "actuator, robot or experiment file")->required();
  sub.add_option("--length", options->length, "a length, or from:to:step")->required();
  sub.add_option("--pressure", options->pressure, "gauge or abs, or from:to:step")->required();
  sub.add_option("--velocity", options->velocity,
                 "of the length, below 0 while it contracts: the tension with its losses, [33]");
  sub.add_option("--name", options->name, "which actuator, where the file has several");
  sub.add_option("--external-volume", options->external_volume,
                 "of hose and fittings, for the stiffness with valves shut; 0");
  add_units(sub, options->units, "of what is printed, else SI and inches; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_actuator(*options); }; });
}

void add_valve(CLI::App& app, Action& action) {
  auto options = std::make_shared<ValveOptions>();
  CLI::App& sub =
      subcommand(app, "valve", "flow, filling times and delays of a valve",
                 "sinew valve robots/leg/valves.toml inlet --upstream \"100 psi gauge\" "
                 "--downstream \"0 psi gauge\" --volume \"1 in3\"");
  sub.add_option("FILE", options->file, "valves, robot or experiment file")->required();
  sub.add_option("NAME", options->name, "of the valve")->required();
  sub.add_option("--upstream", options->upstream, "pressure, gauge or abs")->required();
  sub.add_option("--downstream", options->downstream, "pressure, gauge or abs")->required();
  CLI::Option* volume =
      sub.add_option("--volume", options->volume, "rigid, to be filled and vented");
  CLI::Option* walls =
      sub.add_option("--wall-time", options->wall_time,
                     "of the heat between its air and walls; else both limits, or the file's");
  walls->needs(volume);
  sub.add_option("--exponent", options->exponent, "by a polytrope, as the air of a muscle's file")
      ->needs(volume)
      ->excludes(walls);
  CLI::Option* duty =
      sub.add_option("--duty", options->duty, "share of the period, or from:to:step");
  sub.add_option("--frequency", options->frequency, "of the pulses; 100 Hz")->needs(duty);
  add_units(sub, options->units, "of what is printed; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_valve(*options); }; });
}

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
