#include "sinew/identify/joint/combinations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sinew/identify/fit/matrix.h"

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
  std::vector<std::size_t> which;
  const std::size_t n = s.estimates.size();
  for (std::size_t i = 0; i < n; ++i)
    if (s.estimates[i].value > 0 && s.estimates[i].free && of_the_joint(s.estimates[i].name) &&
        !s.estimates[i].at_bound && s.estimates[i].name != "c1")
      which.push_back(i);
  const std::size_t m = which.size();
  Matrix relative(m, m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k)
      relative(i, k) =
          s.covariance[which[i] * n + which[k]] / (s.values[which[i]] * s.values[which[k]]);
  std::vector<Combination> out;
  if (!relative.is_finite()) {
    for (const std::string& text : s.unseen) out.push_back({text, unbounded});
    return out;
  }
  const Axes axes = axes_of_positive(relative);
  for (std::size_t k = 0; k < m; ++k) {
    Combination c;
    const std::span<const double> power = axes.axes.column(k);
    const double largest =
        *std::ranges::max_element(power, {}, [](double x) { return std::abs(x); });
    const double sign = largest < 0 ? -1 : 1;
    for (std::size_t i = 0; i < m; ++i)
      if (std::abs(power[i]) > 0.05)
        c.text += fmt::format("{}{}^{:.2f}", c.text.empty() ? "" : " ", s.estimates[which[i]].name,
                              sign * power[i]);
    c.relative_error = t_quantile(std::max(1, s.freedom)) * std::sqrt(axes.values[k]);
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace sinew::identify
