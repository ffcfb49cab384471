#include "sinew/identify/actuator/static_model.h"

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

// A parameter: its name, its key and unit in a file, its place, and whether its bounds are those of
// a possible law - a tension that grows with the pressure, a braid that is longer than the muscle,
// ends that leave some of the muscle - or a guess. One length does not determine a parameter that
// acts over the length.
struct ParameterRow {
  std::string_view name, key, unit;
  double& (*of)(StaticSetting& setting);
  bool may_widen, is_over_length;
};

// Returns the place of a value in a part of the actuator.
template <auto Part, auto Member>
double& place_in(StaticSetting& setting) {
  return setting.actuator.*Part.*Member;
}

double& end_loss_of(StaticSetting& setting) { return setting.end_loss; }

using actuator::Actuator;
constexpr bool possible = false, guessed = true, at_one = false, over_length = true;

// clang-format off
constexpr ParameterRow parameter_rows[] = {  // in the order of FreeParameter
    {"thread_length",        "braid.thread_length",           "m",       place_in<&Actuator::braid, &actuator::Braid::thread_length>,                possible, over_length},
    {"turns",                "braid.turns",                   "1",       place_in<&Actuator::braid, &actuator::Braid::turns>,                        guessed,  at_one},
    {"effectiveness_c0",     "effectiveness.polynomial",      "1",       place_in<&Actuator::effectiveness, &actuator::Effectiveness::c0>,           guessed,  at_one},
    {"effectiveness_c1",     "effectiveness.polynomial",      "1/Pa",    place_in<&Actuator::effectiveness, &actuator::Effectiveness::c1>,           possible, at_one},
    {"effectiveness_c2",     "effectiveness.polynomial",      "1/Pa2",   place_in<&Actuator::effectiveness, &actuator::Effectiveness::c2>,           guessed,  at_one},
    {"threshold",            "effectiveness.threshold",       "Pa diff", place_in<&Actuator::effectiveness, &actuator::Effectiveness::threshold>,    guessed,  at_one},
    {"bladder_stiffness",    "bladder.stiffness",             "N/m",     place_in<&Actuator::bladder, &actuator::Bladder::stiffness>,                guessed,  over_length},
    {"bladder_rest_length",  "bladder.rest_length",           "m",       place_in<&Actuator::bladder, &actuator::Bladder::rest_length>,              guessed,  over_length},
    {"bladder_quadratic",    "bladder.quadratic",             "N/m2",    place_in<&Actuator::bladder, &actuator::Bladder::quadratic>,                guessed,  over_length},
    {"bladder_cubic",        "bladder.cubic",                 "N/m3",    place_in<&Actuator::bladder, &actuator::Bladder::cubic>,                    guessed,  over_length},
    {"saturating_tension",   "bladder.saturating_tension",    "N",       place_in<&Actuator::bladder, &actuator::Bladder::saturating_tension>,       guessed,  over_length},
    {"saturation_length",    "bladder.saturation_length",     "m",       place_in<&Actuator::bladder, &actuator::Bladder::saturation_length>,        guessed,  over_length},
    {"caps_length",          "caps.length",                   "m",       place_in<&Actuator::caps, &actuator::Caps::length>,                         guessed,  over_length},
    {"taper_gain",           "taper.gain",                    "1",       place_in<&Actuator::taper, &actuator::Taper::gain>,                         possible, over_length},
    {"taper_extra_gain",     "taper.extra_gain",              "1",       place_in<&Actuator::taper, &actuator::Taper::extra_gain>,                   possible, over_length},
    {"taper_extra_pressure", "taper.extra_pressure",          "Pa diff", place_in<&Actuator::taper, &actuator::Taper::extra_pressure>,               possible, over_length},
    {"wall_thickness",       "wall.thickness",                "m",       place_in<&Actuator::wall, &actuator::Wall::thickness>,                      guessed,  over_length},
    {"half_width",           "hysteresis.half_width",         "Pa diff", place_in<&Actuator::hysteresis, &actuator::Hysteresis::half_width>,         guessed,  at_one},
    {"width_per_pressure",   "hysteresis.width_per_pressure", "1",       place_in<&Actuator::hysteresis, &actuator::Hysteresis::width_per_pressure>, guessed,  at_one},
    {"width_per_tension",    "hysteresis.width_per_tension",  "1",       place_in<&Actuator::hysteresis, &actuator::Hysteresis::width_per_tension>,  guessed,  at_one},
    {"end_loss",             "",                              "m",       end_loss_of,                                                          possible, at_one},
    {"series_compliance",    "series.compliance",             "m/N",     place_in<&Actuator::series, &actuator::Series::compliance>,                 guessed,  over_length},
    {"toe_tension",          "toe.tension",                   "N",       place_in<&Actuator::toe, &actuator::Toe::tension>,                          guessed,  at_one},
};
// clang-format on

