// identify/plan/plan.h - plan of the lengths and pressures to measure for a required accuracy of a
// static law, and of the time needed.
//
//   error      = sqrt(mean g' Cov g + law^2)/F_max       over the region, root mean square
//   half-width = 1.96 sqrt(largest g' Cov g + law^2)/F_max       95 %, its worst place
//
//   Cov    covariance of the parameters, from readings and prior information (information.h)
//   law    error of the law itself, which no measurement reduces
//   F_max  largest force of the muscle
//
// The region is every length between the shortest and the longest at every pressure between the
// lowest and the highest at which the muscle pulls, with equal weight. A mount takes minutes,
// a pressure step half a minute. So at each mount the pressure rises over some levels and falls
// again, and mounts are added one by one where they reduce the mean variance most; each is then
// exchanged for a better one while there is any (an I-optimal design by exchange). The number of
// levels is the one that needs the least time.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/plan/information.h"

namespace sinew::identify {

// The muscle that a plan is made for, with its expected parameters, about which its law is
// linearised. The law is the richest that the data of one muscle need, saturating-effectiveness of
// static_model.h, with the half-width of the hysteresis if both branches are measured. The prior
// deviation of a parameter is its spread over other muscles if known, else that of its search
// range.
struct ExpectedMuscle {
  StaticScales scales;
  StaticSetting setting;
  std::vector<FreeParameter> free_parameters;  // free parameters of a later fit
};

// Returns the expected muscle for its sizes [m, Pa gauge], with average properties of three Festo
// muscles.
ExpectedMuscle muscle_by_size(double rest_length, double diameter, double top_pressure,
                              double atmosphere);

// Returns the muscle of an actuator's file.
ExpectedMuscle muscle_by_actuator(const actuator::Actuator& actuator, double rest_length,
                                  double top_pressure, double atmosphere);

// A muscle whose law was fitted, and the scatter of its points about it [N].
struct FittedMuscle {
  ExpectedMuscle muscle;
  double scatter = 0;
};

// Returns the muscle fitted to these points. Throws Refusal if they are too few, or have several
// rest lengths.
FittedMuscle muscle_by_points(std::span<const StaticPoint> points, double atmosphere,
                              const std::optional<actuator::Braid>& braid);

// Returns the force at a length and a gauge pressure, on a branch; 0 if slack [N].
double expected_force(const ExpectedMuscle& muscle, double length, double pressure,
                      Branch branch = Branch::unknown);

// Returns the length at which the muscle does not pull at its top pressure [m].
double free_length(const ExpectedMuscle& muscle);

// Returns dF/d(parameter) times the parameter's scale, for each free parameter [N]; 0 if slack.
std::vector<double> slopes_at(const ExpectedMuscle& muscle, double length, double pressure,
                              Branch branch = Branch::unknown);

// Returns dF/dL  [N/m].
double slope_over_length(const ExpectedMuscle& muscle, double length, double pressure);

// Returns the prior standard deviation of each free parameter, in its scale.
std::vector<double> deviations_before(const ExpectedMuscle& muscle);

// Criterion of the plan: the mean of the variance over the region, or its largest value.
enum class PlanCriterion { mean, worst };

// Lengths [m] and gauge pressures [Pa] at which the law is needed.
struct PlanRegion {
  double shortest = 0, longest = 0;
  double lowest = 0, highest = 0;
};

// Properties of the measurement, and the required accuracy.
struct PlanOptions {
  double noise = 1;            // standard deviation of one force reading [N]
  double length_error = 1e-4;  // error of a mount's length, common to its readings [m]
  double law_error = 0.01;     // error of the law itself, share of the largest force [-]
  double mount_time = 600;     // to change a mount [s]
  double step_time = 30;       // to change a pressure, wait and read [s]
  double error = 0.02;         // required, share of the largest force [-]
  int fewest = 3;              // mounts; with fewer no length can be left out to test the law
  int most = 12;               // mounts
  PlanCriterion criterion = PlanCriterion::mean;
};

// Two measures of a law's error, as shares of the largest force [-].
struct PlanError {
  double rms = 0;         // over the region, including the law's own error
  double half_width = 0;  // 95 %, at the worst place of the region

  // Returns the measure of the criterion.
  double of(PlanCriterion criterion) const {
    return criterion == PlanCriterion::mean ? rms : half_width;
  }
};

// A length, and the pressures at which the force is read there, rising and falling.
struct PlannedMount {
  double length = 0;              // [m]
  std::vector<double> pressures;  // gauge, ascending [Pa]
  double time = 0;                // time for this mount [s]
  PlanError after;                // error after it and those before it

  // Returns the number of readings: each pressure twice, except the highest.
  std::size_t readings() const { return 2 * pressures.size() - 1; }
};

// Existing measurements of one mount.
struct MeasuredMount {
  double length = 0;                // [m]
  std::vector<StaticPoint> points;  // at that length
};

// Mounts in the order of their benefit, with the errors before and after them.
struct MeasurementPlan {
  PlanRegion region;
  PlanError before;  // with existing measurements, or none
  std::vector<PlannedMount> mounts;
  bool reached = false;  // the required error is reached

  // Return the error after all mounts, the total time [s], and the number of readings.
  PlanError after() const { return mounts.empty() ? before : mounts.back().after; }
  double time() const;
  std::size_t readings() const;
};

// Returns the region of lengths from a tenth of the way between free contraction and the rest
// length up to that, and pressures from a sixth of the top pressure up to that.
PlanRegion region_of(const ExpectedMuscle& muscle);

// Returns the points grouped by length.
std::vector<MeasuredMount> mounts_of(std::span<const StaticPoint> points);

// Returns the plan; `measured` are existing mounts. The required error must be above the law's own,
// otherwise no plan reaches it.
MeasurementPlan plan_measurements(const ExpectedMuscle& muscle, const PlanRegion& region,
                                  const PlanOptions& options,
                                  std::span<const MeasuredMount> measured = {});

// --- search space of a plan: candidate mounts, and the value of sets of them ---

// Returns about `count` round steps over a range, from the upper end downwards: 250, 245, 240 mm.
// The lower end is included if it is at least half a step from the last.
std::vector<double> round_steps(double low, double high, int count);

// Candidates of a plan, and the value of a choice.
class DesignSpace {
 public:
  // The muscle and the options must outlive this object.
  DesignSpace(const ExpectedMuscle& muscle, const PlanRegion& region, const PlanOptions& options);

  // Return the candidate lengths [m] and gauge pressures [Pa], ascending.
  const std::vector<double>& lengths() const { return lengths_; }
  const std::vector<double>& pressures() const { return pressures_; }

  // Returns up to `count` pressures at which the muscle pulls at a length, evenly spaced.
  std::vector<double> even_pressures(double length, std::size_t count) const;

  // Return the information before any measurement; that of a planned mount with these pressures,
  // rising and falling; and that of a measured mount.
  Information before() const;
  Information of(double length, std::span<const double> pressures) const;
  Information of(const MeasuredMount& mount) const;

  // Returns the error over the region with this information.
  PlanError error(const Information& information) const;

 private:
  PlannedReading reading(double length, double pressure, Branch branch) const;
  const PlannedReading& candidate(double length, double pressure, Branch branch) const;

  const ExpectedMuscle& muscle_;
  const PlanOptions& options_;
  double law_ = 0;  // [N]
  std::vector<double> lengths_, pressures_;
  std::vector<std::vector<double>> places_;  // slopes at the places of the region
  // Candidate readings, each computed once.
  mutable std::map<std::tuple<double, double, Branch>, PlannedReading> readings_;
};

}  // namespace sinew::identify
