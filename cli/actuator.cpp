// cli/actuator.cpp - `sinew actuator`: what one braided actuator does at a length and a pressure.
#include "sinew/actuator/actuator.h"
#include "sinew/report/text/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, name, length, pressure, velocity, external_volume = "0 m3";
  bool json = false, quiet = false;
};

using Point = actuator::OperatingPoint;

// A braid has a length; a half more than its threads is as far as the stiffness of its long end
// says anything.
Range possible_lengths(const actuator::Actuator& a) {
  return {a.caps.length, a.caps.length + 1.5 * a.braid.thread_length,
          "from the caps alone to one and a half threads", true};
}

// A quantity that is reported of a point: key of the JSON, words, SI unit and that of inches and
// pounds.
struct Row {
  const char* key;
  const char* words;
  double Point::*value;
  const char* unit;
  const char* display;
};
constexpr Row rows[] = {
    {"length_m", "length", &Point::length, "m", "in"},
    {"gauge_pressure_Pa", "pressure", &Point::gauge_pressure, "Pa gauge", "psi gauge"},
    {"tension_N", "tension, at rest", &Point::tension, "N", "lbf"},
    {"effectiveness", "effectiveness", &Point::effectiveness, "1", "1"},
    {"coulomb_bound_N", "dry friction, at most", &Point::coulomb_bound, "N", "lbf"},
    {"velocity_m_per_s", "velocity", &Point::velocity, "m/s", "in/s"},
    {"sliding_tension_N", "tension, sliding", &Point::sliding_tension, "N", "lbf"},
    {"viscous_loss_N", "of it viscous", &Point::viscous_loss, "N", "lbf"},
    {"stiffness_at_constant_pressure_N_per_m", "stiffness, constant pressure",
     &Point::stiffness_at_constant_pressure, "N/m", "lbf/in"},
    {"stiffness_sealed_N_per_m", "stiffness, valves shut", &Point::stiffness_sealed, "N/m",
     "lbf/in"},
    {"passive_stiffness_N_per_m", "stiffness without air", &Point::passive_stiffness, "N/m",
     "lbf/in"},
    {"volume_m3", "volume", &Point::volume, "m3", "in3"},
    {"diameter_m", "diameter", &Point::diameter, "m", "in"},
    {"braid_angle_rad", "braid angle", &Point::braid_angle, "rad", "deg"},
};

Json to_json(const Point& p) {
  Json out;
  for (const Row& row : rows)
    if (std::isfinite(p.*row.value)) out[row.key] = p.*row.value;
  out["beyond"] = p.beyond;
  return out;
}

// A dash where the law gives no number.
std::string shown(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

void print_point(const Point& p) {
  report::TextTable table({"", "SI", "in, lbf, psi"},
                          {report::TextTable::Align::left, report::TextTable::Align::right,
                           report::TextTable::Align::right});
  for (const Row& row : rows) {
    const double value = p.*row.value;
    const bool plain = std::string_view(row.unit) == "1";
    if (!std::isfinite(value)) {
      if (row.value != &Point::velocity && row.value != &Point::sliding_tension &&
          row.value != &Point::viscous_loss)
        table.add({row.words, "-"});
      continue;
    }
    table.add({row.words, config::format_quantity(value, row.unit, row.unit),
               plain ? "" : config::format_quantity(value, row.unit, row.display)});
  }
  fmt::print("{}", table.text());
}

// The columns of a table of points: title, and what stands under it.
struct Cell {
  std::string title;
  std::function<std::string(const Point&)> text;
};

std::vector<Cell> cells_for(bool moves, const Values& lengths, const Values& pressures) {
  const auto in = [](double Point::*value, const char* unit, std::string display,
                     const char* format) {
    return [=](const Point& p) { return shown(config::convert(p.*value, unit, display), format); };
  };
  const auto plain = [](double Point::*value, const char* format) {
    return [=](const Point& p) { return shown(p.*value, format); };
  };
  std::vector<Cell> out = {
      {"length [" + lengths.display + "]", in(&Point::length, "m", lengths.display, "{:.5g}")},
      {"pressure [" + pressures.display + "]",
       in(&Point::gauge_pressure, "Pa gauge", pressures.display, "{:.5g}")},
      {"tension [N]", plain(&Point::tension, "{:.3f}")},
      {"Eff", plain(&Point::effectiveness, "{:.4f}")},
      {"k at p [N/m]", plain(&Point::stiffness_at_constant_pressure, "{:.1f}")},
      {"k sealed [N/m]", plain(&Point::stiffness_sealed, "{:.1f}")},
      {"friction [N]", plain(&Point::coulomb_bound, "{:.3f}")}};
  if (moves) out.push_back({"sliding [N]", plain(&Point::sliding_tension, "{:.3f}")});
  out.push_back({"volume [mL]", in(&Point::volume, "m3", "mL", "{:.3f}")});
  out.push_back({"diameter [mm]", in(&Point::diameter, "m", "mm", "{:.3f}")});
  out.push_back({"angle [deg]", in(&Point::braid_angle, "rad", "deg", "{:.3f}")});
  return out;
}

void print_table(const std::vector<Point>& points, const Values& lengths, const Values& pressures) {
  const std::vector<Cell> cells = cells_for(std::isfinite(points[0].velocity), lengths, pressures);
  std::vector<std::string> titles;
  for (const Cell& cell : cells) titles.push_back(cell.title);
  titles.emplace_back("");
  std::vector<report::TextTable::Align> align(cells.size(), report::TextTable::Align::right);
  report::TextTable table(titles, align);
  for (const Point& p : points) {
    std::vector<std::string> row;
    for (const Cell& cell : cells) row.push_back(cell.text(p));
    row.emplace_back(p.beyond.empty() ? "" : "*");
    table.add(std::move(row));
  }
  fmt::print("{}", table.text());
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

ExitCode run_actuator(const Options& options) {
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
    for (const Point& p : points) out["points"].push_back(to_json(p));
    fmt::print("{}\n", json_text(out, 2));
    return ok;
  }
  points.size() == 1 ? print_point(points[0]) : print_table(points, lengths, pressures);
  warn(points, Messages(options.quiet));
  return ok;
}

}  // namespace

void add_actuator(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand(
      "actuator", "tension, stiffness and geometry of one braided actuator",
      "sinew actuator robots/leg/actuator.toml --length 2.5in:3.9in:0.2in --pressure "
      "\"60 psi gauge\" --velocity \"-2 in/s\"");
  sub.add_option("FILE", options->file, "actuator, robot or experiment file").required();
  sub.add_option("--length", options->length, "a length, or from:to:step").required();
  sub.add_option("--pressure", options->pressure, "gauge or abs, or from:to:step").required();
  sub.add_option("--velocity", options->velocity,
                 "of the length, below 0 while it contracts: the tension with its losses, [33]");
  sub.add_option("--name", options->name, "which actuator, where the file has several");
  sub.add_option("--external-volume", options->external_volume,
                 "of hose and fittings, for the stiffness with valves shut; 0");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_actuator(*options); }; });
}

}  // namespace sinew::cli
