// identify/actuator/static_model.h - static laws that an identification compares: the free
// parameters of the actuator in each, their start values and their priors.
//
// Every model is a choice of terms of actuator/tension.h, so the identified law is the simulated
// one. Parameters are those of one muscle. For several muscles of one make the longest is the
// reference; the others are similar to it, with equal braid angle, diameter and strains:
//
//   b, n, lambda ~ L_0    k_1, F_toe ~ 1/L_0    k_2 ~ 1/L_0^2    k_3 ~ 1/L_0^3
//   Eff x (1 - L_e/L_0)
//
// L_e, the effect of the rest length, is the length that the ends take from every muscle; it does
// not follow from a geometric law. Laws with ends that give way (actuator/series.h) need no L_e:
// C_s belongs to the ends, is equal for every muscle, and so affects a short one more.
//
// A rest length is not known exactly: with several muscles, the error of each label can be fitted
// with the law (static_labels.h).
//
// Priors: a term that the data do not determine stays at its value for three Festo muscles of 20 mm
// (rest lengths 98, 225, 398 mm; docs/theory/static-models.md). Data that determine it outweigh the
// prior.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

// A parameter that a model may set free.
enum class FreeParameter {
  thread_length,
  turns,
  eff_constant,
  eff_linear,
  eff_quadratic,
  threshold,
  stiffness,
  bladder_rest_length,
  quadratic,
  cubic,
  saturating_tension,
  saturation_length,
  caps,
  taper_gain,
  taper_extra_gain,
  taper_extra_pressure,
  wall,
  half_width,
  width_per_pressure,
  width_per_tension,
  end_loss,
  series,
  toe
};

// Labels that differ by less are the same [m].
inline constexpr double same_label = 1e-6;

// Error of a muscle's labelled rest length.
struct RestLengthError {
  double labelled = 0, error = 0;  // L_0 as labelled, e_L [m]
  double low = 0, high = 0;        // bounds of e_L [m]; both 0: not fitted

  // Returns whether the error is fitted with the law.
  bool is_fitted() const { return low < high; }
};

// An actuator with a given value of every free parameter.
struct StaticSetting {
  actuator::Actuator actuator;                // reference muscle, with its labelled length
  double end_loss = 0;                        // L_e [m]
  std::vector<RestLengthError> rest_lengths;  // fitted muscles
};

// Scales of start values and bounds.
struct StaticScales {
  double rest_length = 0;                // rest length of the reference muscle [m]
  double full_scale = 0;                 // largest force [N]
  double top_pressure = 0;               // [Pa]
  double atmosphere = 0;                 // [Pa]
  std::optional<actuator::Braid> braid;  // if given, thread length and turns are not fitted
};

// Prior distribution of a free parameter.
struct Prior {
  double mean = 0, deviation = 0;
  bool logarithmic = false;  // deviation of ln(value/mean)

  // away() is the distance of a value from the mean in the unit of `deviation`; deviation_at() is
  // the deviation of the value itself near there.
  double away(double value) const { return logarithmic ? std::log(value / mean) : value - mean; }
  double deviation_at(double value) const { return logarithmic ? deviation * value : deviation; }
};

struct StaticModel {
  std::string_view name, law, source;
  std::vector<FreeParameter> free_parameters;  // in addition to the braid's
};

// Returns all models.
std::span<const StaticModel> static_models();

// Returns the free parameters of a model for these data: those of the braid (or, if it is given, of
// the effectiveness), and the model's own.
std::vector<FreeParameter> free_parameters_of(const StaticModel& model, const StaticScales& scales);

// Returns the key of a parameter in a file, below "actuator.<name>."; end_loss has no key.
std::string_view key_of(FreeParameter free_parameter);
double& value_of(StaticSetting& setting, FreeParameter free_parameter);
Parameter parameter_of(FreeParameter free_parameter, const StaticScales& scales);
std::optional<Prior> prior_of(FreeParameter free_parameter, const StaticScales& scales);

// Returns the fitted rest length of the muscle with this label [m].
double rest_length_of(const StaticSetting& setting, double labelled);

// Returns whether the parameter affects force over length, so that one length cannot determine it.
bool needs_lengths(FreeParameter free_parameter);

// Returns the setting at which every search starts.
StaticSetting setting_of(const StaticScales& scales);

// Returns an actuator scaled from the rest length `from` to the rest length `to` [m].
actuator::Actuator scaled_actuator(const actuator::Actuator& actuator, double from, double to);

// Returns the reference actuator scaled to the muscle with this labelled rest length [m].
actuator::Actuator scaled(const StaticSetting& setting, const StaticScales& scales,
                          double rest_length);

}  // namespace sinew::identify
