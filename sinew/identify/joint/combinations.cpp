#include "sinew/identify/joint/combinations.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string_view>

namespace sinew::identify {

namespace {

// Not of its sensors, and not of its friction.
bool of_the_joint(std::string_view name) {
  for (const std::string_view other : {"torque_", "friction", "damping", "delay"})
    if (name.starts_with(other)) return false;
  return true;
}

}  // namespace

std::vector<Combination> combinations_of(const Solution& s) {
  std::vector<Eigen::Index> which;
  const std::size_t n = s.estimates.size();
  for (std::size_t i = 0; i < n; ++i)
    if (s.estimates[i].value > 0 && s.estimates[i].free && of_the_joint(s.estimates[i].name) &&
        !s.estimates[i].at_bound && s.estimates[i].name != "c1")
      which.push_back(static_cast<Eigen::Index>(i));
  const auto m = static_cast<Eigen::Index>(which.size());
  Eigen::MatrixXd relative(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto a = static_cast<std::size_t>(which[static_cast<std::size_t>(i)]);
      const auto b = static_cast<std::size_t>(which[static_cast<std::size_t>(k)]);
      relative(i, k) = s.covariance[a * n + b] / (s.values[a] * s.values[b]);
    }
  std::vector<Combination> out;
  if (!relative.allFinite()) {
    for (const std::string& text : s.unseen) out.push_back({text, unbounded});
    return out;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(relative);
  for (Eigen::Index k = 0; k < m; ++k) {
    Combination c;
    Eigen::VectorXd v = axes.eigenvectors().col(k);
    Eigen::Index largest_power = 0;
    v.cwiseAbs().maxCoeff(&largest_power);
    if (v[largest_power] < 0) v = -v;
    for (Eigen::Index i = 0; i < m; ++i)
      if (std::abs(v[i]) > 0.05)
        c.text += fmt::format(
            "{}{}^{:.2f}", c.text.empty() ? "" : " ",
            s.estimates[static_cast<std::size_t>(which[static_cast<std::size_t>(i)])].name, v[i]);
    c.relative_error =
        t_quantile(std::max(1, s.freedom)) * std::sqrt(std::max(0.0, axes.eigenvalues()[k]));
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace sinew::identify
