#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/origin.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/motion/dynamic.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

namespace {

// Returns the losses of one record, from two points or from all turning points, in SI with the
// unit in the key.
Json describe(const Damping& d) {
  return {{"coulomb_length_m", d.coulomb_length},
          {"viscous_N_s_per_m", d.viscous},
          {"kept_per_period", d.kept},
          {"equivalent_damping_ratio", d.ratio}};
}

// Returns the text of the actuator's file with the identified [loss]. `start` are the origins of
// the actuator's values in `start_file`, which are kept; `sources` were fitted.
std::string loss_file(const config::Origins& start, const std::string& start_file,
                      actuator::Actuator a, const DynamicResult& found,
                      const std::vector<Source>& sources) {
  Provenance provenance(start, start_file);
  const std::string source = source_words("dynamic", sources, found.report.best().model);

  const std::string path = "actuator." + a.name + ".loss.";
  for (const char* key : {"viscous", "coulomb_length"})
    provenance.fitted(path + key, found.report.best().estimate(key), source,
                      source + ", which has none");
  provenance.given(path + "coulomb_scale", source);
  provenance.given(path + "coulomb_stiffness",
                   source + (found.loss.coulomb_stiffness > 0 ? ", of the sealed muscle at rest"
                                                              : ", which has none"));
  provenance.given(path + "stick", source);
  a.loss = found.loss;
  return actuator_file(a, provenance);
}

// Averages a long recording to a hundredth of a period, as a swing is smooth.
Measured swing_averaged(const Measured& data) {
  constexpr std::size_t most = 4000;
  if (data.rows() <= most) return data;
  QuickChange quickest = quickest_change(data["time"], data["length"]);
  quickest.duration *= 4;
  return times_averaged(data, most, quickest);
}

std::vector<DecayRecord> records_of(const std::vector<MarkedSource>& sources,
                                    const DynamicSettings& settings, const SettingValues& values,
                                    const actuator::Actuator& a) {
  const double atmosphere = sources[0].source.atmosphere;
  const std::size_t n = sources.size();
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> mass = values.each(settings.mass, n);
  const std::vector<double> external = values.each(settings.external_volume, n);
  const std::vector<double> pressure = settings.pressure.empty()
                                           ? std::vector<double>(n, unknown)
                                           : values.each(settings.pressure, n);
  const std::optional<double> exponent = values.given(settings.exponent);
  std::vector<DecayRecord> out;
  for (std::size_t i = 0; i < n; ++i) {
    DecayRecord r{.data = swing_averaged(read_measured(sources[i].source, decay_columns()))};
    r.stand = {.actuator = a,
               .mass = mass[i] / settings.count,
               .pressure = pressure[i],
               .external_volume = external[i] / settings.count,
               .polytropic_exponent = exponent.value_or(r.data.has("pressure") ? unknown : 1.4),
               .atmosphere = atmosphere,
               .gravity = units::standard_gravity};
    r.held_out = sources[i].held_out;
    out.push_back(std::move(r));
  }
  return out;
}

// Damping by each way of evaluation, compared with the fitted trajectories.
void put_methods(const DynamicFound& of, const TextOptions& how, std::string& out) {
  using enum report::TextTable::Align;
  const DynamicResult& found = of.result;
  const config::UnitsToShow& chosen = how.units;
  const units::ShownUnit length =
      chosen.is_requested ? chosen.units.of("m") : units::ShownUnit{"mm", 1e3};
  const units::ShownUnit force = chosen.units.of("N"), damping = chosen.units.of("N s/m");
  // Without a choice of units each column has its own number of decimals.
  const auto in = [&](const units::ShownUnit& unit, double si, int decimals = 4) {
    return chosen.is_requested ? fmt::format("{:.4g}", unit.of(si))
                               : fmt::format("{:.{}f}", unit.of(si), decimals);
  };
  report::TextTable table(
      {"file", "method", "Q [" + length.name + "]", "friction at rest [" + force.name + "]",
       "c [" + damping.name + "]", "zeta [53]"},
      {left, left, right, right, right, right});
  const auto row = [&](const DecaySummary& s, const char* method, const Damping& d) {
    table.add({s.swing.file, method, in(length, d.coulomb_length, 5),
               in(force, d.coulomb_length * s.swing.stiffness()), in(damping, d.viscous),
               fmt::format("{:.4f}", d.ratio)});
  };
  for (const DecaySummary& s : found.records) {
    if (s.printed) row(s, "two points, [45] as printed", *s.printed);
    if (s.exact) row(s, "two points, exact", *s.exact);
    row(s, "all turns", s.all.damping);
    table.add({s.swing.file, "trajectory, " + found.report.best().model,
               in(length, found.loss.coulomb_length, 5), in(force, s.friction),
               in(damping, found.loss.viscous), ""});
  }
  put(out, "\n{}", table.text());
  for (const DecaySummary& s : found.records)
    if (!s.exact) put(out, "no two points: {}\n", s.why_not);
}

void add_json(const DynamicResult& result, Json& out) {
  for (const DecaySummary& s : result.records) {
    const Swing& swing = s.swing;
    Json r{{"file", swing.file},
           {"turns", swing.oscillation.turns.size()},
           {"period_s", swing.oscillation.period},
           {"noise_m", swing.oscillation.noise},
           {"rest_length_m", swing.rest},
           {"first_amplitude_m", swing.amplitude},
           {"sealed_stiffness_N_per_m", swing.stiffness()},
           {"friction_at_rest_N", s.friction},
           {"exponent", swing.stand.polytropic_exponent}};
    if (std::isfinite(swing.pressure_delay)) r["pressure_delay_s"] = swing.pressure_delay;
    if (s.printed) r["two_point_printed"] = describe(*s.printed);
    if (s.exact) r["two_point_exact"] = describe(*s.exact);
    if (!s.exact) r["two_point_refused"] = s.why_not;
    r["all_turns"] = describe(s.all.damping);
    out["records"].push_back(r);
  }
}

}  // namespace

DynamicFound find(const SourceList& sources, const DynamicSettings& settings) {
  const std::vector<MarkedSource> marked = marked_tables(settings.hold_out, sources);
  const SettingValues values(settings, sources[0].atmosphere);
  const experiment::MachineFile start = experiment::load_machine_file(settings.actuator);
  const actuator::Actuator& a = config::named(start.experiment.actuators, settings.name, "name",
                                              "actuator", settings.actuator);
  DynamicFound out(identify_dynamic(records_of(marked, settings, values, a), settings.model,
                                    Constraints(settings.constraints)));
  out.files = {
      file_with(loss_file(start.experiment.origins, settings.actuator, a, out.result, sources))};
  add_json(out.result, out.json);
  prints(out, put_methods);
  return out;
}

}  // namespace sinew::identify
