// identify/actuator/static_tried.h - one static law on some points: its fit, and what it makes of
// points that it did not see.
#pragma once

#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/actuator/static_spread.h"
#include "sinew/identify/fit/fit.h"

namespace sinew::identify {

// A muscle that was predicted by a fit to all others.
struct LeftOut {
  double rest_length = 0;  // [m]
  double largest = 0;      // force [N]
  Unseen unseen;
  Score score;  // in % of its own largest force
};

// A law that is fitted to points of these muscles, by its own way. Model and scales outlive it.
class Tried {
 public:
  // Sets free what several muscles and both branches need besides. Throws Refusal where the points
  // have too few lengths for the law.
  Tried(const StaticModel& model, const StaticScales& scales,
        const std::vector<StaticPoint>& points);

  // Returns the fit; `start` is one of more points, whose scatter is kept.
  StaticFit fit(const std::vector<StaticPoint>& points, const StaticFit* start = nullptr) const;

  // Returns every part 0 ... parts - 1 of the points as a fit to all others predicts it. `part` has
  // a number for each point; -1 is always fitted.
  Unseen cross(const std::vector<StaticPoint>& points, const std::vector<int>& part, int parts,
               const StaticFit& whole) const;

  // Returns each muscle as a fit to all others predicts it; not those for which the others are too
  // few points or lengths. The law is set up anew each time, as if the muscle had never been there.
  std::vector<LeftOut> leave_out_muscles(const std::vector<StaticPoint>& points) const;

  // Returns the scales that a fit is computed with: 2.3 has found its own braid.
  StaticScales scales_of_fit(const StaticFit& fit) const;

 private:
  bool by_ratio() const;
  // Throws Refusal where the other muscles are too few points or lengths.
  LeftOut leave_out(const std::vector<StaticPoint>& points, double muscle) const;

  const StaticModel& model_;
  const StaticScales& scales_;
  std::vector<Knob> knobs_;
};

// Writes into `fit` what the law makes of points that it did not see, in % of full_scale: pressures
// between the lowest and the highest in parts, lengths between the ends of each muscle one by one,
// and, of several muscles, each muscle once; all kinds alike (cross_validated). To leave out
// an end is to extrapolate: that is told apart. `muscles` are those of leave_out_muscles(). Returns
// how far off it was.
StaticSpread cross_validate(const Tried& model, const std::vector<StaticPoint>& points,
                            const StaticFit& whole, const std::vector<LeftOut>& muscles,
                            double full_scale, Fit& fit);

}  // namespace sinew::identify
