// cli/actuator.cpp - `sinew actuator`: what one braided actuator does at a length and a pressure.
#include "sinew/actuator/actuator.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/run/setup/actuator_text.h"

namespace sinew::cli {

namespace {

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

}  // namespace sinew::cli
