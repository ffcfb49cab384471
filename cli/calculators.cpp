// cli/calculators.cpp - the calculators: actuator, valve and kinematics.
#include <fmt/format.h>

#include <algorithm>
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
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/air.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/pulse.h"
#include "sinew/gas/valve.h"
#include "sinew/gas/valve_flow.h"
#include "sinew/json/json.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"
#include "sinew/run/setup/actuator_text.h"
#include "sinew/run/setup/stance.h"
#include "sinew/run/setup/valve_text.h"

namespace sinew::cli {

namespace {

using config::air_pressure;
using config::air_volume;
using config::quantity_setting;
using config::QuantityRange;

// --- actuator ---

struct ActuatorOptions : Flags {
  std::string file, name, length, pressure, velocity, external_volume = "0 m3", units;
};

using Point = actuator::OperatingPoint;

// Beyond one and a half threads the stiffness of the long end has no meaning.
config::Range possible_lengths(const actuator::Actuator& a) {
  return {a.caps.length, a.caps.length + 1.5 * a.braid.thread_length,
          "from the caps alone to one and a half threads", true};
}

// Prints each doubt once.
void warn(const std::vector<Point>& points, const Messages& messages) {
  std::vector<std::string> printed;
  for (const Point& p : points)
    for (const std::string& text : p.beyond)
      if (std::ranges::find(printed, text) == printed.end()) printed.push_back(text);
  for (const std::string& text : printed)
    messages.warning(text + (points.size() > 1 ? " (rows with *)" : ""));
}

ExitCode run_actuator(const ActuatorOptions& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const actuator::Actuator& a =
      config::named(file.experiment.actuators, options.name, "--name", "actuator", options.file);
  const QuantityRange lengths =
      config::range_setting("--length", options.length, "m", air.atmosphere, possible_lengths(a));
  const QuantityRange pressures =
      config::range_setting("--pressure", options.pressure, "Pa gauge", air.atmosphere,
                            config::gauge_air_pressure(air.atmosphere));
  const double external = quantity_setting("--external-volume", options.external_volume, "m3",
                                           air.atmosphere, air_volume);
  double velocity = Point::not_given;
  if (!options.velocity.empty())
    velocity = quantity_setting("--velocity", options.velocity, "m/s", air.atmosphere,
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
  const config::UnitsToShow units = chosen_units(options.units, units::UnitSet::si);
  fmt::print("{}", points.size() == 1
                       ? run::text_of(points[0], units.requested())
                       : run::table_of(points, lengths.unit, pressures.unit, units.requested()));
  warn(points, Messages(options.quiet));
  return ok;
}

// --- valve ---

struct ValveOptions : Flags {
  std::string file, name, upstream, downstream, volume, wall_time, exponent, duty,
      frequency = "100 Hz", units;
};

std::vector<run::Delivered> deliveries(const gas::Valve& valve, const ValveOptions& options) {
  std::vector<run::Delivered> out;
  if (options.duty.empty()) return out;
  const gas::Delays delays = gas::delays(valve);
  const double period = 1.0 / quantity_setting("--frequency", options.frequency, "1/s",
                                               units::atmosphere, config::pulses);
  constexpr config::Range share = config::from_zero(1, "a share of the period");
  for (const double duty :
       config::range_setting("--duty", options.duty, "1", units::atmosphere, share).si)
    out.push_back({duty, gas::delivered_duty(duty, period, delays.opening, delays.closing)});
  return out;
}

// Returns the times by an energy balance: its two limits, and the times with a wall time that is
// given; or those by an exponent.
std::vector<run::Transfers> transfers(const gas::Valve& valve, gas::Air air, double volume,
                                      const gas::ValveFlow& f, const ValveOptions& options) {
  std::vector<run::Transfers> out;
  const auto add = [&](std::string words, gas::Exchange exchange) {
    out.push_back({std::move(words), gas::transfers(valve.flow, air, volume, f, exchange)});
  };
  if (!options.exponent.empty()) {
    const config::Range exponents{1, gas::heat_capacity_ratio, "isothermal to adiabatic"};
    air.polytropic_exponent =
        quantity_setting("--exponent", options.exponent, "1", air.atmosphere, exponents);
    add(fmt::format("exponent {:.4g}", air.polytropic_exponent), gas::Exchange::polytrope);
    return out;
  }
  if (!options.wall_time.empty())
    air.wall_time = quantity_setting("--wall-time", options.wall_time, "s", air.atmosphere,
                                     config::above_zero(3600, "longer walls are adiabatic"));
  add("adiabatic walls", gas::Exchange::adiabatic);
  if (air.wall_time > 0)
    add(fmt::format("walls of {:.4g} ms", 1e3 * air.wall_time), gas::Exchange::walls);
  add("isothermal walls", gas::Exchange::isothermal);
  return out;
}

ExitCode run_valve(const ValveOptions& options) {
  const auto file = experiment::load_machine_file(options.file);
  const gas::Air& air = file.experiment.air;
  const gas::Valve& valve =
      config::named(file.experiment.valves, options.name, "NAME", "valve", options.file);
  const double up =
      quantity_setting("--upstream", options.upstream, "Pa abs", air.atmosphere, air_pressure);
  const double down =
      quantity_setting("--downstream", options.downstream, "Pa abs", air.atmosphere, air_pressure);

  const gas::ValveFlow f = gas::flow_through(valve.flow, air, up, down);
  std::vector<run::Transfers> times;
  double volume = 0;
  if (!options.volume.empty()) {
    volume = quantity_setting("--volume", options.volume, "m3", air.atmosphere,
                              config::above_zero(air_volume.high, air_volume.why));
    times = transfers(valve, air, volume, f, options);
  }
  const std::vector<run::Delivered> duties = deliveries(valve, options);

  if (const std::string warning = run::flow_warning(valve, f); !warning.empty())
    Messages(options.quiet).warning(warning);
  if (options.json) {
    fmt::print("{}\n", (Json::parse(run::json_of(valve, f, times, duties))).text(2));
    return ok;
  }
  const config::UnitsToShow units = chosen_units(options.units, units::UnitSet::si);
  fmt::print("{}{}{}", run::text_of(valve, f, units.requested()),
             run::text_of(times, volume, f, units.requested(), air.atmosphere),
             run::text_of(duties, options.frequency));
  return ok;
}

// --- kinematics ---

struct KinematicsOptions {
  std::string file, leg, units;
  run::StanceRequest request;
  bool json = false;
};

// Returns the chosen units, else those of the robot's file.
run::StanceUnits stance_units(const experiment::Experiment& e, const KinematicsOptions& options) {
  const config::UnitsToShow chosen = chosen_units(options.units, units::UnitSet::si);
  if (!chosen.is_requested) return run::units_of_file(e, options.request.force);
  const std::string length = chosen.units.of("m").name;
  return {length, chosen.units.of("rad").name, chosen.units.of("N m").name, length + "/rad"};
}

// Leaves the one leg that is requested, its parts named as within it; its first joint is the
// origin.
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
  const run::StanceUnits units = stance_units(file.experiment, options);
  const std::vector<run::Stance> branches = run::stances(file.experiment, options.request, units);
  const robot::Robot& robot = file.experiment.robot;
  if (options.json) {
    Json out{{"robot", robot.name}};
    if (!options.leg.empty()) out["leg"] = options.leg;
    for (const run::Stance& b : branches) out["branches"].push_back(Json::parse(json_of(robot, b)));
    fmt::print("{}\n", out.text(2));
    return ok;
  }
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (i > 0) fmt::print("\n");
    fmt::print("{}", text_of(robot, branches[i], units));
  }
  return ok;
}

}  // namespace

