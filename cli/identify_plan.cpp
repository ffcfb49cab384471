// cli/identify_plan.cpp - `sinew identify plan`: what to measure, before a static law is fitted.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>

#include "cli/identify.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/task/plan_task.h"
#include "sinew/identify/task/tables.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct IdentifyPlanOptions {
  DataOptions data;
  identify::StaticSettings how;
  identify::PlanSettings settings;
  std::string out, units;
  bool json = false, force = false, quiet = false;
};

// Before anything is measured nothing is known, and how little does not matter.
std::string percent(double share) {
  return share > 1 ? "> 100 %" : fmt::format("{:.2g} %", 100 * share);
}

// Numbers in the units that somebody asked for; else in those of a ruler and a regulator.
struct PlanUnits {
  config::UnitsToShow asked;
  double room = 0;  // that gauges read against [Pa]

  Retold of(double si, const std::string& unit, const Retold& otherwise) const {
    return asked.asked ? retold(si, unit, asked, room) : otherwise;
  }
  Retold length(double x) const { return of(x, "m", {1e3 * x, "mm", 1e3}); }
  Retold pressure(double x) const { return of(x, "Pa gauge", {1e-3 * x, "kPa gauge", 1e-3}); }
  Retold force(double x) const { return of(x, "N", {x, "N", 1}); }
};

std::string text_of(const Retold& r) { return fmt::format("{:.4g} {}", r.number, r.unit); }

std::string numbers_of(const std::vector<double>& pressures, const PlanUnits& units) {
  std::vector<double> out;
  for (const double p : pressures) out.push_back(units.pressure(p).number);
  return fmt::format("{:.4g}", fmt::join(out, " "));
}

void print_mounts(const identify::PlanFound& found, const PlanUnits& units) {
  using enum report::TextTable::Align;
  const std::string over = fmt::format("up and down over [{}]", units.pressure(0).unit);
  report::TextTable table(
      {"mount", "length", over, "readings", "minutes", "error rms", "95 % at worst"},
      {right, right, left, right, right, right, right});
  const identify::MeasurementPlan& plan = found.plan;
  table.add({found.measured > 0 ? "before" : "none", "", "", std::to_string(found.measured), "0",
             percent(plan.before.rms), percent(plan.before.half_width)});
  double time = 0;
  for (std::size_t i = 0; i < plan.mounts.size(); ++i) {
    const identify::PlannedMount& m = plan.mounts[i];
    time += m.time;
    table.add({std::to_string(i + 1), text_of(units.length(m.length)),
               numbers_of(m.pressures, units), std::to_string(m.readings()),
               fmt::format("{:.0f}", time / 60), percent(m.after.rms),
               percent(m.after.half_width)});
  }
  fmt::print("{}", table.text());
}

void print(const identify::PlanFound& found, const PlanUnits& units) {
  const identify::MeasurementPlan& plan = found.plan;
  const identify::PlanRegion& r = plan.region;
  const bool worst = found.options.criterion == identify::PlanCriterion::worst;
  fmt::print("plan for {}\n", found.subject);
  fmt::print("errors of the force in % of the largest, {}, over {:.4g} to {} and {:.4g} to {}\n\n",
             text_of(units.force(found.muscle.scales.full_scale)), units.length(r.shortest).number,
             text_of(units.length(r.longest)), units.pressure(r.lowest).number,
             text_of(units.pressure(r.highest)));
  print_mounts(found, units);
  if (plan.mounts.empty()) {
    fmt::print("\nnothing more to measure: {} was wanted\n", percent(found.options.error));
    return;
  }
  const double after = plan.after().of(found.options.criterion);
  const double before = plan.before.of(found.options.criterion);
  fmt::print("\n{} {} and {} readings in {:.0f} minutes: {}{} ({} wanted{}{})\n",
             plan.mounts.size(), plan.mounts.size() == 1 ? "mount" : "mounts", plan.readings(),
             plan.time() / 60, found.measured > 0 ? fmt::format("{} -> ", percent(before)) : "",
             percent(after), percent(found.options.error),
             worst ? ", 95 % at the worst place" : ", rms", plan.reached ? "" : "; not reached");
}

// What --force may replace: never measurements of another origin.
bool is_plan(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::getline(in, line);
  return line.starts_with("# Plan of `sinew identify plan`");
}

