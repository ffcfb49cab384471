// identify/actuator/static_law_fitter.h - fit and cross-validation of one static law on some
// points.
#pragma once

#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/actuator/static_spread.h"
#include "sinew/identify/contest/fit.h"

namespace sinew::identify {

// A muscle that was predicted by a fit to all others.
struct LeftOut {
  double rest_length = 0;  // [m]
  double largest = 0;      // force [N]
  HeldOutErrors errors;
  Score score;        // in % of its own largest force
  double square = 0;  // its term of rho^2, static_spread.h [-]
};

// A static law, to be fitted to points of these muscles by its own method. Keeps references to
// model and scales.
class StaticLawFitter {
 public:
  // Frees the additional parameters that several muscles and both branches require. Throws Refusal
  // if the points have too few lengths for the law.
  StaticLawFitter(const StaticModel& model, const StaticScales& scales,
                  const std::vector<StaticPoint>& points);

  // Returns the fit. `start` is a fit to more points, whose scatter is kept.
  StaticFit fit(const std::vector<StaticPoint>& points, const StaticFit* start = nullptr) const;

  // Predicts every part 0 ... parts - 1 of the points by a fit to all others. `part` is the part of
  // each point; points with -1 are always fitted.
  HeldOutErrors cross(const std::vector<StaticPoint>& points, const std::vector<int>& part,
                      int parts, const StaticFit& whole) const;

  // Predicts each muscle by a fit to all others, except those for which the others have too few
  // points or lengths. Scales and free parameters are set up from the others alone.
  std::vector<LeftOut> leave_out_muscles(const std::vector<StaticPoint>& points) const;

 private:
  // Throws Refusal if the other muscles have too few points or lengths.
  LeftOut leave_out(const std::vector<StaticPoint>& points, double muscle) const;

  const StaticModel& model_;
  const StaticScales& scales_;
  std::vector<FreeParameter> free_parameters_;
};

// Writes the cross-validation errors of the law into `fit`, in % of full_scale: pressures between
// the lowest and the highest in parts, lengths between the ends of each muscle one by one, and, if
// several, each muscle in turn; all kinds have equal weight (cross_validated). Ends that are left
// out are extrapolations, reported separately. `muscles` are those of leave_out_muscles(). Returns
// the distribution of the errors.
StaticSpread cross_validate(const StaticLawFitter& model, const std::vector<StaticPoint>& points,
                            const StaticFit& whole, const std::vector<LeftOut>& muscles,
                            double full_scale, Fit& fit);

}  // namespace sinew::identify
