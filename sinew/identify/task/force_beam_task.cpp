#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

// --- properties of a transducer as text ---

namespace {

// One line of the output: key of the JSON, label, value, SI unit and the thesis's unit.
struct TransducerLine {
  const char* key;
  const char* words;
  double value;
  const char* unit;
  const char* display;
};

std::vector<TransducerLine> answer(const Transducer& s) {
  const TransducerPoint p = evaluate(s);
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

// Returns the required position of the gages for each bridge; empty if beyond the mount.
std::vector<std::pair<std::string_view, std::optional<double>>> places(const Transducer& s,
                                                                       double wanted) {
  std::vector<std::pair<std::string_view, std::optional<double>>> out;
  for (const auto& [name, arms] : arrangements) {
    Bridge bridge = s.bridge;
    bridge.arms = arms;
    const double distance = gage_distance_for(s.beam, bridge, wanted);
    out.push_back({name, {}});
    if (distance <= s.beam.length) out.back().second = distance;
  }
  return out;
}

}  // namespace

std::string text_of(const Transducer& s, const units::ShownUnits* shown) {
  using Align = report::TextTable::Align;
  if (shown) {
    report::TextTable table({"", ""}, {Align::left, Align::right});
    for (const TransducerLine& line : answer(s)) {
      const bool is_own = std::string_view(line.unit) == "1" || std::string_view(line.unit) == "V";
      table.add({line.words, is_own ? units::format_quantity(line.value, line.unit, line.display)
                                    : shown->text(line.value, line.unit, 6)});
    }
    return table.text().substr(1);
  }
  report::TextTable table({"", "SI", "in, lbf, psi"}, {Align::left, Align::right, Align::right});
  for (const TransducerLine& line : answer(s))
    table.add({line.words, units::format_quantity(line.value, line.unit, line.unit),
               std::string_view(line.unit) == "1"
                   ? ""
                   : units::format_quantity(line.value, line.unit, line.display)});
  return table.text();
}

std::string text_of_places(const Transducer& s, double wanted, const units::ShownUnits* shown) {
  const auto text = [&](double m) {
    return shown ? shown->text(m, "m", 5)
                 : units::format_quantity(m, "m", "m", 5) + "  " +
                       units::format_quantity(m, "m", "in", 4);
  };
  std::string out;
  for (const auto& [name, distance] : places(s, wanted))
    out += fmt::format("  {:8}  {}\n", name, distance ? text(*distance) : "beyond the mount");
  return out;
}

std::string json_of(const Transducer& s, std::optional<double> wanted) {
  Json out;
  for (const TransducerLine& line : answer(s)) out[line.key] = line.value;
  if (wanted)
    for (const auto& [name, distance] : places(s, *wanted))
      out["gage_distance_m"][name] = distance ? Json(*distance) : Json();
  out["beyond"] = doubts(s);
  return out.text(2);
}

Transducer transducer_of(const TransducerSettings& o) {
  const SettingValues values(o);
  Transducer s;
  s.beam = {.length = values.of(o.length),
            .width = values.of(o.width),
            .height = values.of(o.height),
            .gage_distance = values.of(o.gages),
            .modulus = values.of(o.modulus),
            .poisson_ratio = o.poisson,
            .yield_stress = values.of(o.yield),
            .stress_concentration = o.concentration};
  s.bridge = {.arms = std::ranges::find(arrangements, o.bridge, &Arrangement::name)->arms,
              .gage_factor = o.gage_factor,
              .excitation = values.of(o.excitation),
              .gain = o.gain};
  s.load = values.of(o.load);
  s.full_scale = values.of(o.full_scale);
  s.bits = o.bits;
  if (s.beam.gage_distance > s.beam.length)
    config::fail({"gages", 0, 0}, "", config::in_quotes(o.gages),
                 "no more than the beam's length, " + o.length,
                 "the distance from the load to the middle of the gages");
  return s;
}

std::optional<double> wanted_sensitivity(const TransducerSettings& o) {
  return SettingValues(o).given(o.sensitivity);
}

}  // namespace sinew::identify