void check_out(const IdentifyPlanOptions& options) {
  if (options.out.empty()) return;
  run::refuse_to_overwrite(options.out, options.force,
                           {options.data.files.begin(), options.data.files.end()}, ".csv");
  if (std::filesystem::exists(options.out) && !log::is_written_directly(options.out) &&
      !is_plan(options.out))
    config::fail({options.out, 0, 0}, "", "something that is no plan",
                 "a name that is free, or that of a plan", "another one");
}

ExitCode run_plan(const IdentifyPlanOptions& options) {
  check_out(options);
  identify::PlanSettings settings = options.settings;
  identify::StaticSettings how = options.how;
  const double atmosphere = identify::atmosphere_setting(options.data.atmosphere);
  how.rest_length = settings.rest_length;
  how.actuator = settings.actuator;
  const identify::PlanFound found =
      options.data.files.empty() ? identify::find_plan(settings, atmosphere)
                                 : identify::find_next(sources_of(options.data), how, settings);
  const Messages messages(options.quiet);
  for (const std::string& note : found.notes) messages.note(as_options(note));
  if (!options.out.empty()) {
    run::write_file(options.out, plan_table(found));
    messages.note(fmt::format("{}: written", options.out));
  }
  if (options.json)
    fmt::print("{}\n", to_json(found).text(2));
  else
    print(found, {units_asked(options.units, units::UnitSet::metric), atmosphere});
  return ok;
}

void add_plan_options(Command sub, identify::PlanSettings& s) {
  sub.add_option("--diameter", s.diameter, "of the mesh without pressure and load");
  sub.add_option("--actuator", s.actuator,
                 "a file with a muscle like it, in place of --diameter; with DATA: whose braid is "
                 "known");
  sub.add_option("--pressure", s.pressure, "the highest that will be measured");
  sub.add_option(
      "--noise", s.noise,
      "of one reading of force, a standard deviation; absent: 2 N, or what DATA scatter");
  sub.add_option("--length-error", s.length_error, "of a mount's length").show_default();
  sub.add_option("--law-error", s.law_error,
                 "that the law itself is off by, of the largest force; no measurement lowers it")
      .show_default();
  sub.add_option("--error", s.error, "wanted, of the largest force").show_default();
  sub.add_option("--criterion", s.criterion,
                 "mean: --error is a root mean square over the region; worst: half of the 95 % "
                 "interval at its worst place")
      .is_one_of({"mean", "worst"})
      .show_default();
  sub.add_option("--mount-time", s.mount_time, "to change the length").show_default();
  sub.add_option("--step-time", s.step_time, "to change the pressure, wait and read")
      .show_default();
  sub.add_option("--shortest", s.shortest, "length at which the law is wanted");
  sub.add_option("--longest", s.longest, "length at which it is; absent: the rest length");
  sub.add_option("--lowest", s.lowest, "pressure at which it is");
  sub.add_option("--most", s.most, "mounts at most").show_default();
}

}  // namespace

void add_identify_plan(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyPlanOptions>();
  Command sub = identify.subcommand(
      "plan", "which lengths and pressures to measure for an error, and in how many minutes",
      "sinew identify plan --rest-length \"250 mm\" --diameter \"10 mm\" --pressure \"600 kPa "
      "gauge\" --error \"2 %\" -o plan.csv\n"
      "  sinew identify plan forces.csv --error \"1.5 %\"");
  add_data_options(sub, options->data);
  sub.option("DATA").required(false);
  add_rest_length(sub, options->settings.rest_length);
  sub.add_option("--branch", options->how.branch, "of DATA: fill, vent or both")
      .is_one_of({"fill", "vent", "both"})
      .show_default();
  add_plan_options(sub, options->settings);
  sub.add_option("-o,--out", options->out, "FILE.csv: a row for each reading, to fill in");
  add_units(sub, options->units, "of what is printed, else mm and kPa; --json is in SI");
  sub.add_flag("--force", options->force, "replace it");
  sub.add_flag("--json", options->json, "print the plan as JSON");
  sub.add_flag("--quiet", options->quiet, "only the plan and errors");
  sub.callback([options, &action] { action = [options] { return run_plan(*options); }; });
}

}  // namespace sinew::cli
