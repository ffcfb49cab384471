// cli/identify_dynamic.cpp - `sinew identify dynamic`: damping and dry friction from free decays.
#include <fmt/format.h>

#include "cli/identify.h"
#include "cli/units.h"
#include "sinew/identify/task/dynamic_task.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using Align = report::TextTable::Align;
struct IdentifyDynamicOptions {
  DataOptions data;
  ResultOptions result;
  identify::DynamicSettings settings;
  std::vector<std::string> held_out;
};

// Methods that know no muscle beside the trajectories.
void print_methods(const identify::DynamicResult& found, const config::UnitsToShow& asked) {
  const units::ShownUnit length = asked.asked ? asked.units.of("m") : units::ShownUnit{"mm", 1e3};
  const units::ShownUnit force = asked.units.of("N"), damping = asked.units.of("N s/m");
  // The columns keep decimals of their own in units that nobody chose.
  const auto in = [&](const units::ShownUnit& unit, double si, int decimals = 4) {
    return asked.asked ? fmt::format("{:.4g}", unit.of(si))
                       : fmt::format("{:.{}f}", unit.of(si), decimals);
  };
  report::TextTable table(
      {"file", "method", "Q [" + length.name + "]", "friction at rest [" + force.name + "]",
       "c [" + damping.name + "]", "zeta [53]"},
      {Align::left, Align::left, Align::right, Align::right, Align::right, Align::right});
  const auto row = [&](const identify::DecaySummary& s, const char* method,
                       const identify::Damping& d) {
    table.add({s.file, method, in(length, d.coulomb_length, 5),
               in(force, d.coulomb_length * s.stiffness), in(damping, d.viscous),
               fmt::format("{:.4f}", d.ratio)});
  };
  for (const identify::DecaySummary& s : found.records) {
    if (s.printed) row(s, "two points, [45] as printed", *s.printed);
    if (s.exact) row(s, "two points, exact", *s.exact);
    row(s, "all turns", s.all.damping);
    table.add({s.file, "trajectory, " + found.report.best().model,
               in(length, found.loss.coulomb_length, 5), in(force, s.friction),
               in(damping, found.loss.viscous), ""});
  }
  fmt::print("\n{}", table.text());
  for (const identify::DecaySummary& s : found.records)
    if (!s.exact) fmt::print("no two points: {}\n", s.why_not);
}

ExitCode run_dynamic(const IdentifyDynamicOptions& options) {
  check_result_options(options.result);
  const std::vector<identify::Source> sources = sources_of(options.data, options.held_out);
  identify::DynamicSettings settings = options.settings;
  for (const std::string& file : options.held_out) {
    settings.held_out.push_back(sources[0]);
    settings.held_out.back().path = file;
  }
  const identify::DynamicFound found = identify::find_dynamic(sources, settings);
  tell(found.result.report, found.file, options.data, options.result, to_json(found));
  if (!options.result.json)
    print_methods(found.result, units_asked(options.result.units, units::UnitSet::si));
  return ok;
}

}  // namespace

void add_identify_dynamic(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyDynamicOptions>();
  Command sub = identify.subcommand(
      "dynamic", "viscous loss and dry friction from a mass that swings on trapped air",
      "sinew identify dynamic a.csv b.csv --actuator robots/leg/actuator.toml --mass \"6 lb,11 "
      "lb\" --pressure \"60 psi gauge,80 psi gauge\" --external-volume \"0.114 in3\" -o bpa.toml");
  add_data_options(sub, options->data);
  sub.add_option("--actuator", options->settings.actuator,
                 "file with braid, tension and ends; a start")
      .required();
  sub.add_option("--name", options->settings.name, "which actuator, where the file has several");
  sub.add_option("--mass", options->settings.mass, "that moves; one, or one per file with commas")
      .required();
  sub.add_option("--pressure", options->settings.pressure,
                 "of the air as the mass hangs; one, or one per file; absent: the measured one");
  sub.add_option("--external-volume", options->settings.external_volume,
                 "of hose and fittings up to the shut valve; one, or one per file")
      .show_default();
  sub.add_option("--exponent", options->settings.exponent,
                 "of the trapped air; absent: from the measured pressure, else 1.4 [39]");
  sub.add_option("--count", options->settings.count, "actuators in parallel")
      .is_between(1, 100)
      .show_default();
  sub.add_option("--hold-out", options->held_out,
                 "a file that scores the laws and is not fitted; may be repeated; absent: each "
                 "file in turn, or the last third of the only one")
      .takes_one();
  sub.add_option("--model", options->settings.model, "only this law")
      .is_one_of(identify::dynamic_models());
  add_wish_options(sub, options->settings.wishes);
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run_dynamic(*options); }; });
}

}  // namespace sinew::cli
