// cli/force_beam.cpp - `sinew force-beam`: what a beam with strain gages reads, and when it yields.
#include "sinew/identify/sensor/transducer.h"
#include "sinew/report/text/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::cli {

namespace {

using Json = nlohmann::ordered_json;
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

constexpr std::pair<const char*, Arms> arrangements[] = {{"quarter", Arms::quarter},
                                                         {"half", Arms::half},
                                                         {"poisson", Arms::poisson},
                                                         {"bending", Arms::bending}};

// Returns the arrangement that --bridge, which is one of them, names.
Arms arms_of(std::string_view bridge) {
  return std::find_if(std::begin(arrangements), std::end(arrangements),
                      [&](const auto& each) { return each.first == bridge; })
      ->second;
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

// One line of the answer: key of the JSON, words, value, SI unit and the thesis's.
struct Line {
  const char* key;
  const char* words;
  double value;
  const char* unit;
  const char* display;
};

std::vector<Line> answer(const Transducer& s) {
  const identify::TransducerPoint p = evaluate(s);
  return {
      {"load_N", "load", s.load, "N", "lbf"},
      {"strain", "strain at the gages", p.strain, "1", "1"},
      {"stress_Pa", "stress at the mount", p.stress, "N/m2", "psi"},
      {"factor_of_safety", "factor of safety", p.factor_of_safety, "1", "1"},
      {"yield_load_N", "yields at", p.yield_load, "N", "lbf"},
      {"deflection_m", "deflection", p.deflection, "m", "in"},
      {"bridge_output_V", "bridge", p.bridge_output, "V", "mV"},
      {"output_V", "amplifier", p.output, "V", "V"},
      {"sensitivity_V_per_N", "sensitivity", p.sensitivity, "V/N", "V/lbf"},
      {"counts_per_N", "after the converter", p.counts_per_newton, "count/N", "count/lbf"},
      {"clip_load_N", "the converter ends at", p.clip_load, "N", "lbf"},
  };
}

// Where the gages would have to be, for each way to wire them.
Json places(const Transducer& s, double wanted) {
  Json out;
  for (const auto& [name, arms] : arrangements) {
    identify::Bridge bridge = s.bridge;
    bridge.arms = arms;
    const double distance = gage_distance_for(s.beam, bridge, wanted);
    out[name] = distance <= s.beam.length ? Json(distance) : Json();
  }
  return out;
}

void print(const Transducer& s, const Json& where, const Options& options) {
  report::TextTable table({"", "SI", "in, lbf, psi"},
                          {report::TextTable::Align::left, report::TextTable::Align::right,
                           report::TextTable::Align::right});
  for (const Line& line : answer(s))
    table.add({line.words, config::format_quantity(line.value, line.unit, line.unit),
               std::string_view(line.unit) == "1"
                   ? ""
                   : config::format_quantity(line.value, line.unit, line.display)});
  fmt::print("{}", table.text());
  if (where.empty()) return;
  fmt::print("\n{} with the gages, from the load:\n", options.wanted);
  for (const auto& [name, distance] : where.items())
    fmt::print("  {:8}  {}\n", name,
               distance.is_null()
                   ? "beyond the mount"
                   : config::format_quantity(distance.get<double>(), "m", "m", 5) + "  " +
                         config::format_quantity(distance.get<double>(), "m", "in", 4));
}

ExitCode run_force_beam(const Options& options) {
  const Transducer s = read(options);
  Json where;
  if (!options.wanted.empty())
    where = places(
        s, quantity("--sensitivity", options.wanted, "V/N", above_zero(1e9, "output by load")));
  if (options.json) {
    Json out;
    for (const Line& line : answer(s)) out[line.key] = line.value;
    if (!where.empty()) out["gage_distance_m"] = where;
    out["beyond"] = doubts(s);
    fmt::print("{}\n", json_text(out, 2));
    return ok;
  }
  print(s, where, options);
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
  for (const auto& [name, arms] : arrangements) names.emplace_back(name);
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
