// identify/actuator/static_fit.h - one static model, fitted to points of force, length and
// pressure.
//
//   taut   r = F(L, p) - F_measured            slack   r = max(F(L, p), 0) - F_measured
//
// A slack point is censored: it says that the muscle does not pull, not how much it would push. So
// counts whatever is within the scatter of no force. Two passes: the first finds how far the points
// scatter (s, by its median), the second takes what is beyond 4 s for outliers and holds every
// parameter to its prior, (value - mean)/deviation x s. Of several muscles the errors of their rest
// lengths are fitted as well (static_model.h), with sum d/L_0 = 0 +- 0.1 %: what all labels have in
// common is what the law misses at rest, not a label's error.
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Begins the names of estimates of rest lengths' errors; the labelled length follows, "225mm".
inline constexpr std::string_view rest_length_error = "rest_length_error_";

struct StaticFit {
  StaticSetting setting;
  std::vector<Knob> knobs;
  Solution solution;          // of the knobs, of the rest lengths; residuals of the points alone
  double scatter = 0;         // s [N]
  std::size_t outliers = 0;   // points beyond 4 s
  std::vector<Knob> unknown;  // that the data leave where the prior has them
};

// Returns the length of a point with its muscle's error: where it is labelled as the rest length,
// the one error is the other's  [m].
double fitted_length(const StaticSetting& setting, const StaticPoint& point);

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

// 2.3: the effectiveness of each nominal pressure by the ratio of sums, a parabola through them;
// the braid is the given one, or that of an ideal fit.
StaticFit fit_by_ratio(std::span<const StaticPoint> points, const StaticScales& scales);

}  // namespace sinew::identify