const ParameterRow& row_of(FreeParameter free_parameter) {
  return parameter_rows[static_cast<std::size_t>(free_parameter)];
}

// Returns n of a braid that has the full scale force at its rest length and the highest pressure.
double likely_turns(const StaticScales& s, double thread_length) {
  const double l = s.rest_length;
  const double area = s.top_pressure * (3 * l * l - thread_length * thread_length);
  return std::sqrt(area / (4 * std::numbers::pi * s.full_scale));
}

// Start value, bounds and scale of a parameter.
struct SearchRange {
  double start, low, high, scale;
};

// Returns the range of each parameter.
std::array<SearchRange, std::size(parameter_rows)> ranges_of(const StaticScales& s) {
  const double l = s.rest_length, f = s.full_scale, p = s.top_pressure;
  const double n = likely_turns(s, 1.15 * l);
  // clang-format off
  return {{
      {1.15 * l, 1.04 * l, 1.7 * l, 0.1 * l},                                     // thread_length
      {n, 0.05 * n, 5 * n, 0.1 * n},                                              // turns
      {1, 0.05, 5, 0.1},                                                          // effectiveness_c0
      {0, -0.6 / p, 20 / p, 0.1 / p},                                             // effectiveness_c1
      {0, -20 / (p * p), 20 / (p * p), 0.1 / (p * p)},                            // effectiveness_c2
      {0.05 * p, 0, 0.5 * p, 0.02 * p},                                           // threshold
      {0.3 * f / l, 0, 20 * f / l, 0.1 * f / l},                                  // bladder_stiffness
      {l, 0.2 * l, 3 * l, 0.05 * l},                                              // bladder_rest_length
      {0, -500 * f / (l * l), 500 * f / (l * l), f / (l * l)},                    // bladder_quadratic
      {0, -1e4 * f / (l * l * l), 1e4 * f / (l * l * l), 10 * f / (l * l * l)},   // bladder_cubic
      {0.2 * f, 0, 3 * f, 0.1 * f},                                               // saturating_tension
      {0.022 * l, 0.003 * l, 0.3 * l, 0.01 * l},                                  // saturation_length
      {0.02 * l, 0, 0.5 * l, 0.02 * l},                                           // caps_length
      {1.1, 0.3, 3, 0.1},                                                         // taper_gain
      {0.1, 0, 5, 0.1},                                                           // taper_extra_gain
      {0.2 * p, 0.02 * p, 3 * p, 0.1 * p},                                        // taper_extra_pressure
      {0.005 * l, 0, 0.05 * l, 0.005 * l},                                        // wall_thickness
      {0.01 * p, 0, 0.3 * p, 0.01 * p},                                           // half_width
      {0.01, 0, 0.3, 0.01},                                                       // width_per_pressure
      {0.01, 0, 0.2, 0.01},                                                       // width_per_tension; at most 0.4 in a file
      {0, -0.3 * l, 0.15 * l, 0.02 * l},                                          // end_loss
      {0.005 * l / f, 1e-5 * l / f, 0.2 * l / f, 0.01 * l / f},                   // series_compliance
      {0.04 * f, 0.002 * f, 0.3 * f, 0.01 * f},                                   // toe_tension
  }};
  // clang-format on
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

std::string_view key_of(FreeParameter free_parameter) { return row_of(free_parameter).key; }

double& value_of(StaticSetting& setting, FreeParameter free_parameter) {
  return row_of(free_parameter).of(setting);
}

bool needs_lengths(FreeParameter free_parameter) { return row_of(free_parameter).is_over_length; }

Parameter parameter_of(FreeParameter free_parameter, const StaticScales& scales) {
  const ParameterRow& row = row_of(free_parameter);
  const auto [start, low, high, scale] =
      ranges_of(scales)[static_cast<std::size_t>(free_parameter)];
  return {std::string(row.name), std::string(row.unit), start, low, high, scale, row.may_widen};
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
