#include "sinew/identify/actuator/static_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sinew::identify {

namespace {

using enum FreeParameter;

const StaticModel models[] = {
    {"ideal", "F = p f (3 L^2 - b^2)", "[22]; Chou & Hannaford 1996", {}},
    {"effectiveness", "F = c0 p f (3 L^2 - b^2)", "[30], a constant", {eff_constant}},
    {"effectiveness-linear", "F = (c0 + c1 p) p f (3 L^2 - b^2)", "[30], linear", {eff_linear}},
    {"effectiveness-quadratic",
     "F = (c0 + c1 p + c2 p^2) p f (3 L^2 - b^2)",
     "[30]",
     {eff_linear, eff_quadratic}},
    {"effectiveness-by-ratio",
     "Eff = sum F F_ideal / sum F_ideal^2 per nominal pressure, then a parabola",
     "2.3, figures 2-10 and 2-11",
     {eff_constant, eff_linear, eff_quadratic}},
    {"threshold",
     "F = (p - P0) f (3 L^2 - b^2)",
     "pressure that the tube takes; as in Tondu & Lopez 2000",
     {threshold}},
    {"wall",
     "F = (c0 + c1 p) p (f (3 L^2 - b^2) + pi t (D0 (2 s - 1/s) - t))",
     "Chou & Hannaford 1996, wall t",
     {eff_linear, wall}},
    {"end-caps",
     "F = (p - P0) f (3 (L - d)^2 - b^2)",
     "what does not contract; Tondu 2012",
     {threshold, caps}},
    {"taper",
     "F = p f (3 (L0 - kappa (L0 - L))^2 - b^2), kappa = k + k_low exp(-p/P_low)",
     "Tondu & Lopez 2000; Kerscher et al. 2006",
     {taper_gain, taper_extra_gain, taper_extra_pressure}},
    {"elastic-linear",
     "F = (c0 + c1 p) p f (3 L^2 - b^2) + k (L - L_r)",
     "a linear bladder; Klute & Hannaford 2000 have a rubber's",
     {eff_linear, stiffness, bladder_rest_length}},
    {"elastic-cubic",
     "F = (p - P0) f (3 L^2 - b^2) + k u + k2 u^2 + k3 u^3, u = L - L0",
     "a polynomial bladder, as in Wickramatunge & Leephakpreeda 2009",
     {threshold, stiffness, quadratic, cubic}},
    {"saturating",
     "F = (p - P0) f (3 L^2 - b^2) - S (1 - exp(u/lambda)), u = L - L0",
     "exponential first part as in Sarosi & Fabulya 2012",
     {threshold, saturating_tension, saturation_length}},
    {"saturating-elastic",
     "F = (p - P0) f (3 L^2 - b^2) + k u - S (1 - exp(u/lambda)), u = L - L0",
     "exponential and linear part as in Sarosi & Fabulya 2012",
     {threshold, stiffness, saturating_tension, saturation_length}},
    {"saturating-effectiveness",
     "F = (c0 + c1 p) (p - P0) f (3 L^2 - b^2) + k u - S (1 - exp(u/lambda))",
     "the same with [30], linear",
     {threshold, eff_linear, stiffness, saturating_tension, saturation_length}},
    {"saturating-end-caps",
     "F = (p - P0) f (3 (L - d)^2 - b^2) + k u - S (1 - exp(u/lambda))",
     "the same with what does not contract",
     {threshold, stiffness, saturating_tension, saturation_length, caps}},
    {"saturating-series",
     "F = (p - P0) f (3 x^2 - b^2) - S (1 - exp(u/lambda)), x = L - C F, u = x - L0",
     "saturating, with ends that give way",
     {threshold, saturating_tension, saturation_length, series}},
    {"saturating-elastic-series",
     "F = (p - P0) f (3 x^2 - b^2) + k u - S (1 - exp(u/lambda)), x = L - C F, u = x - L0",
     "saturating-elastic, with ends that give way",
     {threshold, stiffness, saturating_tension, saturation_length, series}},
    {"saturating-toe",
     "F = s ln(1 + exp(B/s)), B = (p - P0) f (3 L^2 - b^2) - S (1 - exp(u/lambda)), u = L - L0",
     "saturating, with a slack muscle that begins to pull softly",
     {threshold, saturating_tension, saturation_length, toe}},
    {"saturating-series-toe",
     "F = s ln(1 + exp(B/s)), B = (p - P0) f (3 x^2 - b^2) - S (1 - exp(u/lambda)), x = L - C F",
     "saturating-series, with a slack muscle that begins to pull softly",
     {threshold, saturating_tension, saturation_length, series, toe}},
};

struct Info {
  std::string_view name, key, unit;
};
constexpr std::array infos = {
    Info{"thread_length", "braid.thread_length", "m"},
    Info{"turns", "braid.turns", "1"},
    Info{"effectiveness_c0", "effectiveness.polynomial", "1"},
    Info{"effectiveness_c1", "effectiveness.polynomial", "1/Pa"},
    Info{"effectiveness_c2", "effectiveness.polynomial", "1/Pa2"},
    Info{"threshold", "effectiveness.threshold", "Pa diff"},
    Info{"bladder_stiffness", "bladder.stiffness", "N/m"},
    Info{"bladder_rest_length", "bladder.rest_length", "m"},
    Info{"bladder_quadratic", "bladder.quadratic", "N/m2"},
    Info{"bladder_cubic", "bladder.cubic", "N/m3"},
    Info{"saturating_tension", "bladder.saturating_tension", "N"},
    Info{"saturation_length", "bladder.saturation_length", "m"},
    Info{"caps_length", "caps.length", "m"},
    Info{"taper_gain", "taper.gain", "1"},
    Info{"taper_extra_gain", "taper.extra_gain", "1"},
    Info{"taper_extra_pressure", "taper.extra_pressure", "Pa diff"},
    Info{"wall_thickness", "wall.thickness", "m"},
    Info{"half_width", "hysteresis.half_width", "Pa diff"},
    Info{"width_per_pressure", "hysteresis.width_per_pressure", "1"},
    Info{"width_per_tension", "hysteresis.width_per_tension", "1"},
    Info{"end_loss", "", "m"},
    Info{"series_compliance", "series.compliance", "m/N"},
    Info{"toe_tension", "toe.tension", "N"},
};

// Bounds of these are those of a law that is feasible: a tension that grows with the pressure, a
// braid that is longer than the muscle, and ends that leave some of the muscle.
constexpr FreeParameter feasible[] = {thread_length, eff_linear,       end_loss,
                                      taper_gain,    taper_extra_gain, taper_extra_pressure};

const Info& info(FreeParameter free_parameter) {
  return infos[static_cast<std::size_t>(free_parameter)];
}

// Returns n of a braid that has the full scale force at its rest length and the highest pressure.
double likely_turns(const StaticScales& s, double thread_length) {
  const double l = s.rest_length;
  const double area = s.top_pressure * (3 * l * l - thread_length * thread_length);
  return std::sqrt(area / (4 * std::numbers::pi * s.full_scale));
}

}  // namespace

