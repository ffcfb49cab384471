// identify/actuator/static_model.h - the static laws that are tried: which of the actuator's
// parameters each sets free, where the search begins, what other muscles let one expect.
//
// Every model is a choice of terms of actuator/tension.h, so that what is identified is what is
// simulated. Parameters are those of one muscle. Of muscles of one make and several rest lengths
// the longest is the reference; the others are its like: same braid angle, same diameter, same
// strains,
//
//   b, n, lambda ~ L_0    k_1, F_toe ~ 1/L_0    k_2 ~ 1/L_0^2    k_3 ~ 1/L_0^3
//   Eff x (1 - L_e/L_0)
//
// L_e, the rest length's own effect, is what the ends take from every muscle alike; no geometric
// law gives it. Laws whose ends give way (actuator/series.h) need no L_e: C_s is that of the ends,
// the same for every muscle, and takes more from a short one by itself.
//
// Nobody knows a rest length to the last bit: of several muscles each may have another one than its
// label says, which is fitted with the law (static_labels.h).
//
// Priors: a term that the data do not determine stays where three Festo muscles of 20 mm put it
// (rest lengths 98, 225, 398 mm; docs/theory/static-models.md), instead of anywhere. Where the data
// say something, that wins.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

// A parameter that a model may set free.
enum class Knob {
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
  end_loss,
  series,
  toe
};

// Labels nearer to each other than this are one  [m].
inline constexpr double same_label = 1e-6;

// What a muscle's rest length is more than its label says.
struct RestLengthError {
  double labelled = 0, error = 0;  // L_0 as labelled, delta [m]
  double low = 0, high = 0;        // bounds of delta [m]; both 0: the label is believed

  // Is it fitted with the law?
  bool doubted() const { return low < high; }
};

// What a set of knobs comes to.
struct StaticSetting {
  actuator::Actuator actuator;                // of a muscle as long as the reference's label says
  double end_loss = 0;                        // c [m]
  std::vector<RestLengthError> rest_lengths;  // of the muscles that were fitted
};

// Sizes that start values and bounds go by.
struct StaticScales {
  double rest_length = 0;                // of the reference muscle [m]
  double full_scale = 0;                 // largest force [N]
  double top_pressure = 0;               // [Pa]
  double atmosphere = 0;                 // [Pa]
  std::optional<actuator::Braid> braid;  // given: thread length and turns are not searched
};

// Holds what is expected of a knob before the data are looked at.
struct Prior {
  double mean = 0, deviation = 0;
  bool logarithmic = false;  // deviation of ln(value/mean)

  // Returns how far a value lies from the mean, as the deviation counts it, and the deviation of
  // the value itself about there.
  double away(double value) const { return logarithmic ? std::log(value / mean) : value - mean; }
  double deviation_at(double value) const { return logarithmic ? deviation * value : deviation; }
};

struct StaticModel {
  std::string_view name, law, source;
  std::vector<Knob> knobs;  // beside the braid's
};

// Returns all of them.
std::span<const StaticModel> static_models();

// All that a model sets free with this data: the braid (or, where it is given, the effectiveness),
// the model's own.
std::vector<Knob> knobs_of(const StaticModel& model, const StaticScales& scales);

// "actuator.<name>." + key is its place in a file; end_loss has none of its own.
std::string_view key_of(Knob knob);
double& value_of(StaticSetting& setting, Knob knob);
Parameter parameter_of(Knob knob, const StaticScales& scales);
std::optional<Prior> prior_of(Knob knob, const StaticScales& scales);

// Returns the rest length of the muscle that is labelled so  [m].
double rest_length_of(const StaticSetting& setting, double labelled);

// Does it shape how force goes with length? One length cannot tell.
bool needs_lengths(Knob knob);

// What every search begins with.
StaticSetting setting_of(const StaticScales& scales);

// Returns the like of an actuator whose muscle has the rest length `from`, with `to`  [m].
actuator::Actuator like(const actuator::Actuator& actuator, double from, double to);

// Returns the like of the reference muscle that is labelled with this rest length  [m].
actuator::Actuator scaled(const StaticSetting& setting, const StaticScales& scales,
                          double rest_length);

}  // namespace sinew::identify
