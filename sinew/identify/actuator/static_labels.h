// identify/actuator/static_labels.h - rest lengths that may be labelled wrong, of several muscles
// of one make: where the fittings begin is a matter of taste, and a ruler has its error.
//
//   F = F(L', p; L_0 + e_L)    L' = L_0 + e_L at the mount that is labelled as the rest length,
//                              L at the others
//
//   e_L                        error of the label, positive where it is too short,
//                              0 +- (0.5 mm and 0.5 % of L_0) beforehand [m]
//   sum e_L/L_0 = 0 +- 0.1 %   an error that all labels share is the law's error at rest, not one
//                              of labels
//
// Both are priors that count less where the data insist, as all of them do (static_fit.h). As the
// common part is held, an error is one beside the other muscles: its interval is wider by what the
// mean of so many labels may be off. A label is doubted where the muscle has a mount at rest and
// another one, none of them within 2 % of the label: of a sweep in small steps nobody can say which
// of its lengths the label's error is in. One muscle alone has no e_L.
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Standard deviation of sum delta/L_0 beforehand  [-].
inline constexpr double common_deviation = 1e-3;

// Returns the standard deviation that delta has before the data are looked at  [m].
double rest_length_deviation(double labelled);

// Is a length labelled as the rest length, within 0.2 %?
bool at_rest(double length, double rest_length);

// Gives one value to labels that are the same within a micrometre, as 283 mm and 0.283 m are.
void unite_labels(std::vector<StaticPoint>& points);

// Returns the muscles of the points in their order, no error in any; bounds where it is doubted.
std::vector<RestLengthError> labels_of(std::span<const StaticPoint> points);

// Returns how delta is searched. Its name is "rest_length_error_225mm".
Parameter parameter_of(const RestLengthError& label);
inline constexpr std::string_view rest_length_error = "rest_length_error_";

// Widens the interval of a label's error by what the labels of all may be off together, of
// `freedom`.
void widen_by_common(std::span<const RestLengthError> labels, const RestLengthError& label,
                     int freedom, Estimate& estimate);

// Returns the length of a point with its muscle's error, which a mount at rest has as well  [m].
double fitted_length(const StaticSetting& setting, const StaticPoint& point);

}  // namespace sinew::identify
