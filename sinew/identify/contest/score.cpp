#include "sinew/identify/contest/score.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sinew::identify {

Score score(std::span<const double> residuals, double full_scale) {
  Score out{.points = residuals.size()};
  double sum = 0;
  for (const double r : residuals) {
    sum += r * r;
    out.max = std::max(out.max, std::abs(r));
  }
  if (!residuals.empty()) out.rmse = std::sqrt(sum / static_cast<double>(residuals.size()));
  if (full_scale > 0) {
    out.rmse_percent = 100 * out.rmse / full_scale;
    out.max_percent = 100 * out.max / full_scale;
  }
  return out;
}

Score score(std::span<const double> residuals, double full_scale,
            std::span<const double> measured) {
  Score out = score(residuals, full_scale);
  if (measured.empty()) return out;
  const auto n = static_cast<double>(measured.size());
  double mean = 0, left = 0, mean_left = 0;
  for (const double y : measured) mean += y / n;
  for (const double r : residuals) left += r * r, mean_left += r / n;
  double all = 0, predicted = 0, both = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double y = measured[i] - mean, x = y + residuals[i] - mean_left;
    all += y * y;
    predicted += x * x;
    both += x * y;
  }
  if (!(all > 0)) return out;
  const auto [least, most] = std::ranges::minmax(measured);
  out.explained = 1 - left / all;
  out.nrmse = out.rmse / (most - least);
  if (predicted > 0) out.correlation = both / std::sqrt(all * predicted);
  return out;
}

double half_width_of(std::span<const double> residuals, double chance) {
  std::vector<double> sorted;
  for (const double r : residuals) sorted.push_back(std::abs(r));
  std::ranges::sort(sorted);
  const double rank = std::ceil(chance * static_cast<double>(sorted.size() + 1));
  return sorted[std::min(static_cast<std::size_t>(rank), sorted.size()) - 1];
}

std::optional<Band> band_of(std::span<const double> left_out, std::string where) {
  constexpr std::size_t least = 19;
  if (left_out.size() < least) return std::nullopt;
  return Band{half_width_of(left_out, 0.68), half_width_of(left_out, 0.95), std::move(where)};
}

ErrorBy error_by(std::string what, std::string unit, std::span<const double> residuals,
                 std::span<const int> part, std::span<const double> value, double full_scale) {
  struct Part {
    std::vector<double> residuals;
    double first = 0, sum = 0;  // first value, and sum of the differences from it
  };
  std::map<int, Part> parts;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    Part& rows = parts[part[i]];
    rows.residuals.push_back(residuals[i]);
    if (rows.residuals.size() == 1) rows.first = value[i];
    rows.sum += value[i] - rows.first;
  }
  ErrorBy out{.what = std::move(what), .unit = std::move(unit), .parts = {}};
  for (const auto& [number, rows] : parts)
    out.parts.push_back(
        {.name = "",
         .value = rows.first + rows.sum / static_cast<double>(rows.residuals.size()),
         .score = score(rows.residuals, full_scale)});
  return out;
}

}  // namespace sinew::identify
