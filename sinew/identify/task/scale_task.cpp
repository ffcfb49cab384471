#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/actuator/prediction.h"
#include "sinew/actuator/tension.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

constexpr double most_likely = 0.06;  // change of a law by a reading: three deviations [-]
constexpr config::Range new_length = config::above_zero(1000, "of a muscle");
constexpr config::Range new_pressure{0, 1e7, "gauge, of a muscle's air"};
constexpr config::Range new_force = config::above_zero(1e6, "of a muscle");

// Reads a text such as "115 mm, 4 bar gauge, 210 N".
ForceReading reading_of(const std::string& text, double atmosphere) {
  const std::size_t first = text.find(','), second = text.find(',', first + 1);
  if (first == text.npos || second == text.npos || text.find(',', second + 1) != text.npos)
    config::fail({"reading", 0, 0}, "", config::in_quotes(text),
                 "length, pressure and force, two commas between them",
                 "\"115 mm, 4 bar gauge, 210 N\"");
  const std::string length = text.substr(0, first), force = text.substr(second + 1);
  const std::string pressure = text.substr(first + 1, second - first - 1);
  return {config::quantity_setting("reading", length, "m", atmosphere, new_length),
          config::quantity_setting("reading", pressure, "Pa gauge", atmosphere, new_pressure),
          config::quantity_setting("reading", force, "N", atmosphere, new_force)};
}

// Returns the weight of the force in the error at other rest lengths: older files have no share of
// the force, and none in their intervals.
double weight_of_force(const config::Origins& origins, const std::string& name) {
  const config::Origin* share =
      config::find_origin(origins, "actuator." + name + ".prediction.per_force_68");
  return share && share->is_default ? 0 : by_force;
}

std::string file_of(const ScaleFound& found, const ScaleSettings& s, double weight) {
  const std::string path = "actuator." + found.actuator.name + ".";
  Provenance provenance({}, s.file + ", with another rest length");
  const std::string source = fmt::format("sinew identify scale {} {}", s.file, s.rest_length);
  for (const char* key :
       {"braid.thread_length", "braid.turns", "effectiveness.scale", "prediction.rest_length",
        "prediction.lengths", "prediction.inside_68", "prediction.inside_95",
        "prediction.per_force_68", "prediction.per_force_95", "prediction.between_68",
        "prediction.between_95", "prediction.beyond_68", "prediction.beyond_95",
        "prediction.above_68", "prediction.above_95"})
    provenance.given(path + key, source);
  const std::string by_reading =
      fmt::format("{}; times {:.4f} by its reading, {}", source, found.corrected_by, s.reading);
  for (const char* key :
       {"effectiveness.polynomial", "bladder.stiffness", "bladder.quadratic", "bladder.cubic",
        "bladder.saturating_tension", "toe.tension", "series.compliance"})
    if (found.corrected_by != 1) provenance.given(path + key, by_reading);
  actuator::Actuator a = without_idle_digits(found.actuator);
  // The file of an older one is an older one too: the keys are left out.
  if (weight == 0) a.prediction.per_force_68 = a.prediction.per_force_95 = std::nan("");
  return actuator_file(std::move(a), provenance);
}

void put_scaled(const ScaleFound& found, const TextOptions&, std::string& out) {
  const actuator::Prediction& p = found.actuator.prediction;
  put(out, "a muscle of {:.4g} mm, like that of {:.4g} mm\n", 1e3 * p.rest_length,
      1e3 * found.from);
  put(out, "largest force  {:.4g} N at {:.4g} mm and {:.4g} kPa gauge\n", found.largest,
      1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (found.corrected_by != 1)
    put(out, "its reading    the law times {:.4f}\n", found.corrected_by);
  else
    put(out, "one reading    reading=\"{:.4g} mm, {:.4g} kPa gauge, FORCE\" corrects it most\n",
        1e3 * p.lengths.back(), 1e-3 * p.highest);
  if (p.inside_95 > 0)
    put(out,
        "68 % within    {:.3g} N of the law at that force, {:.3g} N at none\n"
        "95 % within    {:.3g} N of the law at that force, {:.3g} N at none\n",
        actuator::widest_inside_68(p, found.largest), actuator::widest_inside_68(p, 0),
        actuator::widest_inside_95(p, found.largest), actuator::widest_inside_95(p, 0));
}

Json json_of(const ScaleFound& found) {
  const actuator::Prediction& p = found.actuator.prediction;
  Json out{{"format", "sinew.scaled/1"},
           {"rest_length_m", p.rest_length},
           {"from_rest_length_m", found.from},
           {"largest_force_N", found.largest},
           {"corrected_by", found.corrected_by},
           {"read_at", {{"length_m", p.lengths.back()}, {"gauge_pressure_Pa", p.highest}}}};
  const double half_68 = actuator::widest_inside_68(p, found.largest),
               half_95 = actuator::widest_inside_95(p, found.largest);
  if (!found.remarks.warnings.empty()) out["warnings"] = found.remarks.warnings;
  out["half_68_N"] = half_68 > 0 ? Json(half_68) : Json();
  out["half_95_N"] = half_95 > 0 ? Json(half_95) : Json();
  out["half_95_at_no_force_N"] = half_95 > 0 ? Json(actuator::widest_inside_95(p, 0)) : Json();
  return out;
}

}  // namespace

ScaleFound find(const SourceList&, const ScaleSettings& s) {
  const double atmosphere = atmosphere_setting(s.atmosphere);
  const auto file = experiment::load_machine_file(s.file);
  const actuator::Actuator old =
      config::named(file.experiment.actuators, s.actuator, "actuator", "actuator", s.file);
  const double rest_length = SettingValues(s, atmosphere).of(s.rest_length);
  ScaleFound out;
  const double weight = weight_of_force(file.experiment.origins, old.name);
  out.actuator = with_rest_length(old, rest_length, atmosphere, 1, weight);
  out.from = old.prediction.rest_length;
  if (!s.reading.empty()) {
    const ReadingFactor factor =
        reading_factor(out.actuator, reading_of(s.reading, atmosphere), atmosphere, weight);
    out.corrected_by = factor.law;
    if (std::abs(factor.law - 1) > most_likely)
      out.remarks.warnings.push_back(fmt::format(
          "the law is multiplied by {:.3f} for this reading, and muscles of one make differ by 2 % "
          "or so: check its length, pressure and force",
          factor.law));
    out.actuator = scale_force(with_rest_length(old, rest_length, atmosphere, factor.share, weight),
                               factor.law);
  }
  if (!s.name.empty()) out.actuator.name = s.name;
  const actuator::Prediction& p = out.actuator.prediction;
  out.largest = actuator::tension(out.actuator, p.lengths.back(), 0, p.highest, atmosphere);
  out.files = {file_with(file_of(out, s, weight))};
  out.json = json_of(out);
  if (!(p.inside_95 > 0))
    out.remarks.warnings.emplace_back(
        "how far off it is is unknown: no muscle was left out when the file was made; fit "
        "muscles of two rest lengths at least");
  prints(out, put_scaled);
  return out;
}

}  // namespace sinew::identify