void add_actuator(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "actuator", "Compute tension, stiffness and geometry of one braided actuator",
                 "sinew actuator robots/leg/actuator.toml --length 2.5in:3.9in:0.2in --pressure "
                 "\"60 psi gauge\" --velocity \"-2 in/s\"");
  ActuatorOptions& options = runs(sub, action, run_actuator);
  sub.add_option("FILE", options.file, "actuator, robot or experiment file")->required();
  sub.add_option("--length", options.length, "QUANTITY: length, or from:to:step")->required();
  sub.add_option("--pressure", options.pressure, "QUANTITY: pressure, or from:to:step")->required();
  sub.add_option("--velocity", options.velocity,
                 "QUANTITY: velocity, below 0 while contracting; adds the losses of equation 33");
  sub.add_option("--name", options.name, "NAME: actuator, where the file has several");
  sub.add_option("--external-volume", options.external_volume,
                 "QUANTITY: volume of hose and fittings, for stiffness at shut valves; default: 0");
  add_units(sub, options.units, "printed numbers (default: SI and inches); --json is in SI");
  add_flags(sub, options, "", "print the result as JSON, in SI");
}

void add_valve(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "valve", "Compute flow, filling times and delays of a valve",
                 "sinew valve robots/leg/valves.toml inlet --upstream \"100 psi gauge\" "
                 "--downstream \"0 psi gauge\" --volume \"1 in3\"");
  ValveOptions& options = runs(sub, action, run_valve);
  sub.add_option("FILE", options.file, "valves, robot or experiment file")->required();
  sub.add_option("NAME", options.name, "name of the valve")->required();
  sub.add_option("--upstream", options.upstream, "QUANTITY: pressure before the valve")->required();
  sub.add_option("--downstream", options.downstream, "QUANTITY: pressure behind it")->required();
  CLI::Option* volume =
      sub.add_option("--volume", options.volume, "QUANTITY: rigid volume to fill and to vent");
  CLI::Option* walls =
      sub.add_option("--wall-time", options.wall_time,
                     "QUANTITY: time constant of the heat exchange with the walls; "
                     "default: the file's, else results without and with full "
                     "exchange");
  walls->needs(volume);
  sub.add_option("--exponent", options.exponent, "polytropic exponent, as in a muscle's file")
      ->needs(volume)
      ->excludes(walls);
  CLI::Option* duty =
      sub.add_option("--duty", options.duty, "DUTY: share of the period, or from:to:step");
  sub.add_option("--frequency", options.frequency, "pulse frequency; default: 100 Hz")->needs(duty);
  add_units(sub, options.units, "printed numbers; --json is in SI");
  add_flags(sub, options, "", "print the result as JSON, in SI");
}

void add_kinematics(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "kinematics",
                             "Convert foot positions to joint angles, lengths and torques, or back",
                             "sinew kinematics robots/leg/robot.toml --foot \"-2 in, -13 in\" "
                             "--force \"0 lbf, -20 lbf\"");
  KinematicsOptions& options = runs(sub, action, run_kinematics);
  sub.add_option("ROBOT", options.file, "robot or experiment file")->required();
  sub.add_option("--leg", options.leg, "NAME: leg of a robot that has several");
  CLI::App& target = alternatives(sub, "target");
  target.add_option("--foot", options.request.foot,
                    "X,Y: position of the foot relative to the first joint; gives all joint angles "
                    "that reach it");
  target.add_option("--angles", options.request.angles, "ANGLES: one per joint, in robot order");
  sub.add_option("--force", options.request.force,
                 "X,Y: force with which the foot pushes; gives the joints' torques");
  add_units(sub, options.units, "printed numbers (default: those of the robot's file)");
  sub.add_flag("--json", options.json, "print the result as JSON, in SI");
}

}  // namespace sinew::cli
