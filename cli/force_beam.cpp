// cli/force_beam.cpp - `sinew force-beam`: what a beam with strain gages reads, and when it yields.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/setting_options.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/identify/task/methods.h"

namespace sinew::cli {

namespace {

struct ForceBeamOptions {
  identify::TransducerSettings settings;
  std::string units;
  bool json = false, quiet = false;
};

ExitCode run_force_beam(const ForceBeamOptions& options) {
  const identify::Transducer s = transducer_of(options.settings);
  const std::optional<double> wanted = wanted_sensitivity(options.settings);
  if (options.json) {
    fmt::print("{}\n", json_of(s, wanted));
    return ok;
  }
  const config::UnitsToShow asked = units_asked(options.units, units::UnitSet::si);
  const units::ShownUnits* shown = asked.asked ? &asked.units : nullptr;
  fmt::print("{}", text_of(s, shown));
  if (wanted)
    fmt::print("\n{} with the gages, from the load:\n{}", options.settings.sensitivity,
               text_of_places(s, *wanted, shown));
  for (const std::string& doubt : doubts(s)) Messages(options.quiet).warning(doubt);
  return ok;
}

}  // namespace

void add_force_beam(CLI::App& app, Action& action) {
  auto options = std::make_shared<ForceBeamOptions>();
  const identify::MethodRow row = identify::SettingList(options->settings).of;
  CLI::App& sub =
      subcommand(app, std::string(row.name), std::string(row.doc),
                 "sinew force-beam --load \"20 lbf\" --gain 400 --sensitivity \"0.1 V/lbf\"");
  SettingOptions rows(sub);
  fields(rows, options->settings);
  add_units(sub, options->units, "of what is printed, else SI and inches; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_force_beam(*options); }; });
}

}  // namespace sinew::cli
