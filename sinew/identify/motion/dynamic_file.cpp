#include "sinew/identify/motion/dynamic_file.h"

#include <cmath>

#include "sinew/identify/fit/provenance.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

Json describe(const Damping& d) {
  return {{"coulomb_length_m", d.coulomb_length},
          {"viscous_N_s_per_m", d.viscous},
          {"kept_per_period", d.kept},
          {"equivalent_damping_ratio", d.ratio}};
}

}  // namespace

Json describe(const DynamicResult& found) {
  Json out;
  for (const DecaySummary& s : found.records) {
    Json r{{"file", s.file},
           {"turns", s.turns},
           {"period_s", s.period},
           {"noise_m", s.noise},
           {"rest_length_m", s.rest},
           {"first_amplitude_m", s.amplitude},
           {"sealed_stiffness_N_per_m", s.stiffness},
           {"friction_at_rest_N", s.friction},
           {"exponent", s.exponent}};
    if (std::isfinite(s.pressure_delay)) r["pressure_delay_s"] = s.pressure_delay;
    if (s.printed) r["two_point_printed"] = describe(*s.printed);
    if (s.exact) r["two_point_exact"] = describe(*s.exact);
    if (!s.exact) r["two_point_refused"] = s.why_not;
    r["all_turns"] = describe(s.all.damping);
    out["records"].push_back(r);
  }
  return out;
}

std::string loss_file(const config::Origins& start, const std::string& start_file,
                      actuator::Actuator a, const DynamicResult& found,
                      const std::vector<std::string>& files) {
  Provenance provenance(start, start_file);
  std::string source = "sinew identify dynamic";
  for (const std::string& file : files) source += " " + file;
  source += ": " + found.report.best().model;

  const std::string path = "actuator." + a.name + ".loss.";
  for (const char* key : {"viscous", "coulomb_length"}) {
    provenance.given(path + key, source + ", which has none");
    for (const Estimate& e : found.report.best().parameters)
      if (e.name == key) provenance.fitted(path + key, e, source);
  }
  provenance.given(path + "coulomb_scale", source);
  provenance.given(path + "coulomb_stiffness",
                   source + (found.loss.coulomb_stiffness > 0 ? ", of the sealed muscle at rest"
                                                              : ", which has none"));
  provenance.given(path + "stick", source);
  a.loss = found.loss;
  return actuator_file(a, provenance);
}

}  // namespace sinew::identify
