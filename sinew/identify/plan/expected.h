// identify/plan/expected.h - the muscle that a plan is made for, as far as one can expect it: its
// law, linear about the parameters that it will likely have.
//
// The law is the richest that the data of one muscle ask for, saturating-effectiveness of
// static_model.h, with the half-width of the hysteresis where both branches are measured. A
// parameter that other muscles let one expect has their spread beforehand; any other one has that
// of the range in which it is searched.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/plan/knowledge.h"

namespace sinew::identify {

// A muscle that nobody has measured, or one that is fitted.
struct ExpectedMuscle {
  StaticScales scales;
  StaticSetting setting;
  std::vector<Knob> knobs;  // that a fit will set free
};

// Returns one by its sizes [m, Pa gauge], with what three Festo muscles have in common.
ExpectedMuscle muscle_by_size(double rest_length, double diameter, double top_pressure,
                              double atmosphere);

// Returns the muscle of an actuator's file.
ExpectedMuscle muscle_by_actuator(const actuator::Actuator& actuator, double rest_length,
                                  double top_pressure, double atmosphere);

// A muscle whose law was fitted, and how far its points scatter about it  [N].
struct FittedMuscle {
  ExpectedMuscle muscle;
  double scatter = 0;
};

// Returns the muscle that these points tell. Throws Refusal where they are too few, or of several
// rest lengths.
FittedMuscle muscle_by_points(std::span<const StaticPoint> points, double atmosphere,
                              const std::optional<actuator::Braid>& braid);

// Returns the force at a length and a gauge pressure, of a branch; 0 where it is slack  [N].
double expected_force(const ExpectedMuscle& muscle, double length, double pressure,
                      Branch branch = Branch::unknown);

// Returns the length at which it pulls no more at its top pressure  [m].
double free_length(const ExpectedMuscle& muscle);

// Returns dF/d(parameter) times the parameter's scale, of each knob  [N]. All 0 where it is slack.
std::vector<double> slopes_at(const ExpectedMuscle& muscle, double length, double pressure,
                              Branch branch = Branch::unknown);

// Returns dF/dL  [N/m].
double slope_over_length(const ExpectedMuscle& muscle, double length, double pressure);

// Returns the standard deviation of each knob before anything is measured, in its scale.
std::vector<double> deviations_before(const ExpectedMuscle& muscle);

}  // namespace sinew::identify
