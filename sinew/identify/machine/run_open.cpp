#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/fit/matrix.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

std::vector<std::string> open_directions(RunJudged& judged, std::span<const Parameter> parameters) {
  constexpr double half_width = 1.96, part = 0.2;
  const std::size_t n = parameters.size();
  const auto size = [&](std::size_t i) {
    return std::max(std::abs(judged.estimates[i].value), parameters[i].scale);
  };
  const auto wide = [&](std::size_t i) {
    const Estimate& e = judged.estimates[i];
    return !(0.5 * (e.high - e.low) <= size(i));
  };
  std::vector<std::string> out;
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < n; ++i) {
    judged.estimates[i].identifiable = !wide(i);
    if (std::isfinite(judged.estimates[i].standard_error))
      seen.push_back(i);
    else
      out.push_back(parameters[i].name + ": only together with others");
  }
  // The axes of what is uncertain, each number in its own size.
  const std::size_t m = seen.size();
  Matrix c(m, m);
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t b = 0; b < m; ++b) {
      const std::size_t i = seen[a], k = seen[b];
      c(a, b) = judged.covariance[i * n + k] / (size(i) * size(k));
    }
  const Axes axes = axes_of_positive(c);
  std::vector<bool> told(n, false);
  for (std::size_t a = m; a-- > 0;) {
    if (!(half_width * std::sqrt(axes.values[a]) > 0.5)) continue;
    std::string words;
    bool is_open = false;
    std::vector<std::size_t> members;
    for (std::size_t b = 0; b < m; ++b) {
      const double share = axes.axes(b, a);
      if (std::abs(share) < part) continue;
      const std::size_t i = seen[b];
      members.push_back(i);
      is_open = is_open || wide(i);
      words += fmt::format("{}{:.2g} {}/({:.3g} {})",
                           words.empty() ? (share < 0 ? "-" : "") : (share < 0 ? " - " : " + "),
                           std::abs(share), parameters[i].name, size(i), parameters[i].unit);
    }
    if (!is_open) continue;
    for (const std::size_t i : members) told[i] = true;
    out.push_back(words);
  }
  for (const std::size_t i : seen)
    if (wide(i) && !told[i])
      out.push_back(parameters[i].name + ": its interval is wider than it is large");
  return out;
}

}  // namespace sinew::identify
