#include "sinew/identify/actuator/static_widen.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace sinew::identify {

void widen(const Residuals& residuals, std::span<const Parameter> parameters, std::size_t count,
           std::size_t points, double scatter, double outlier, Solution& solution) {
  const auto n = static_cast<Eigen::Index>(solution.values.size());
  const auto rows = static_cast<Eigen::Index>(count);
  if (n == 0) return;
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows, n);
  std::vector<double> at = solution.values, up(count), down(count);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (solution.estimates[k].at_bound) continue;
    const double h = 1e-5 * parameters[k].scale;
    at[k] = solution.values[k] + h;
    residuals(at, up);
    at[k] = solution.values[k] - h;
    residuals(at, down);
    at[k] = solution.values[k];
    for (Eigen::Index r = 0; r < rows; ++r) {
      const auto row = static_cast<std::size_t>(r);
      j(r, i) = (up[row] - down[row]) / (2e-5);  // per scale
    }
  }
  const Eigen::MatrixXd inverse =
      (j.transpose() * j).completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd pull = j * inverse;
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const bool point = r < static_cast<Eigen::Index>(points);
    double off = point ? solution.residuals[static_cast<std::size_t>(r)] : scatter;
    off = std::clamp(off, -outlier * scatter, outlier * scatter);
    const double leverage = point ? pull.row(r).dot(j.row(r)) : 0;
    off /= std::max(0.2, 1 - leverage);
    meat += off * off * pull.row(r).transpose() * pull.row(r);
  }
  const double t = t_quantile(std::max(1, solution.freedom));
  for (Eigen::Index i = 0; i < n; ++i) {
    Estimate& e = solution.estimates[static_cast<std::size_t>(i)];
    const double scale = parameters[static_cast<std::size_t>(i)].scale;
    const double own = std::sqrt(meat(i, i)) * scale;
    if (e.at_bound || !(own > e.standard_error)) continue;
    e.standard_error = own;
    e.low = e.value - t * own;
    e.high = e.value + t * own;
    e.identifiable = t * own <= std::max(std::abs(e.value), scale);
  }
}

}  // namespace sinew::identify
