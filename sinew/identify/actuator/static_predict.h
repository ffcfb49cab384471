// identify/actuator/static_predict.h - forces and muscles that were not measured, predicted with
// the chosen law, with intervals from cross-validation.
//
// A muscle of another rest length is similar to those that were fitted (static_model.h). One
// reading of its force corrects it. Muscles of one make differ in strength by 2 %, and the error of
// the law's form is 1 % of the largest force, so a reading multiplies the strength with this
// factor:
//
//   factor = 1 + (F_read/F - 1) s^2/(s^2 + (0.01 F_max/F)^2)          s = 0.02
//
//   F_max  force at the longest mount and the highest pressure [N]; a reading with F
//          near it has the most weight
//
// The remaining error counts as one more muscle in addition to the roughly three that were left
// out: it widens or narrows the relative error t, within which two of three muscles are:
//
//   t^2 = (3 t^2 + (1 - F_law/F_read)^2)/4      t = other_68 sqrt((F_max/F)^2 + 4)
//
// s and 0.01 come from six muscles of two makes, each predicted from the others
// (static_across_test.cpp).
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/static.h"

namespace sinew::identify {

// A predicted force, and the half-widths that contain 68 and 95 % of measured ones; infinite if
// cross-validation had no such case.
struct StaticForce {
  double force = 0;                 // [N]
  double half_68 = 0, half_95 = 0;  // [N]
  PredictionKind kind = PredictionKind::inside;
};

// Returns the force at a point of a muscle of any rest length.
StaticForce predict(const StaticResult& result, const StaticPoint& point);

// Returns the muscle of a rest length [m]: a fitted one, or a similar one with lengths in
// proportion.
StaticMuscle muscle_of(const StaticResult& result, double rest_length);

// Returns the prediction errors that a file states: root mean squares of the half-widths at the
// muscle's lengths (at most nine), halfway in the widest gap between two, and a fifth of the ranges
// beyond the lengths and the pressures.
actuator::Prediction prediction_of(const StaticResult& result, const StaticMuscle& muscle);

// One reading of a muscle at rest.
struct ForceReading {
  double length = 0, gauge_pressure = 0, force = 0;  // [m], [Pa], [N]
};

// Corrections of a muscle that was not fitted, from one reading.
struct ReadingFactor {
  double law = 1;    // factor of the law
  double share = 1;  // factor of t, if that is known
};

// Returns both factors above; `weight` as in with_rest_length(). Throws Refusal if the muscle does
// not pull at that length and pressure, or pulls twice or half as much as the reading: then the
// reading belongs to something else.
ReadingFactor reading_factor(const actuator::Actuator& actuator, const ForceReading& reading,
                             double atmosphere, double weight = by_force);

// Returns the actuator with its force multiplied by a factor at every length and pressure.
actuator::Actuator scale_force(actuator::Actuator actuator, double factor);

// Returns an identified actuator scaled to another rest length, with its uncertainty: the relative
// error on muscles that were left out of the fit, larger beyond the tested ratio of lengths,
// multiplied with `share` from a reading. `weight` is that of the force in this error: 0 for older
// files, which have no key per_force_68 and whose interval is the same at every force. Throws
// Refusal if the actuator has neither its own rest length nor a measured length.
actuator::Actuator with_rest_length(const actuator::Actuator& actuator, double rest_length,
                                    double atmosphere, double share = 1, double weight = by_force);

}  // namespace sinew::identify
