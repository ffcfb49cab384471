// identify/actuator/static_fit.h - one static model, fitted to points of force, length and
// pressure.
//
//   taut   r = F(L, p) - F_measured            slack   r = max(F(L, p), 0) - F_measured
//
// A slack point is censored: it says that the muscle does not pull, not how much it would push. So
// counts whatever is within the scatter of no force. Two passes: the first finds how far the points
// scatter (sigma, by its median), the second takes what is beyond 4 sigma for outliers and holds
// every parameter to its prior, (value - mean)/deviation x sigma, which counts less beyond 4
// deviations as a point does. Of several muscles the errors of their rest lengths are fitted as
// well (static_labels.h).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

struct StaticFit {
  StaticSetting setting;
  std::vector<Knob> knobs;
  Solution solution;          // of the knobs, of doubted rest lengths; residuals of points alone
  double scatter = 0;         // s [N]
  std::size_t outliers = 0;   // points beyond 4 s
  std::vector<Knob> unknown;  // that the data leave where the prior has them
};

// Returns the estimate of a muscle's error; null where its label is believed.
const Estimate* rest_length_estimate(const StaticFit& fit, double labelled);

// Returns the force at a length [m] at the pressure and on the branch of a point: below zero where
// the muscle would push  [N].
double law_force(const actuator::Actuator& a, double length, const StaticPoint& point,
                 double atmosphere);

// Force of a point, never negative  [N].
double predicted(const StaticSetting& setting, const StaticScales& scales,
                 const StaticPoint& point);

// predicted - measured, of all points.
std::vector<double> misses(const StaticSetting& setting, const StaticScales& scales,
                           std::span<const StaticPoint> points);

// Throws Refusal where there are too few points. `start`: a solution of the same knobs.
// `tolerance`: see SolverOptions.
StaticFit fit_static(const std::vector<Knob>& knobs, std::span<const StaticPoint> points,
                     const StaticScales& scales, const StaticFit* start = nullptr,
                     double tolerance = 1e-14);

// Returns the problem that such a fit has solved, for its profiles.
Refit refit_of(const StaticFit& fit, std::span<const StaticPoint> points,
               const StaticScales& scales);

// 2.3: the effectiveness of each nominal pressure by the ratio of sums, a parabola through them;
// the braid is the given one, or that of an ideal fit.
StaticFit fit_by_ratio(std::span<const StaticPoint> points, const StaticScales& scales);

}  // namespace sinew::identify
