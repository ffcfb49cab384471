// cli/force_beam.cpp - `sinew force-beam`: what a beam with strain gages reads, and when it yields.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "sinew/identify/sensor/transducer_settings.h"
#include "sinew/identify/sensor/transducer_text.h"

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

void add_beam_options(Command sub, identify::TransducerSettings& o) {
  sub.add_option("--length", o.length, "from the load to the mount").show_default();
  sub.add_option("--width", o.width, "of the beam").show_default();
  sub.add_option("--height", o.height, "in the direction of the load").show_default();
  sub.add_option("--gages", o.gages, "from the load to the middle of the gages").show_default();
  sub.add_option("--modulus", o.modulus, "Young's, of the material").show_default();
  sub.add_option("--poisson", o.poisson, "Poisson's ratio").show_default();
  sub.add_option("--yield", o.yield, "stress at which it yields").show_default();
  sub.add_option("--concentration", o.concentration, "of stress at the mount").show_default();
}

void add_bridge_options(Command sub, identify::TransducerSettings& o) {
  std::vector<std::string> names;
  for (const auto& [name, arms] : identify::arrangements) names.emplace_back(name);
  sub.add_option("--bridge", o.bridge,
                 "quarter: one gage; half: above and below; poisson: above and below, along and "
                 "across; bending: two above, two below")
      .is_one_of(names)
      .show_default();
  sub.add_option("--gage-factor", o.gage_factor, "of the gages").show_default();
  sub.add_option("--excitation", o.excitation, "of the bridge").show_default();
  sub.add_option("--gain", o.gain, "of the amplifier").show_default();
  sub.add_option("--full-scale", o.full_scale, "of the converter").show_default();
  sub.add_option("--bits", o.bits, "of the converter").is_between(1, 24).show_default();
}

}  // namespace

void add_force_beam(Command app, Action& action) {
  auto options = std::make_shared<ForceBeamOptions>();
  Command sub = app.subcommand(
      "force-beam",
      "strain, safety and output of a beam with strain gages; without options the thesis's",
      "sinew force-beam --load \"20 lbf\" --gain 400 --sensitivity \"0.1 V/lbf\"");
  add_beam_options(sub, options->settings);
  add_bridge_options(sub, options->settings);
  sub.add_option("--load", options->settings.load, "at the free end").show_default();
  sub.add_option("--sensitivity", options->settings.sensitivity,
                 "wanted: tells where the gages must be");
  add_units(sub, options->units, "of what is printed, else SI and inches; --json is in SI");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_force_beam(*options); }; });
}

}  // namespace sinew::cli
