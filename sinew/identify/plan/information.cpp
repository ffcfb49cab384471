#include "sinew/identify/plan/information.h"

#include <algorithm>
#include <limits>

namespace sinew::identify {

namespace {

Matrix rows_of_slopes(std::span<const PlannedReading> readings, std::size_t columns,
                      std::vector<double> PlannedReading::*what) {
  Matrix out(readings.size(), columns);
  for (std::size_t i = 0; i < readings.size(); ++i)
    for (std::size_t k = 0; k < columns; ++k) out(i, k) = (readings[i].*what)[k];
  return out;
}

}  // namespace

Information::Information(std::span<const double> deviations)
    : matrix_(deviations.size(), deviations.size()) {
  for (std::size_t i = 0; i < deviations.size(); ++i)
    matrix_(i, i) = 1 / (deviations[i] * deviations[i]);
}

// S^-1 = (1 - U (s^2 1 + U'U)^-1 U')/s^2, Woodbury's identity.
Information Information::of_mount(std::span<const PlannedReading> readings, double noise,
                                  std::size_t parameters) {
  Information out(std::vector<double>(parameters, std::numeric_limits<double>::infinity()));
  if (readings.empty()) return out;
  const std::size_t errors = readings.front().shared.size();
  const Matrix j = rows_of_slopes(readings, parameters, &PlannedReading::slopes);
  const Matrix told = transposed_product(j, j);
  Matrix shared(parameters, parameters);
  if (errors > 0) {
    const Matrix u = rows_of_slopes(readings, errors, &PlannedReading::shared);
    const Matrix across = transposed_product(u, j);
    Matrix inner = transposed_product(u, u);
    for (std::size_t i = 0; i < errors; ++i) inner(i, i) += noise * noise;
    shared = transposed_product(across, solved(inner, across));
  }
  for (std::size_t i = 0; i < parameters; ++i)
    for (std::size_t k = 0; k < parameters; ++k)
      out.matrix_(i, k) = (told(i, k) - shared(i, k)) / (noise * noise);
  return out;
}

Information& Information::operator+=(const Information& other) {
  for (std::size_t i = 0; i < parameters(); ++i)
    for (std::size_t k = 0; k < parameters(); ++k) matrix_(i, k) += other.matrix_(i, k);
  return *this;
}

std::vector<double> Information::variances(std::span<const std::vector<double>> places) const {
  std::vector<double> out(places.size(), std::numeric_limits<double>::infinity());
  const std::optional<Matrix> covariance = inverse_of_positive(matrix_, 1e-14);
  if (!covariance) return out;
  for (std::size_t i = 0; i < places.size(); ++i)
    out[i] = std::max(0.0, dot(product(*covariance, places[i]), places[i]));
  return out;
}

}  // namespace sinew::identify
