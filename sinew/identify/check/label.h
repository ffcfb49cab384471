// identify/check/label.h - fit of a static law with one labelled length as an unknown, to test
// whether the label is wrong.
//
//   F = (1 + g) F(L', p; L0')      L0' = L0 + d     L' = L0' at the mount at rest, L at the others
//
//   L0, L  rest length and mount as labelled [m]   d  error of the label, positive if too short [m]
//   g  relative force of a muscle compared with others of its make, 0 +- 0.1 [-]
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"
#include "sinew/identify/check/check.h"

namespace sinew::identify {

// The doubted label: that of a muscle's rest length, or of one of its mounts.
struct DoubtedLabel {
  double rest_length = 0;       // rest length of the muscle, as labelled [m]
  std::optional<double> mount;  // [m]
};

// Result of a fit.
struct LabelFit {
  double rms = 0;                  // misfit as a share of each muscle's largest force [-]
  double shift = 0;                // d [m]; 0 if no label is doubted
  double error = 0;                // standard error of d [m]; infinite: not determined
  std::vector<double> law, gains;  // values of the free parameters, g of each muscle
};

// Returns a reduced set of points: at most six pressures of each curve of one muscle, length and
// branch, readings at one pressure averaged.
std::vector<StaticPoint> few_points(const std::vector<StaticPoint>& points);

// Fits the law to the points of one or several muscles, in the order of few_points(). Throws
// Refusal if there are fewer points than unknowns.
LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere);

// Fits the law with a doubted label, starting from the fit without doubt.
LabelFit fit_labels(const std::vector<StaticPoint>& points,
                    const std::vector<FreeParameter>& free_parameters, double atmosphere,
                    const DoubtedLabel& doubted, const LabelFit& from);

// --- checks ---

// Adds checks of the labels of muscles and mounts. Two kinds of evidence:
//
//   - Within a muscle, the mount at rest pulls like another length would, compared with the others.
//   - Among muscles of one make, one fits the others' law only with another rest length.
//
// Each gives a suspicion only: a law that fits better with another length may also be too simple.
// The other length must explain a large part of the misfit, beyond its interval, and differ by more
// than 1 %. For two muscles the comparison cannot show which one is mislabelled, and is not made.
void add_label_checks(const StaticData& data, double atmosphere, std::vector<Check>& out);

}  // namespace sinew::identify
