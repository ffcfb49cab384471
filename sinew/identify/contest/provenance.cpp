#include "sinew/identify/contest/provenance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

Provenance::Provenance(config::Origins start, std::string_view file)
    : origins_(std::move(start)),
      elsewhere_(fmt::format("keys without a source of their own: as in {}", file)) {}

// Adds an origin, replacing an existing one of the same path.
config::Origin& Provenance::put(std::string_view path) {
  std::erase_if(origins_, [path](const config::Origin& o) { return o.path == path; });
  return origins_.emplace_back(config::Origin{.path = std::string(path)});
}

void Provenance::fitted(std::string_view path, const Estimate& estimate, std::string_view source) {
  std::string text(source);
  if (!estimate.known.empty()) text += "; " + estimate.known;
  if (!estimate.free && estimate.low == estimate.high) return given(path, text);
  if (estimate.at_bound) text += "; at the bound of its range";
  if (!estimate.identifiable && !estimate.at_bound) text += "; not identifiable from these data";
  fitted(path, estimate.unit, 0.5 * (estimate.high - estimate.low), text);
  if (estimate.at_bound) origins_.back().uncertainty.clear();
}

void Provenance::fitted(std::string_view path, std::string_view unit, double uncertainty,
                        std::string_view source) {
  config::Origin& origin = put(path);
  origin.unit = unit;
  origin.source = source;
  origin.fit = true;
  if (std::isfinite(uncertainty))
    origin.uncertainty = units::format_quantity(uncertainty, units::difference_unit(unit),
                                                units::difference_unit(unit), 3);
}

void Provenance::fitted(std::string_view path, const Estimate* estimate, std::string_view source,
                        std::string_view without) {
  estimate ? fitted(path, *estimate, source) : given(path, without);
}

void Provenance::given(std::string_view path, std::string_view source) {
  put(path).source = source;
}

void Provenance::guessed(std::string_view path, std::string_view source) {
  given(path, source);
  origins_.back().guess = true;
}

actuator::Actuator without_idle_digits(actuator::Actuator a) {
  constexpr int of_laws = 10, of_widths = 4;
  for (double* number : {&a.braid.thread_length,
                         &a.braid.turns,
                         &a.effectiveness.c0,
                         &a.effectiveness.c1,
                         &a.effectiveness.c2,
                         &a.effectiveness.scale,
                         &a.effectiveness.threshold,
                         &a.effectiveness.valid_from,
                         &a.effectiveness.valid_to,
                         &a.bladder.stiffness,
                         &a.bladder.rest_length,
                         &a.bladder.quadratic,
                         &a.bladder.cubic,
                         &a.bladder.saturating_tension,
                         &a.bladder.saturation_length,
                         &a.bladder.valid_from,
                         &a.bladder.valid_to,
                         &a.caps.length,
                         &a.taper.gain,
                         &a.taper.extra_gain,
                         &a.taper.extra_pressure,
                         &a.taper.rest_length,
                         &a.wall.thickness,
                         &a.air.offset,
                         &a.series.compliance,
                         &a.toe.tension,
                         &a.hysteresis.half_width,
                         &a.hysteresis.width_per_pressure,
                         &a.hysteresis.width_per_tension,
                         &a.long_end.length,
                         &a.prediction.rest_length,
                         &a.prediction.lowest,
                         &a.prediction.highest})
    *number = units::with_digits(*number, of_laws);
  actuator::Prediction& p = a.prediction;
  for (double& length : p.lengths) length = units::with_digits(length, of_laws);
  for (double* width : {&p.inside_68, &p.inside_95, &p.per_force_68, &p.per_force_95, &p.between_68,
                        &p.between_95, &p.beyond_68, &p.beyond_95, &p.above_68, &p.above_95,
                        &p.other_68, &p.other_95, &p.other_reach})
    *width = units::with_digits(*width, of_widths);
  // The widest mesh must not exceed the long end.
  a.long_end.length = std::max(a.long_end.length, actuator::shortest_length(a));
  return a;
}

void guess_ends(double long_end, std::string_view reason, actuator::Actuator& a,
                Provenance& provenance) {
  const std::string path = "actuator." + a.name + ".";
  a.long_end = {.length = long_end, .stiffness = 87563.4, .damping = 122.6};
  a.short_end = {.stiffness = 87563.4, .damping = 122.6};
  provenance.guessed(path + "long_end.length", reason);
  for (const char* end : {"long_end", "short_end"})
    for (const char* key : {"stiffness", "damping"})
      provenance.guessed(path + end + "." + key, "the thesis's actuator, appendix A");
}

std::string actuator_file(actuator::Actuator actuator, const Provenance& provenance) {
  const std::string name = actuator.name;
  config::Writer writer(&provenance.origins());
  std::vector<actuator::Actuator> one{std::move(actuator)};
  actuator::fields(writer, one);

  // A file of one actuator has at its root the keys of actuator.<name> in an experiment.
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.actuator/1"));
  root.put(config::make_text("name", name));
  for (config::Node child : writer.root().find("actuator")->find(name)->children) {
    child.erase("trapezoids");  // redundant with thread_length and turns
    if (child.is_table()) child.put(config::make_text("source", provenance.elsewhere()));
    root.put(std::move(child));
  }
  return config::to_toml(root);
}

// --- parameter files that are a part of a robot ---

config::Node robot_over(const std::string& base, const std::string& out) {
  namespace fs = std::filesystem;
  config::Node root = config::make_table("");
  root.put(config::make_text("format", "sinew.robot/1"));
  if (base.empty()) return root;
  if (!out.empty() && fs::exists(out) && fs::equivalent(base, out))
    config::fail({"base", 0, 0}, "", "the file that is to be written", "another one",
                 "another name for the parameter file");
  const fs::path folder = fs::absolute(out).parent_path();
  root.put(config::make_text("base", fs::absolute(base).lexically_relative(folder)));
  return root;
}

}  // namespace sinew::identify
