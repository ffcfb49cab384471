// identify/actuator/static_outliers.h - points of which no law can be true: a slipped decimal, a
// doubled force. They would decide which model is chosen, so they are left out before one is.
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Indices of points further from a law than 8 scatters and 5 % of the largest force. The law is the
// one that most points lie closest to: of all models, fitted with outliers counting little, the one
// with the smallest median distance. Empty where they would be more than one in ten: then it is not
// the points that are wrong.
std::vector<std::size_t> gross_outliers(const std::vector<StaticPoint>& points,
                                        const StaticScales& scales);

}  // namespace sinew::identify
