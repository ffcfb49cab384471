// The file of a muscle whose static law was identified.
#include <fmt/format.h>

#include <cmath>

#include "sinew/actuator/body.h"
#include "sinew/actuator/series.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

// Returns the source text of the polynomial with its uncertainty: one key holds up to three values.
std::string polynomial_source(const StaticFit& fit, const std::string& source) {
  std::string out = source;
  for (std::size_t i = 0; i < fit.free_parameters.size(); ++i) {
    if (key_of(fit.free_parameters[i]) != "effectiveness.polynomial") continue;
    const Estimate& e = fit.solution.estimates[i];
    out += fmt::format("; {} +- {:.2g} {}", e.name, 0.5 * (e.high - e.low), e.unit);
  }
  return out;
}

// Scales an estimate of the reference muscle to the value of another muscle.
Estimate scaled_estimate(const Estimate& e, double value) {
  Estimate out = e;
  const double ratio = e.value != 0 ? value / e.value : 1;
  out.value = value;
  out.low = value - std::abs(ratio) * (e.value - e.low);
  out.high = value + std::abs(ratio) * (e.high - e.value);
  return out;
}

// Adds the rest length, with its uncertainty if it was fitted and that is known.
void add_rest_length(const StaticResult& result, const StaticMuscle& muscle,
                     const std::string& path, const std::string& source, Provenance& provenance) {
  const std::string key = path + "prediction.rest_length";
  const Estimate* e = rest_length_estimate(result.fit, muscle.rest_length);
  if (!e) return provenance.given(key, source);
  const std::string labelled =
      source + fmt::format("; labelled {:.4g} mm", 1e3 * muscle.rest_length);
  if (e->at_bound || !std::isfinite(e->high - e->low)) return provenance.given(key, labelled);
  provenance.fitted(key, "m", 0.5 * (e->high - e->low), labelled);
}

}  // namespace

std::string static_file(const StaticResult& result, const StaticMuscle& muscle,
                        const std::string& name, const std::string& source,
                        const std::string& braid_source) {
  actuator::Actuator a = muscle.actuator;
  a.name = name;
  const std::string path = "actuator." + name + ".";
  Provenance provenance;

  StaticSetting own{.actuator = a};
  for (std::size_t i = 0; i < result.fit.free_parameters.size(); ++i) {
    const FreeParameter free_parameter = result.fit.free_parameters[i];
    const std::string key(key_of(free_parameter));
    if (key.empty() || key == "effectiveness.polynomial") continue;
    provenance.fitted(
        path + key,
        scaled_estimate(result.fit.solution.estimates[i], value_of(own, free_parameter)), source);
  }
  if (result.fit.scales.braid)
    for (const char* key : {"braid.thread_length", "braid.turns"})
      provenance.given(path + key, braid_source);
  const std::string by_air = result.air.kappa != 1 ? "; with the volume of air at rest" : "";
  if (result.air.kappa != 1) provenance.given(path + "braid.turns", source + by_air);
  if (a.air.offset != 0) provenance.given(path + "air.offset", "the volume of air at rest");
  provenance.fitted(path + "effectiveness.polynomial", "1", std::nan(""),
                    polynomial_source(result.fit, source) + by_air);
  if (a.effectiveness.scale != 1)
    provenance.given(path + "effectiveness.scale", source + "; the rest length's effect");

  // The laws are held constant outside the measured range.
  const double shortest = muscle.lengths.front(), longest = muscle.lengths.back();
  a.effectiveness.valid_from = std::max(0.0, muscle.lowest);
  a.effectiveness.valid_to = muscle.highest;
  a.bladder.valid_from =  // braid_length(): ends that give way shorten the braid
      actuator::braid_length(a, shortest, muscle.highest, result.fit.scales.atmosphere);
  a.bladder.valid_to = std::max(longest, shortest * 1.0001);
  provenance.given(path + "effectiveness.valid", "pressures in " + source);
  provenance.given(path + "bladder.valid", "lengths in " + source);
  if (!(a.bladder.saturating_tension > 0)) a.bladder.saturation_length = 0;
  if (!actuator::tapers(a.taper)) a.taper = {};
  if (!(a.taper.extra_gain > 0)) a.taper.extra_pressure = 0;
  const double end = std::min(0.999 * (a.braid.thread_length + a.caps.length),
                              std::max(longest, muscle.file_length) * 1.005);
  guess_ends(std::max(end, actuator::shortest_length(a)),
             "0.5 % beyond the longest length measured", a, provenance);
  if (!(actuator::volume(a, a.long_end.length) > 0))
    throw Refusal("diameter or volume",
                  fmt::format("no air that is left at {:.4g} mm", 1e3 * a.long_end.length),
                  "more air at rest than stretching takes away", "another diameter or volume");
  a.prediction = prediction_of(result, muscle);
  add_rest_length(result, muscle, path, source, provenance);
  for (const char* key : {"lengths", "pressures"})
    provenance.given(path + "prediction." + key, source);
  for (const char* key :
       {"inside_68", "inside_95", "per_force_68", "per_force_95", "between_68", "between_95",
        "beyond_68", "beyond_95", "above_68", "above_95", "other_68", "other_95", "other_reach"})
    provenance.given(path + "prediction." + key, source + "; points that a fit had not seen");
  return actuator_file(without_idle_digits(std::move(a)), provenance);
}

}  // namespace sinew::identify
