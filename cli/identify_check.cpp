// cli/identify_check.cpp - `sinew identify check`: what measurements are, what is wrong with them
// and what they can tell, before a static law is fitted to them.
#include <fmt/format.h>

#include <cmath>

#include "cli/identify.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/identify/task/static_task.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"

namespace sinew::cli {

namespace {

using report::TextTable;

struct IdentifyCheckOptions {
  DataOptions data;
  identify::StaticSettings settings;
  bool json = false;
};

void print_files(const std::vector<identify::RecognisedFile>& files) {
  TextTable table({"file", "rows", "is", "columns"},
                  {TextTable::Align::left, TextTable::Align::right});
  for (const identify::RecognisedFile& f : files) {
    std::string columns;
    for (const identify::RecognisedColumn& c : f.columns)
      columns +=
          fmt::format("{}{} {} … {}", columns.empty() ? "" : ", ", c.name, c.lowest, c.highest);
    table.add(
        {f.file, std::to_string(f.rows),
         f.is_recording ? fmt::format("a recording, {:.3g} % settled", 100 * f.settled) : "a table",
         columns});
  }
  fmt::print("{}\n", table.text_within(width_of_output()));
}

void print_mounts(const std::vector<identify::RecognisedMount>& mounts) {
  using enum TextTable::Align;
  TextTable table({"muscle [mm]", "mount [mm]", "points", "pressures", "from [kPa]", "to [kPa]",
                   "largest force [N]", "branches"},
                  {right, right, right, right, right, right, right, left});
  for (const identify::RecognisedMount& m : mounts)
    table.add({m.rest_length > 0 ? fmt::format("{:.4g}", 1e3 * m.rest_length) : "?",
               fmt::format("{:.4g}", 1e3 * m.length),
               m.held_out > 0 ? fmt::format("{} + {} held out", m.points, m.held_out)
                              : std::to_string(m.points),
               std::to_string(m.pressures), fmt::format("{:.4g}", m.lowest / 1e3),
               fmt::format("{:.4g}", m.highest / 1e3), fmt::format("{:.4g}", m.strongest),
               m.branches.empty() ? "unknown" : m.branches});
  if (!table.empty()) fmt::print("{}\n", table.text());
}

void print_noise(const identify::ForceNoise& noise) {
  if (noise.readings == 0)
    fmt::print("noise of force: unknown, as no reading is repeated\n\n");
  else
    fmt::print("noise of force: {:.2g} N, {:.2g} % of the largest, from {} {}\n\n", noise.deviation,
               100 * noise.share, noise.readings, noise.from);
}

void print_checks(const std::vector<identify::Check>& checks) {
  for (const identify::Check& c : checks) {
    fmt::print("{:<6}  {:<17}  {}\n", identify::word(c.light), c.name, as_options(c.evidence));
    if (!c.advice.empty()) fmt::print("{:27}{}\n", "", as_options(c.advice));
  }
}

void print_determined(const identify::DeterminedLaw& law) {
  if (!law.refused.empty()) {
    fmt::print("\nwhat a fit could determine: not evaluated, {}\n", as_options(law.refused));
    return;
  }
  TextTable table({"a fit could determine", "known", "to know more, measure"});
  for (const identify::Determined& d : law.parameters) table.add({d.name, d.words, d.advice});
  fmt::print("\n{}by the richest law, {}: {}\n", table.text(), law.model, law.law);
}

// Fails where a check is red, so that a script stops.
ExitCode run_check(const IdentifyCheckOptions& options) {
  const identify::Checkup found = identify::check_before_static(
      sources_of(options.data, {options.settings.hold_out}), options.settings);
  if (options.json) {
    fmt::print("{}\n", to_json(found).text(2));
  } else {
    print_files(found.recognised.files);
    print_mounts(found.recognised.mounts);
    print_noise(found.recognised.noise);
    print_checks(found.checks);
    print_determined(found.determined);
  }
  return identify::has_red(found.checks) ? failed : ok;
}

}  // namespace

void add_identify_check(Command identify, Action& action) {
  auto options = std::make_shared<IdentifyCheckOptions>();
  Command sub = identify.subcommand(
      "check", "are measurements plausible, and what can `identify static` find in them",
      "sinew identify check map.csv --map force=F_N,pressure=P_gauge_Pa,length=L_m --unit F_N=N "
      "--unit \"P_gauge_Pa=Pa gauge\" --unit L_m=m --rest-length \"250 mm\"");
  add_data_options(sub, options->data);
  add_static_data_options(sub, options->settings);
  sub.add_flag("--json", options->json, "print all of it as JSON");
  sub.callback([options, &action] { action = [options] { return run_check(*options); }; });
}

}  // namespace sinew::cli
