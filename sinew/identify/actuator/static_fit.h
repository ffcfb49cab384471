// identify/actuator/static_fit.h - fit of one static model to points of force, length and pressure.
//
//   taut   r = F(L, p) - F_measured            slack   r = max(F(L, p), 0) - F_measured
//
// A slack point is censored: it shows that the muscle does not pull, not how hard it would push.
// All points within the scatter of zero force are treated so. Two passes: the first estimates the
// scatter of the points (sigma, by the median), the second treats points beyond 4 sigma as outliers
// and adds the priors, residuals (value - mean)/deviation x sigma, which like points have less
// weight beyond 4 deviations. If there are several muscles, the errors of their rest lengths are
// fitted as well (static_labels.h).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"

namespace sinew::identify {

struct StaticFit {
  StaticScales scales;
  StaticSetting setting;
  std::vector<FreeParameter> free_parameters;
  Solution solution;  // free parameters, then fitted rest lengths; residuals of points alone
  std::vector<Parameter> parameters;   // as they were searched, with widened bounds
  Constraints constraints;             // those frozen at their bounds
  double scatter = 0;                  // sigma [N]
  double variance = 0;                 // mean variance within averages [N2]
  std::size_t outliers = 0;            // points beyond 4 sigma
  std::vector<FreeParameter> unknown;  // not determined by the data, at their prior
};

// Returns the estimate of a muscle's rest length error; null if its label is not fitted.
const Estimate* rest_length_estimate(const StaticFit& fit, double labelled);

// Returns the force [N] at a length [m], at the pressure and on the branch of a point.
// Negative where the muscle would push.
double law_force(const actuator::Actuator& a, double length, const StaticPoint& point,
                 double atmosphere);

// Returns the predicted force of a point [N], never negative.
double predicted(const StaticSetting& setting, const StaticScales& scales,
                 const StaticPoint& point);

// Return predicted - measured force of every point [N].
std::vector<double> residuals_of(const StaticSetting& setting, const StaticScales& scales,
                                 std::span<const StaticPoint> points);
std::vector<double> residuals_of(const StaticFit& fit, std::span<const StaticPoint> points);

// Fits the free parameters to the points. `start`: a solution with the same parameters, whose
// bounds and frozen parameters are kept. `tolerance`: see SolverOptions. Throws Refusal if there
// are too few points.
StaticFit fit_static(const std::vector<FreeParameter>& free_parameters,
                     std::span<const StaticPoint> points, const StaticScales& scales,
                     const StaticFit* start = nullptr, double tolerance = 1e-14);

// Returns the problem that such a fit has solved, for its profiles.
Refit refit_of(const StaticFit& fit, std::span<const StaticPoint> points);

// Fits the method of the thesis, 2.3: the effectiveness at each nominal pressure as a ratio of
// sums, with a parabola through them. The braid is the given one, or that of an ideal fit.
StaticFit fit_by_ratio(std::span<const StaticPoint> points, const StaticScales& scales);

}  // namespace sinew::identify
