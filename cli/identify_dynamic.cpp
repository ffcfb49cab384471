// cli/identify_dynamic.cpp - `sinew identify dynamic`: damping and dry friction from free decays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/arguments.h"
#include "cli/identify.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/motion/dynamic_file.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using Align = report::TextTable::Align;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Options {
  DataOptions data;
  ResultOptions result;
  std::string actuator, name, mass, pressure, external = "0 m3", exponent, model;
  std::vector<std::string> held_out;
  int count = 1;
};

// One value for all files, or one for each.
std::vector<double> per_file(std::string_view option, const std::string& text,
                             std::string_view unit, double atmosphere, std::size_t files,
                             const Range& range) {
  std::vector<double> out;
  for (const std::string& piece : at_commas(text))
    out.push_back(argument(option, piece, unit, atmosphere, range));
  if (out.size() == 1) out.resize(files, out[0]);
  if (out.size() != files)
    config::fail({std::string(option), 0, 0}, "", fmt::format("{} values", out.size()),
                 fmt::format("one, or {}: one for each file", files));
  return out;
}

std::vector<identify::DecayRecord> records_of(Options options, const actuator::Actuator& a,
                                              double gravity) {
  std::vector<std::string>& files = options.data.files;
  for (const std::string& file : options.held_out)
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);

  const std::vector<identify::Source> sources = sources_of(options.data);
  const double atmosphere = sources[0].atmosphere;
  const std::size_t n = sources.size();
  const auto values = [&](std::string_view option, const std::string& text, std::string_view unit,
                          const Range& range) {
    return per_file(option, text, unit, atmosphere, n, range);
  };
  const std::vector<double> mass =
      values("--mass", options.mass, "kg", above_zero(1e6, "hangs on the muscle"));
  const std::vector<double> external =
      values("--external-volume", options.external, "m3", air_volume);
  std::vector<double> pressure(n, unknown);
  if (!options.pressure.empty())
    pressure = values("--pressure", options.pressure, "Pa abs", air_pressure);
  const bool given = !options.exponent.empty();
  const double exponent =
      given ? argument("--exponent", options.exponent, "1", atmosphere, polytropic) : 1.4;

  std::vector<identify::DecayRecord> out;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(mass[i] > 0))
      config::fail({"--mass", 0, 0}, "", config::in_quotes(options.mass), "masses above zero");
    if (!(external[i] >= 0))
      config::fail({"--external-volume", 0, 0}, "", config::in_quotes(options.external),
                   "volumes of at least zero");
    identify::DecayRecord r{.data = identify::read_measured(sources[i], identify::decay_columns())};
    r.stand = {.actuator = a,
               .mass = mass[i] / options.count,
               .pressure = pressure[i],
               .external_volume = external[i] / options.count,
               .polytropic_exponent = !given && r.data.has("pressure") ? unknown : exponent,
               .atmosphere = atmosphere,
               .gravity = gravity};
    r.held_out = std::ranges::find(options.held_out, sources[i].path) != options.held_out.end();
    out.push_back(std::move(r));
  }
  return out;
}

// Methods that know no muscle beside the trajectories.
void print_methods(const identify::DynamicResult& found) {
  report::TextTable table(
      {"file", "method", "Q [mm]", "friction at rest [N]", "c [N s/m]", "zeta [53]"},
      {Align::left, Align::left, Align::right, Align::right, Align::right, Align::right});
  const auto row = [&](const identify::DecaySummary& s, const char* method,
                       const identify::Damping& d) {
    table.add({s.file, method, fmt::format("{:.5f}", 1e3 * d.coulomb_length),
               fmt::format("{:.4f}", d.coulomb_length * s.stiffness),
               fmt::format("{:.4f}", d.viscous), fmt::format("{:.4f}", d.ratio)});
  };
  for (const identify::DecaySummary& s : found.records) {
    if (s.printed) row(s, "two points, [45] as printed", *s.printed);
    if (s.exact) row(s, "two points, exact", *s.exact);
    row(s, "all turns", s.all.damping);
    table.add({s.file, "trajectory, " + found.report.best().model,
               fmt::format("{:.5f}", 1e3 * found.loss.coulomb_length),
               fmt::format("{:.4f}", s.friction), fmt::format("{:.4f}", found.loss.viscous), ""});
  }
  fmt::print("\n{}", table.text());
  for (const identify::DecaySummary& s : found.records)
    if (!s.exact) fmt::print("no two points: {}\n", s.why_not);
}

ExitCode run_dynamic(const Options& options) {
  check_result_options(options.result);
  const experiment::MachineFile start = experiment::load_machine_file(options.actuator);
  const actuator::Actuator& a =
      config::named(start.experiment.actuators, options.name, "--name", "actuator");
  const identify::DynamicResult found =
      identify::identify_dynamic(records_of(options, a, units::standard_gravity), options.model);
  tell(
      found.report,
      identify::loss_file(start.experiment.origins, options.actuator, a, found, options.data.files),
      options.data, options.result, identify::describe(found));
  if (!options.result.json) print_methods(found);
  return ok;
}

}  // namespace

void add_identify_dynamic(Command identify, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = identify.subcommand(
      "dynamic", "viscous loss and dry friction from a mass that swings on trapped air",
      "sinew identify dynamic a.csv b.csv --actuator robots/leg/actuator.toml --mass \"6 lb,11 "
      "lb\" --pressure \"60 psi gauge,80 psi gauge\" --external-volume \"0.114 in3\" -o bpa.toml");
  add_data_options(sub, options->data);
  sub.add_option("--actuator", options->actuator, "file with braid, tension and ends; a start")
      .required();
  sub.add_option("--name", options->name, "which actuator, where the file has several");
  sub.add_option("--mass", options->mass, "that moves; one, or one per file with commas")
      .required();
  sub.add_option("--pressure", options->pressure,
                 "of the air as the mass hangs; one, or one per file; absent: the measured one");
  sub.add_option("--external-volume", options->external,
                 "of hose and fittings up to the shut valve; one, or one per file")
      .show_default();
  sub.add_option("--exponent", options->exponent,
                 "of the trapped air; absent: from the measured pressure, else 1.4 [39]");
  sub.add_option("--count", options->count, "actuators in parallel")
      .is_between(1, 100)
      .show_default();
  sub.add_option("--hold-out", options->held_out,
                 "a file that scores the laws and is not fitted; may be repeated; absent: each "
                 "file in turn, or the last third of the only one")
      .takes_one();
  sub.add_option("--model", options->model, "only this law").is_one_of(identify::dynamic_models());
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run_dynamic(*options); }; });
}

}  // namespace sinew::cli
