// identify/actuator/static_outliers.h - points of which no law can be true: a slipped decimal, a
// doubled force. They would decide which model is chosen, so they are left out before one is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// A point that no law explains, and what the law of the others has in its place.
struct Outlier {
  std::size_t point = 0;  // its index
  double law = 0;         // force of that law there [N]
  std::string why;        // what would explain it (static_explain.h)
};

// Points that are wrong, and how far from the law a point may lie  [N].
struct Outliers {
  std::vector<Outlier> points;
  double limit = 0, scatter = 0;
};

// Returns points further from a law than 8 scatters and 5 % of the largest force. The law is the
// one that most points lie closest to: of all models, fitted with outliers counting little, the one
// with the smallest median distance. None where they would be more than one in ten: then it is not
// the points that are wrong.
Outliers gross_outliers(const std::vector<StaticPoint>& points, const StaticScales& scales);

}  // namespace sinew::identify
