#include "sinew/identify/actuator/static_widen.h"

#include <algorithm>
#include <cmath>

#include "sinew/identify/fit/matrix.h"

namespace sinew::identify {

void widen(const Residuals& residuals, std::span<const Parameter> parameters, std::size_t count,
           std::size_t points, double scatter, double outlier, Solution& solution) {
  const std::size_t n = solution.values.size();
  if (n == 0) return;
  Matrix j(count, n);
  std::vector<double> at = solution.values, up(count), down(count);
  for (std::size_t i = 0; i < n; ++i) {
    if (solution.estimates[i].at_bound) continue;
    const double h = 1e-5 * parameters[i].scale;
    at[i] = solution.values[i] + h;
    residuals(at, up);
    at[i] = solution.values[i] - h;
    residuals(at, down);
    at[i] = solution.values[i];
    for (std::size_t r = 0; r < count; ++r) j(r, i) = (up[r] - down[r]) / 2e-5;  // per scale
  }
  const Matrix pull = product(j, inverse_where_seen(transposed_product(j, j)));
  std::vector<double> variance(n);  // one per parameter, in its scale
  for (std::size_t r = 0; r < count; ++r) {
    const bool point = r < points;
    double off = point ? solution.residuals[r] : scatter;
    off = std::clamp(off, -outlier * scatter, outlier * scatter);
    double leverage = 0;
    for (std::size_t i = 0; point && i < n; ++i) leverage += pull(r, i) * j(r, i);
    off /= std::max(0.2, 1 - leverage);
    for (std::size_t i = 0; i < n; ++i) variance[i] += off * off * pull(r, i) * pull(r, i);
  }
  const double t = t_quantile(std::max(1, solution.freedom));
  for (std::size_t i = 0; i < n; ++i) {
    Estimate& e = solution.estimates[i];
    const double scale = parameters[i].scale;
    const double own = std::sqrt(variance[i]) * scale;
    if (e.at_bound || !(own > e.standard_error)) continue;
    e.standard_error = own;
    e.low = e.value - t * own;
    e.high = e.value + t * own;
    e.identifiable = t * own <= std::max(std::abs(e.value), scale);
  }
}

}  // namespace sinew::identify
