#include "sinew/identify/plan/expected.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

constexpr std::string_view richest = "saturating-effectiveness";
constexpr double likely_threshold = 5e4, most_threshold = 0.3;  // [Pa], of the top pressure
constexpr double likely_share = 0.2;  // saturating tension, of the largest force

std::vector<Knob> knobs_to_fit(const StaticScales& scales, bool branches) {
  std::vector<Knob> out;
  for (const StaticModel& model : static_models())
    if (model.name == richest) out = knobs_of(model, scales);
  if (branches) out.push_back(Knob::half_width);
  return out;
}

StaticPoint point_at(const ExpectedMuscle& m, double length, double pressure, Branch branch) {
  return {.length = length,
          .pressure = pressure,
          .rest_length = m.scales.rest_length,
          .branch = branch};
}

}  // namespace

ExpectedMuscle muscle_by_size(double rest_length, double diameter, double top_pressure,
                              double atmosphere) {
  ExpectedMuscle out;
  StaticScales& s = out.scales;
  s = {.rest_length = rest_length, .top_pressure = top_pressure, .atmosphere = atmosphere};
  // The braid: the likely thread, and the turns that make its diameter at the rest length.
  const double b = prior_of(Knob::thread_length, s)->mean;
  const double turns = std::sqrt(b * b - rest_length * rest_length) / (std::numbers::pi * diameter);
  const double acts = std::min(likely_threshold, most_threshold * top_pressure);
  s.full_scale = (top_pressure - acts) * (3 * rest_length * rest_length - b * b) /
                 (4 * std::numbers::pi * turns * turns);
  out.setting = setting_of(s);
  actuator::Actuator& a = out.setting.actuator;
  a.braid = {b, turns};
  a.effectiveness.threshold = acts;
  a.bladder.stiffness = prior_of(Knob::stiffness, s)->mean;
  a.bladder.saturating_tension = likely_share * s.full_scale;
  a.bladder.saturation_length = prior_of(Knob::saturation_length, s)->mean;
  a.hysteresis.half_width = parameter_of(Knob::half_width, s).start;
  out.knobs = knobs_to_fit(s, true);
  return out;
}

ExpectedMuscle muscle_by_actuator(const actuator::Actuator& actuator, double rest_length,
                                  double top_pressure, double atmosphere) {
  ExpectedMuscle out;
  StaticScales& s = out.scales;
  s = {.rest_length = rest_length, .top_pressure = top_pressure, .atmosphere = atmosphere};
  s.full_scale = actuator::tension(actuator, rest_length, 0, top_pressure, atmosphere);
  if (!(s.full_scale > 0))
    throw Refusal("actuator", "a muscle that does not pull at its rest length",
                  "one that does at the highest pressure", "another rest_length, or pressure");
  // Its own law, without the ends that no static law has and beyond what was fitted.
  const StaticSetting plain = setting_of(s);
  out.setting.actuator = actuator;
  actuator::Actuator& a = out.setting.actuator;
  a.long_end = plain.actuator.long_end;
  a.effectiveness.valid_from = plain.actuator.effectiveness.valid_from;
  a.effectiveness.valid_to = plain.actuator.effectiveness.valid_to;
  a.bladder.valid_from = plain.actuator.bladder.valid_from;
  a.bladder.valid_to = plain.actuator.bladder.valid_to;
  if (!(a.bladder.rest_length > 0)) a.bladder.rest_length = rest_length;
  if (!(a.bladder.saturation_length > 0))
    a.bladder.saturation_length = plain.actuator.bladder.saturation_length;
  out.setting.end_loss = (1 - a.effectiveness.scale) * rest_length;
  out.knobs = knobs_to_fit(s, true);
  return out;
}

FittedMuscle muscle_by_points(std::span<const StaticPoint> points, double atmosphere,
                              const std::optional<actuator::Braid>& braid) {
  bool branches = false;
  for (const StaticPoint& p : points) {
    branches |= p.branch == Branch::vent;
    if (std::abs(p.rest_length - points.front().rest_length) > 1e-6)
      throw Refusal("rest_length",
                    fmt::format("muscles of {:.4g} and {:.4g} mm", 1e3 * points.front().rest_length,
                                1e3 * p.rest_length),
                    "points of one muscle: a plan is for one",
                    "where=\"rest_length=250\", or the file of one");
  }
  FittedMuscle out;
  out.muscle.scales = scales_of({points.begin(), points.end()}, atmosphere, braid);
  out.muscle.knobs = knobs_to_fit(out.muscle.scales, branches);
  const StaticFit fit = fit_static(out.muscle.knobs, points, out.muscle.scales);
  out.muscle.setting = fit.setting;
  out.scatter = fit.scatter;
  return out;
}

double expected_force(const ExpectedMuscle& m, double length, double pressure, Branch branch) {
  return predicted(m.setting, m.scales, point_at(m, length, pressure, branch));
}

double free_length(const ExpectedMuscle& m) {
  double slack = 0.4 * m.scales.rest_length, taut = m.scales.rest_length;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (slack + taut);
    (expected_force(m, middle, m.scales.top_pressure) > 0 ? taut : slack) = middle;
  }
  return taut;
}

std::vector<double> slopes_at(const ExpectedMuscle& m, double length, double pressure,
                              Branch branch) {
  const StaticPoint point = point_at(m, length, pressure, branch);
  std::vector<double> out;
  StaticSetting moved = m.setting;
  for (const Knob knob : m.knobs) {
    constexpr double share = 1e-3;
    double& value = value_of(moved, knob);
    const double was = value, step = share * parameter_of(knob, m.scales).scale;
    value = was + step;
    const double above = predicted(moved, m.scales, point);
    value = was - step;
    const double below = predicted(moved, m.scales, point);
    value = was;
    out.push_back((above - below) / (2 * share));
  }
  return out;
}

double slope_over_length(const ExpectedMuscle& m, double length, double pressure) {
  const double step = 1e-5 * m.scales.rest_length;
  return (expected_force(m, length + step, pressure) - expected_force(m, length - step, pressure)) /
         (2 * step);
}

std::vector<double> deviations_before(const ExpectedMuscle& m) {
  std::vector<double> out;
  StaticSetting setting = m.setting;
  for (const Knob knob : m.knobs) {
    const Parameter range = parameter_of(knob, m.scales);
    double deviation = (range.high - range.low) / std::sqrt(12.0);  // of a value anywhere in it
    if (const auto prior = prior_of(knob, m.scales))
      deviation = prior->deviation * (prior->logarithmic ? value_of(setting, knob) : 1.0);
    out.push_back(deviation / range.scale);
  }
  return out;
}

}  // namespace sinew::identify