std::span<const StaticModel> static_models() { return models; }

std::vector<FreeParameter> free_parameters_of(const StaticModel& model,
                                              const StaticScales& scales) {
  std::vector<FreeParameter> out;
  if (!scales.braid) {
    out = {thread_length, turns};
  } else if (model.name != "ideal" &&
             (model.free_parameters.empty() || model.free_parameters[0] != eff_constant)) {
    out = {eff_constant};
  }
  out.insert(out.end(), model.free_parameters.begin(), model.free_parameters.end());
  return out;
}

std::string_view key_of(FreeParameter free_parameter) { return info(free_parameter).key; }

double& value_of(StaticSetting& setting, FreeParameter free_parameter) {
  actuator::Actuator& a = setting.actuator;
  switch (free_parameter) {
    case thread_length:
      return a.braid.thread_length;
    case turns:
      return a.braid.turns;
    case eff_constant:
      return a.effectiveness.c0;
    case eff_linear:
      return a.effectiveness.c1;
    case eff_quadratic:
      return a.effectiveness.c2;
    case threshold:
      return a.effectiveness.threshold;
    case stiffness:
      return a.bladder.stiffness;
    case bladder_rest_length:
      return a.bladder.rest_length;
    case quadratic:
      return a.bladder.quadratic;
    case cubic:
      return a.bladder.cubic;
    case saturating_tension:
      return a.bladder.saturating_tension;
    case saturation_length:
      return a.bladder.saturation_length;
    case caps:
      return a.caps.length;
    case taper_gain:
      return a.taper.gain;
    case taper_extra_gain:
      return a.taper.extra_gain;
    case taper_extra_pressure:
      return a.taper.extra_pressure;
    case wall:
      return a.wall.thickness;
    case half_width:
      return a.hysteresis.half_width;
    case width_per_pressure:
      return a.hysteresis.width_per_pressure;
    case width_per_tension:
      return a.hysteresis.width_per_tension;
    case series:
      return a.series.compliance;
    case toe:
      return a.toe.tension;
    case end_loss:
      break;
  }
  return setting.end_loss;
}

