// cli/force_beam.cpp - `sinew force-beam`: what a beam with strain gages reads, and when it yields.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/sensor/transducer_text.h"
#include "sinew/units/constants.h"

namespace sinew::cli {

namespace {

using Arms = identify::Bridge::Arms;
using identify::Transducer;

// The thesis's transducer, 4.4. Where the gages sit and how they are wired it does not print: of
// the bridges one gives the measured 0.17 V/lb near the strain that it wanted, 1000e-6 at 30 lb.
struct Options {
  std::string length = "0.75 in", width = "0.3 in", height = "0.15 in", gages = "0.36 in";
  std::string modulus = "10000000 psi", yield = "40000 psi";
  double poisson = 0.33, concentration = 1;
  std::string bridge = "poisson";
  double gage_factor = 2, gain = 800;
  std::string excitation = "5 V", full_scale = "5 V", load = "30 lbf", wanted;
  int bits = 12;
  bool json = false, quiet = false;
};

// Sizes, stresses and voltages that a transducer can have; what is beyond is a slip of its unit.
constexpr Range size = above_zero(10, "of a transducer");
constexpr Range stress = above_zero(1e13, "diamond has 1.2e12 N/m2");
constexpr Range voltage = above_zero(1000, "of an instrument");

// Returns the arrangement that --bridge, which is one of them, names.
Arms arms_of(std::string_view bridge) {
  return std::ranges::find(identify::arrangements, bridge, &identify::Arrangement::name)->arms;
}

double quantity(std::string_view option, const std::string& text, std::string_view unit,
                const Range& range) {
  return argument(option, text, unit, units::atmosphere, range);
}

Transducer read(const Options& o) {
  Transducer s;
  s.beam = {.length = quantity("--length", o.length, "m", size),
            .width = quantity("--width", o.width, "m", size),
            .height = quantity("--height", o.height, "m", size),
            .gage_distance = quantity("--gages", o.gages, "m", size),
            .modulus = quantity("--modulus", o.modulus, "N/m2", stress),
            .poisson_ratio = number_argument("--poisson", o.poisson,
                                             from_zero(0.5, "no stretched solid gains more")),
            .yield_stress = quantity("--yield", o.yield, "N/m2", stress),
            .stress_concentration = number_argument("--concentration", o.concentration,
                                                    {1, 100, "a mount adds to the stress"})};
  s.bridge = {.arms = arms_of(o.bridge),
              .gage_factor = number_argument("--gage-factor", o.gage_factor,
                                             above_zero(1000, "semiconductors have 200")),
              .excitation = quantity("--excitation", o.excitation, "V", voltage),
              .gain = number_argument("--gain", o.gain, above_zero(1e6, "of an amplifier"))};
  s.load = quantity("--load", o.load, "N", above_zero(1e9, "at the beam's free end"));
  s.full_scale = quantity("--full-scale", o.full_scale, "V", voltage);
  s.bits = o.bits;
  if (s.beam.gage_distance > s.beam.length)
    config::fail({"--gages", 0, 0}, "", config::in_quotes(o.gages),
                 "no more than the beam's length, " + o.length,
                 "the distance from the load to the middle of the gages");
  return s;
}

ExitCode run_force_beam(const Options& options) {
  const Transducer s = read(options);
  std::optional<double> wanted;
  if (!options.wanted.empty())
    wanted = quantity("--sensitivity", options.wanted, "V/N", above_zero(1e9, "output by load"));
  if (options.json) {
    fmt::print("{}\n", json_of(s, wanted));
    return ok;
  }
  fmt::print("{}", text_of(s));
  if (wanted)
    fmt::print("\n{} with the gages, from the load:\n{}", options.wanted,
               text_of_places(s, *wanted));
  for (const std::string& doubt : doubts(s)) Messages(options.quiet).warning(doubt);
  return ok;
}

void add_beam_options(Command sub, Options& o) {
  sub.add_option("--length", o.length, "from the load to the mount").show_default();
  sub.add_option("--width", o.width, "of the beam").show_default();
  sub.add_option("--height", o.height, "in the direction of the load").show_default();
  sub.add_option("--gages", o.gages, "from the load to the middle of the gages").show_default();
  sub.add_option("--modulus", o.modulus, "Young's, of the material").show_default();
  sub.add_option("--poisson", o.poisson, "Poisson's ratio").show_default();
  sub.add_option("--yield", o.yield, "stress at which it yields").show_default();
  sub.add_option("--concentration", o.concentration, "of stress at the mount").show_default();
}

void add_bridge_options(Command sub, Options& o) {
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
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand(
      "force-beam",
      "strain, safety and output of a beam with strain gages; without options the thesis's",
      "sinew force-beam --load \"20 lbf\" --gain 400 --sensitivity \"0.1 V/lbf\"");
  add_beam_options(sub, *options);
  add_bridge_options(sub, *options);
  sub.add_option("--load", options->load, "at the free end").show_default();
  sub.add_option("--sensitivity", options->wanted, "wanted: tells where the gages must be");
  sub.add_flag("--json", options->json, "as JSON, SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return run_force_beam(*options); }; });
}

}  // namespace sinew::cli
