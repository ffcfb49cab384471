// identify/plan/plan.h - which lengths and pressures to measure, so that a static law is known to
// a wanted error, and how long that takes.
//
//   error      = sqrt(mean g' Cov g + law^2)/F_max       over the region, root mean square
//   half-width = 1.96 sqrt(largest g' Cov g + law^2)/F_max                      95 %, its worst
//   place
//
//   Cov  of the parameters, from the readings and what is known beforehand (knowledge.h)  law  what
//   the law itself is off by, whatever is measured  F_max  the largest force of the muscle
//
// The region is every length between the shortest and the longest at every pressure between the
// lowest and the highest at which the muscle pulls, all alike. A mount costs minutes, a step of
// pressure half of one: so at each mount the pressure goes up over some levels and down again, and
// mounts are added one by one where they lower the mean variance most, each then exchanged for a
// better one as long as there is any (an I-optimal design by exchange). Of all numbers of levels
// the one is taken that needs the fewest minutes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/plan/knowledge.h"

namespace sinew::identify {

// The muscle that a plan is made for, as far as it can be expected: its law is linear about the
// parameters that it will likely have. The law is the richest that the data of one muscle need,
// saturating-effectiveness of static_model.h, with the half-width of the hysteresis where both
// branches are measured. A parameter that is known of other muscles has their spread beforehand;
// any other one has that of the range in which it is searched.
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

// What decides: the mean of the variance over the region, or its largest value.
enum class PlanCriterion { mean, worst };

// Lengths [m] and gauge pressures [Pa] over which a law is wanted.
struct PlanRegion {
  double shortest = 0, longest = 0;
  double lowest = 0, highest = 0;
};

// Holds what a rig can do and what is wanted of it.
struct PlanOptions {
  double noise = 1;            // of one reading of the force, a standard deviation [N]
  double length_error = 1e-4;  // of a mount's length, the same for all of its readings [m]
  double law_error = 0.01;     // that the law itself is off by, of the largest force [-]
  double mount_time = 600;     // to change a mount [s]
  double step_time = 30;       // to change a pressure, wait and read [s]
  double error = 0.02;         // wanted, of the largest force [-]
  int fewest = 3;              // mounts: with fewer no length can be left out, to try the law
  int most = 12;               // mounts
  PlanCriterion criterion = PlanCriterion::mean;
};

// Two ways to say how well a law is known, both of the largest force  [-].
struct PlanError {
  double rms = 0;         // over the region, with the law's own
  double half_width = 0;  // 95 %, at the worst place of the region

  // Returns the one that decides.
  double of(PlanCriterion criterion) const {
    return criterion == PlanCriterion::mean ? rms : half_width;
  }
};

// A length, and the pressures at which force is read there: upwards, and down again.
struct PlannedMount {
  double length = 0;              // [m]
  std::vector<double> pressures;  // gauge, rising [Pa]
  double time = 0;                // that it takes [s]
  PlanError after;                // when it and those before it are measured

  // How many readings it gives: each pressure twice, but the highest.
  std::size_t readings() const { return 2 * pressures.size() - 1; }
};

// What was measured already, of one mount.
struct MeasuredMount {
  double length = 0;                // [m]
  std::vector<StaticPoint> points;  // at that length
};

// Mounts in the order in which each helps most, and what is known before and after them.
struct MeasurementPlan {
  PlanRegion region;
  PlanError before;  // with what is there already, or with nothing
  std::vector<PlannedMount> mounts;
  bool reached = false;  // the wanted error

  // Returns the error when all is measured, the time that it takes [s], and the number of readings.
  PlanError after() const { return mounts.empty() ? before : mounts.back().after; }
  double time() const;
  std::size_t readings() const;
};

// Returns all lengths from a tenth of the way between free contraction and the rest length up to
// that, and all pressures from a sixth of the top one up to that.
PlanRegion region_of(const ExpectedMuscle& muscle);

// Returns the parts of the points that have a length in common.
std::vector<MeasuredMount> mounts_of(std::span<const StaticPoint> points);

// Returns the plan; `measured` are mounts that there are already. The error that is wanted must be
// above that of the law, or no plan reaches it.
MeasurementPlan plan_measurements(const ExpectedMuscle& muscle, const PlanRegion& region,
                                  const PlanOptions& options,
                                  std::span<const MeasuredMount> measured = {});

}  // namespace sinew::identify
