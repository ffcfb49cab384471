// identify/actuator/static_predict.h - forces, and muscles, that nobody measured: the chosen law
// somewhere else, with the intervals that it has earned there.
//
// A muscle of another rest length is the like of those that were fitted (static_model.h). One
// reading of its force corrects it: muscles of one make differ in their strength by 2 %, and the
// law's form errs by 1 % of the largest force, so that a reading changes the strength by this,
//
//   factor = 1 + (F_read/F - 1) s^2/(s^2 + (0.01 F_max/F)^2)          s = 0.02
//
//   F_max  force at the longest mount and the highest pressure [N]: a reading where F
//          is near it is worth most
//
// The error that it leaves counts as one more muscle in addition to the three or so that were left
// out: it widens or narrows the share of the force that they were missed by, of which two of three
// are within t,
//
//   t^2 = (3 t^2 + (1 - F_law/F_read)^2)/4
//
// s and 0.01 are of six muscles of two makes, each from the others (static_across_test.cpp).
#pragma once

#include <optional>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/static.h"

namespace sinew::identify {

// A force that was predicted, and the half-widths about it that hold 68 and 95 % of measured ones.
// Infinite where nothing of the kind was tried.
struct StaticForce {
  double force = 0;                 // [N]
  double half_68 = 0, half_95 = 0;  // [N]
  Guess guess = Guess::inside;
};

// Returns the force at a point of a muscle of any rest length.
StaticForce predict(const StaticResult& result, const StaticPoint& point);

// Returns the muscle of a rest length: one of those that were fitted, or their like with lengths
// in the same proportion  [m].
StaticMuscle muscle_of(const StaticResult& result, double rest_length);

// Returns what a file tells of how far measured forces lie from the muscle's law: root mean squares
// of the half-widths at its lengths (nine of them at most), halfway in the widest gap between two,
// and a fifth of their ranges beyond the lengths and the pressures.
actuator::Prediction prediction_of(const StaticResult& result, const StaticMuscle& muscle);

// One reading of a muscle at rest.
struct ForceReading {
  double length = 0, gauge_pressure = 0, force = 0;  // [m], [Pa], [N]
};

// Holds the changes that a reading makes to a muscle that was not measured.
struct ReadingFactor {
  double law = 1;    // of the law
  double share = 1;  // of t, if that is known
};

// Returns both factors above. Throws Refusal where the muscle does not pull at that length and
// pressure, or twice or half as much as was read: then the reading is of something else.
ReadingFactor reading_factor(const actuator::Actuator& actuator, const ForceReading& reading,
                             double atmosphere);

// Returns the actuator with its law multiplied by a factor: all that pulls is as much stronger, so
// that the shape stays.
actuator::Actuator stronger(actuator::Actuator actuator, double factor);

// Returns the like of an identified actuator with another rest length, and what is known of how
// far it is off: the share of the force that muscles were missed by that the fit had not seen,
// more beyond the ratio of lengths over which that was tried. Throws Refusal where the actuator
// has neither its own rest length nor a length that was measured. The share is multiplied with
// `share`, which follows from a reading.
actuator::Actuator with_rest_length(const actuator::Actuator& actuator, double rest_length,
                                    double atmosphere, double share = 1);

}  // namespace sinew::identify