Parameter parameter_of(FreeParameter free_parameter, const StaticScales& s) {
  const double l = s.rest_length, f = s.full_scale, p = s.top_pressure;
  const auto make = [&](double start, double low, double high, double scale) {
    return Parameter{
        .name = std::string(info(free_parameter).name),
        .unit = std::string(info(free_parameter).unit),
        .start = start,
        .low = low,
        .high = high,
        .scale = scale,
        .may_widen = std::ranges::find(feasible, free_parameter) == std::end(feasible)};
  };
  const double n = likely_turns(s, 1.15 * l);
  switch (free_parameter) {
    case thread_length:
      return make(1.15 * l, 1.04 * l, 1.7 * l, 0.1 * l);
    case turns:
      return make(n, 0.05 * n, 5 * n, 0.1 * n);
    case eff_constant:
      return make(1, 0.05, 5, 0.1);
    case eff_linear:
      return make(0, -0.6 / p, 20 / p, 0.1 / p);
    case eff_quadratic:
      return make(0, -20 / (p * p), 20 / (p * p), 0.1 / (p * p));
    case threshold:
      return make(0.05 * p, 0, 0.5 * p, 0.02 * p);
    case stiffness:
      return make(0.3 * f / l, 0, 20 * f / l, 0.1 * f / l);
    case bladder_rest_length:
      return make(l, 0.2 * l, 3 * l, 0.05 * l);
    case quadratic:
      return make(0, -500 * f / (l * l), 500 * f / (l * l), f / (l * l));
    case cubic:
      return make(0, -1e4 * f / (l * l * l), 1e4 * f / (l * l * l), 10 * f / (l * l * l));
    case saturating_tension:
      return make(0.2 * f, 0, 3 * f, 0.1 * f);
    case saturation_length:
      return make(0.022 * l, 0.003 * l, 0.3 * l, 0.01 * l);
    case caps:
      return make(0.02 * l, 0, 0.5 * l, 0.02 * l);
    case taper_gain:
      return make(1.1, 0.3, 3, 0.1);
    case taper_extra_gain:
      return make(0.1, 0, 5, 0.1);
    case taper_extra_pressure:
      return make(0.2 * p, 0.02 * p, 3 * p, 0.1 * p);
    case wall:
      return make(0.005 * l, 0, 0.05 * l, 0.005 * l);
    case half_width:
      return make(0.01 * p, 0, 0.3 * p, 0.01 * p);
    case width_per_pressure:
      return make(0.01, 0, 0.3, 0.01);
    case width_per_tension:
      return make(0.01, 0, 0.2, 0.01);  // widened at most to 0.4, the largest value of a file
    case end_loss:
      return make(0, -0.3 * l, 0.15 * l, 0.02 * l);
    case series:
      return make(0.005 * l / f, 1e-5 * l / f, 0.2 * l / f, 0.01 * l / f);
    case toe:
      return make(0.04 * f, 0.002 * f, 0.3 * f, 0.01 * f);
  }
  return {};
}

