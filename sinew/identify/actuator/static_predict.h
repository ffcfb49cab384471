// identify/actuator/static_predict.h - forces, and muscles, that nobody measured: the chosen law
// somewhere else, with the intervals that it has earned there.
//
// A muscle of another rest length is the like of those that were fitted (static_model.h). One
// reading of its force corrects it: the law is multiplied towards the ratio of the force read to
// the force predicted, as far as the reading is surer than the law:
//
//   factor = 1 + (F_read/F - 1) t^2/(t^2 + (h/F)^2)
//
//   t  share of the force that two of three muscles are within [-]   h  half-width that two of
//      three readings of a fitted muscle are within [N]; where a file tells neither, the ratio
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

// Returns the factor above of one reading: t is the actuator's prediction.other_68, h is `half_68`.
// Throws Refusal where it does not pull at that length and pressure, or twice or half as much as
// was read: then the reading is of something else.
double reading_factor(const actuator::Actuator& actuator, const ForceReading& reading,
                      double atmosphere, double half_68 = 0);

// Returns the actuator with its law multiplied by a factor: all that pulls is as much stronger, so
// that the shape stays.
actuator::Actuator stronger(actuator::Actuator actuator, double factor);

// Returns the like of an identified actuator with another rest length, and what is known of how
// far it is off: the share of the force that muscles were missed by that the fit had not seen,
// more beyond the ratio of lengths over which that was tried. Throws Refusal where the actuator
// tells neither its own rest length nor a length that was measured.
actuator::Actuator with_rest_length(const actuator::Actuator& actuator, double rest_length,
                                    double atmosphere);

}  // namespace sinew::identify
