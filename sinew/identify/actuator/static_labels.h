// identify/actuator/static_labels.h - errors in the labelled rest lengths of several muscles of one
// make: where the fittings begin is a matter of convention, and rulers are not exact.
//
//   F = F(L', p; L_0 + e_L)    L' = L_0 + e_L at the mount that is labelled as the rest length,
//                              L at the others
//
//   e_L                        error of the label, positive where it is too short,
//                              0 +- (0.5 mm and 0.5 % of L_0) beforehand [m]
//   sum e_L/L_0 = 0 +- 0.1 %   an error that all labels share is the law's error at rest, not one
//                              of labels
//
// Both are priors, with less weight if the data contradict them strongly (static_fit.h). As the
// common part is fixed, an error is relative to the other muscles: its interval includes the
// uncertainty of the labels' mean. A label is fitted if the muscle has a mount at rest and another
// mount, and none of the others is within 2 % of the label: in a sweep of small steps the error
// cannot be assigned to one length. A single muscle has no e_L.
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Prior standard deviation of sum e_L/L_0 [-].
inline constexpr double common_deviation = 1e-3;

// Returns the prior standard deviation of e_L [m].
double rest_length_deviation(double labelled);

// Returns whether a length equals the labelled rest length within 0.2 %.
bool at_rest(double length, double rest_length);

// Makes labels that agree within a micrometre equal, such as 283 mm and 0.283 m.
void unite_labels(std::vector<StaticPoint>& points);

// Returns the muscles of the points in their order, with zero error, and with bounds if fitted.
std::vector<RestLengthError> labels_of(std::span<const StaticPoint> points);

// Returns the search parameter of e_L, named like "rest_length_error_225mm".
Parameter parameter_of(const RestLengthError& label);
inline constexpr std::string_view rest_length_error = "rest_length_error_";

// Widens the interval of a label's error by the common uncertainty of all labels. `freedom`:
// degrees of freedom of the fit.
void widen_by_common(std::span<const RestLengthError> labels, const RestLengthError& label,
                     int freedom, Estimate& estimate);

// Returns the length of a point, corrected by its muscle's error if it is the mount at rest [m].
double fitted_length(const StaticSetting& setting, const StaticPoint& point);

}  // namespace sinew::identify
