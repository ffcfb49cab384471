// cli/identify_pair.cpp - `sinew identify pair`: stiffness, friction, losses and trapped air of a
// sealed pair that is moved.
#include <fmt/format.h>

#include <cmath>

#include "cli/identify.h"
#include "cli/identify_page.h"
#include "cli/units.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/pair_task.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using Align = report::TextTable::Align;

struct IdentifyPairOptions {
  DataOptions data;
  ResultOptions result;
  identify::PairSettings settings;
  std::vector<std::string> held_out;
};

// How much of the variance each law explains.
void print_explained(const identify::Report& report) {
  report::TextTable table({"model", "R2", "held out"}, {Align::left, Align::right, Align::right});
  for (const identify::Fit& f : report.fits) {
    if (!f.refused.empty()) continue;
    table.add({f.model, fmt::format("{:.4f}", f.fit.explained),
               f.held_out ? fmt::format("{:.4f}", f.held_out->explained) : "-"});
  }
  fmt::print("\n{}", table.text());
}

void print_stiffness(const identify::PairResult& found, const config::UnitsToShow& asked) {
  const char* unit = found.rotary ? "N m/rad" : "N/m";
  const units::ShownUnit shown = asked.units.of(unit);
  const identify::PairStiffness& s = found.stiffness;
  fmt::print("\nstiffness, springs and trapped air together: {:.5g} +- {:.2g} {}",
             shown.of(s.value), shown.of(s.uncertainty), shown.name);
  if (std::isfinite(s.air)) fmt::print(", of it {:.4g} {} the air's", shown.of(s.air), shown.name);
  fmt::print("\n");
}

// Change with the position, pressure and law of the air.
void print_air(const identify::PairResult& found) {
  if (!found.air) return;
  const identify::PairAir& air = *found.air;
  const identify::Fit& best = air.report.best();
  fmt::print("\ntrapped air, {}: {}; {:.2f} % of {}\n", best.model, best.law, best.fit.rmse_percent,
             air.report.full_scale_is);
  report::TextTable table({"parameter", "value", "unit", "95 %"},
                          {Align::left, Align::right, Align::left, Align::left});
  for (const identify::Estimate& e : best.parameters)
    table.add({e.name, fmt::format("{:.6g}", e.value), e.unit,
               !e.free                  ? e.known
               : e.at_bound             ? "at the bound of its range"
               : !std::isfinite(e.high) ? "not identifiable"
                                        : fmt::format("+- {:.2g}", 0.5 * (e.high - e.low))});
  fmt::print("{}", table.text());
}

ExitCode run_pair(const IdentifyPairOptions& options) {
  check_result_options(options.result);
  const std::vector<identify::Source> sources = sources_of(options.data, options.held_out);
  identify::PairSettings settings = options.settings;
  for (const std::string& text : options.held_out) {
    if (identify::is_time_range(text)) {
      if (!settings.hold_out.empty())
        config::fail({"hold_out", 0, 0}, "", "two ranges of time", "one");
      settings.hold_out = text;
      continue;
    }
    settings.held_out.push_back(sources[0]);
    settings.held_out.back().path = text;
  }
  const identify::PairFound found = identify::find_pair(sources, settings);
  const identify::PairResult& pair = found.result;
  const std::string& out = options.result.out;
  ResultOptions result = options.result;
  result.no_report = true;  // the page has the air as well
  const std::string file = out.empty() ? "" : found.file(out);
  std::vector<const identify::Report*> reports{&pair.report};
  if (pair.air) reports.push_back(&pair.air->report);
  leave_page(pair.report.subject, reports, file, options.data, options.result);
  tell(pair.report, file, options.data, result, to_json(found));
  if (!options.result.json) {
    const config::UnitsToShow asked = units_asked(options.result.units, units::UnitSet::si);
    print_explained(pair.report);
    print_stiffness(pair, asked);
    print_air(pair);
  }
  return ok;
}

}  // namespace

void add_identify_pair(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyPairOptions>();
  Command sub = identify.subcommand(
      "pair",
      "stiffness, dry friction, losses and trapped air of an antagonistic pair that is sealed and "
      "moved by hand or motor",
      "sinew identify pair moved.csv --hold-out \"7 s..\" --freeze \"delay=0 s\"");
  add_data_options(sub, options->data);
  sub.add_option("--rigs", options->settings.rigs,
                 "A,A,B: the rig of each file; recordings of one have its sensors in common");
  sub.add_option(
         "--hold-out", options->held_out,
         "\"7 s..14 s\" or \"7 s..\": times of each file, or a FILE, that score the laws and "
         "are not fitted; may be repeated")
      .takes_one();
  sub.add_option("--window", options->settings.window,
                 "of the parabolas that give velocity and acceleration")
      .show_default();
  sub.add_option("--model", options->settings.model, "only this law")
      .is_one_of(identify::pair_models());
  add_wish_options(sub, options->settings.wishes);
  sub.add_option("--joint", options->settings.joint, "its name in the robot's file of --out")
      .show_default();
  sub.add_option("--base", options->settings.base,
                 "robot whose joint it is, named in the file of --out");
  add_result_options(sub, options->result);
  sub.callback([options, &action] { action = [options] { return run_pair(*options); }; });
}

}  // namespace sinew::cli
