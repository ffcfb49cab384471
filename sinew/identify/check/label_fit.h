// identify/check/label_fit.h - a static law that is fitted with one length as an unknown: how well
// do the points go together if a label is not believed?
//
//   F = (1 + g) F(L', p; L0')      L0' = L0 + d     L' = L0' at the mount at rest, L at the others
//
//   L0, L  rest length and mount as labelled [m]   d  what the label is short by [m]
//   g  force of a muscle beside others of its make, 0 +- 0.1 [-]
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Which label is not believed: that of a muscle's rest length, or of one of its mounts alone.
struct DoubtedLabel {
  double rest_length = 0;       // of the muscle, as labelled [m]
  std::optional<double> mount;  // [m]
};

// What a fit leaves, and the label that it would like to have.
struct LabelFit {
  double rms = 0;                  // in shares of each muscle's largest force [-]
  double shift = 0;                // d [m]; 0 where no label is doubted
  double error = 0;                // its standard error [m]; infinite: the points say nothing of it
  std::vector<double> law, gains;  // values of the knobs, g of each muscle
};

// Returns few points that stand for many: of each curve of one muscle, length and branch at most
// six pressures, what was read at one averaged.
std::vector<StaticPoint> few_points(const std::vector<StaticPoint>& points);

// Fits the law to the points of one or several muscles, in the order of few_points(). Throws
// Refusal where there are fewer points than unknowns.
LabelFit fit_labels(const std::vector<StaticPoint>& points, const std::vector<Knob>& knobs,
                    double atmosphere);

// The same with a label that is not believed, from the fit that believes it.
LabelFit fit_labels(const std::vector<StaticPoint>& points, const std::vector<Knob>& knobs,
                    double atmosphere, const DoubtedLabel& doubted, const LabelFit& from);

}  // namespace sinew::identify
