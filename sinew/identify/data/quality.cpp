#include "sinew/identify/data/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "sinew/identify/contest/refusal.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

namespace {

// Returns the number of samples in plateaus of at least `shortest` equal samples at `extreme`.
std::size_t in_plateaus(std::span<const double> values, double extreme, std::size_t shortest) {
  std::size_t total = 0, run = 0;
  const auto close = [&] {
    if (run >= shortest) total += run;
    run = 0;
  };
  for (const double v : values) {
    if (v == extreme) {
      ++run;
    } else {
      close();
    }
  }
  close();
  return total;
}

// Returns the share of neighbouring samples that differ, away from both extremes.
double restlessness(std::span<const double> values, double low, double high) {
  std::size_t pairs = 0, different = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] == low || values[i] == high) continue;
    ++pairs;
    if (values[i] != values[i - 1]) ++different;
  }
  return pairs == 0 ? 0 : static_cast<double>(different) / static_cast<double>(pairs);
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

double smallest(std::span<const double> values) {
  return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}

double largest(std::span<const double> values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

double median(std::span<const double> values) { return median_of({values.begin(), values.end()}); }

std::vector<double> running_medians(std::span<const double> values, std::size_t reach) {
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t near = std::min({reach, i, values.size() - 1 - i});
    out.push_back(median(values.subspan(i - near, 2 * near + 1)));
  }
  return out;
}

std::vector<double> steps_of(std::span<const double> values) {
  std::vector<double> out;
  for (std::size_t i = 1; i < values.size(); ++i) out.push_back(values[i] - values[i - 1]);
  return out;
}

double spread(std::span<const double> values) {
  const double center = median(values);
  std::vector<double> distances;
  for (const double v : values) distances.push_back(std::abs(v - center));
  return 1.4826 * median_of(std::move(distances));
}

std::vector<std::size_t> outliers(std::span<const double> residuals, double at_least) {
  std::vector<std::size_t> out;
  if (residuals.size() < 5) return out;
  const double center = median(residuals), limit = std::max(8 * spread(residuals), at_least);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (std::abs(residuals[i] - center) > limit) out.push_back(i);
  return out;
}

Clipping clipping(std::span<const double> values, std::size_t shortest) {
  Clipping out{.top = largest(values), .bottom = smallest(values)};
  if (values.size() < 2 * shortest || out.top == out.bottom) return out;
  if (restlessness(values, out.bottom, out.top) < 0.5) return out;
  if (out.top != 0) out.at_top = in_plateaus(values, out.top, shortest);
  if (out.bottom != 0) out.at_bottom = in_plateaus(values, out.bottom, shortest);
  out.clipped = out.at_top + out.at_bottom > 0;
  return out;
}

std::string in_unit_of_file(const Measured& data, std::string_view column, double value,
                            int digits) {
  const auto at = std::ranges::find(data.columns, column, &Column::name);
  if (at == data.columns.end()) return fmt::format("{:.{}g}", value, digits);
  const std::string& shown = at->shown.empty() ? at->unit : at->shown;
  return units::format_quantity(value, at->unit, shown, digits);
}

void refuse_constant(const Measured& data, std::string_view column, double tolerance,
                     std::string_view why, std::string_view try_this) {
  const std::vector<double>& values = data[column];
  const double low = smallest(values), high = largest(values);
  if (high - low > tolerance) return;
  throw Refusal(fmt::format("{}: {}", data.file, column),
                fmt::format("{} throughout", in_unit_of_file(data, column, low, 4)),
                std::string(why), std::string(try_this));
}

void refuse_clipped(const Measured& data, std::string_view column, std::string_view try_this) {
  const Clipping c = clipping(data[column]);
  if (!c.clipped) return;
  const bool top = c.at_top >= c.at_bottom;
  throw Refusal(fmt::format("{}: {}", data.file, column),
                fmt::format("{} samples that stay at {}: the sensor or its converter is at its end",
                            top ? c.at_top : c.at_bottom,
                            in_unit_of_file(data, column, top ? c.top : c.bottom, 5)),
                "readings within its range", std::string(try_this));
}

Measured each_row_once(Measured m, std::vector<bool>* of_rows) {
  if (m.has("time")) return m;
  std::vector<bool> none, &kinds = of_rows ? *of_rows : none;
  std::vector<std::size_t> order(m.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto compared = [&](std::size_t a, std::size_t b) {
    if (!kinds.empty() && kinds[a] != kinds[b]) return kinds[a] ? 1 : -1;
    for (const Column& c : m.columns)
      if (c.values[a] != c.values[b]) return c.values[a] > c.values[b] ? 1 : -1;
    return 0;
  };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const int sign = compared(a, b);
    return sign == 0 ? a < b : sign < 0;
  });
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || compared(order[i - 1], order[i]) != 0) first.push_back(order[i]);
  const std::size_t repeated = m.rows() - first.size();
  if (repeated == 0) return m;
  std::ranges::sort(first);
  m = m.subset(first);
  std::vector<bool> left;
  for (const std::size_t row : first)
    if (!kinds.empty()) left.push_back(kinds[row]);
  kinds = std::move(left);
  m.notes.push_back(fmt::format("{} rows repeat earlier ones: each counts once", repeated));
  return m;
}

}  // namespace sinew::identify