std::optional<Prior> prior_of(FreeParameter free_parameter, const StaticScales& s) {
  switch (free_parameter) {
    case thread_length:
      return Prior{1.15 * s.rest_length, 0.15 * s.rest_length};
    case threshold:
      return Prior{5e4, 2e4};
    case stiffness:
      return Prior{0.5 * s.full_scale / s.rest_length, 0.5 * s.full_scale / s.rest_length};
    case saturation_length:
      return Prior{0.022 * s.rest_length, 0.35, true};
    case caps:
      return Prior{0, 0.1 * s.rest_length};
    case toe:
      return Prior{0.03 * s.full_scale, 0.7, true};
    case series:
      return Prior{0.015 * s.rest_length / s.full_scale, 1.2, true};
    default:
      return std::nullopt;
  }
}

double rest_length_of(const StaticSetting& setting, double labelled) {
  for (const RestLengthError& r : setting.rest_lengths)
    if (std::abs(r.labelled - labelled) < same_label) return labelled + r.error;
  return labelled;
}

bool needs_lengths(FreeParameter free_parameter) {
  switch (free_parameter) {
    case thread_length:
    case stiffness:
    case bladder_rest_length:
    case quadratic:
    case cubic:
    case saturating_tension:
    case saturation_length:
    case caps:
    case taper_gain:
    case taper_extra_gain:
    case taper_extra_pressure:
    case wall:
    case series:
      return true;
    default:
      return false;
  }
}

StaticSetting setting_of(const StaticScales& s) {
  StaticSetting out;
  actuator::Actuator& a = out.actuator;
  a.braid = s.braid.value_or(
      actuator::Braid{1.15 * s.rest_length, likely_turns(s, 1.15 * s.rest_length)});
  a.effectiveness.valid_from = -1e9;
  a.effectiveness.valid_to = 1e9;
  a.long_end.length = 1e3;  // ends are not in the data
  a.bladder.rest_length = a.taper.rest_length = s.rest_length;
  a.bladder.saturation_length = 0.022 * s.rest_length;
  a.taper.extra_pressure = s.top_pressure;
  return out;
}

actuator::Actuator scaled_actuator(const actuator::Actuator& actuator, double from, double to) {
  actuator::Actuator a = actuator;
  const double r = to / from;
  if (r == 1) return a;
  // The ends take the same length of every muscle: 1 - scale is L_e/L_0.
  a.effectiveness.scale = 1 - (1 - a.effectiveness.scale) / r;
  for (double* size : {&a.braid.thread_length, &a.braid.turns, &a.bladder.saturation_length,
                       &a.bladder.rest_length, &a.taper.rest_length, &a.long_end.length,
                       &a.bladder.valid_from, &a.bladder.valid_to, &a.air.offset})
    *size *= r;
  a.bladder.stiffness /= r;
  a.toe.tension /= r;
  a.bladder.quadratic /= r * r;
  a.bladder.cubic /= r * r * r;
  return a;
}

actuator::Actuator scaled(const StaticSetting& setting, const StaticScales& scales,
                          double rest_length) {
  actuator::Actuator a = setting.actuator;
  a.effectiveness.scale = 1 - setting.end_loss / scales.rest_length;
  return scaled_actuator(a, scales.rest_length, rest_length_of(setting, rest_length));
}

}  // namespace sinew::identify
