#include "sinew/identify/data/averaged.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

// Group of each row; groups are numbered from 0 in the order of the rows.
struct RowGroups {
  std::vector<std::size_t> of_row;
  std::size_t count = 0;
};

// A column by which rows are grouped: a quantity by cells of its range, a label by its value.
struct Setting {
  std::span<const double> values;
  bool is_label = false;
};

// Returns groups of rows with the same labels and the same cell of each quantity, whose range is
// divided into `steps` cells.
RowGroups cells_of(const std::vector<Setting>& settings, std::size_t rows, double steps) {
  RowGroups out{std::vector<std::size_t>(rows), 1};
  for (const auto& [values, is_label] : settings) {
    const double low = smallest(values), width = (largest(values) - low) / steps;
    std::map<std::pair<std::size_t, double>, std::size_t> groups;
    for (std::size_t row = 0; row < rows; ++row) {
      const double cell = is_label    ? values[row]
                          : width > 0 ? std::round((values[row] - low) / width)
                                      : 0;
      const std::pair key(out.of_row[row], cell);
      out.of_row[row] = groups.try_emplace(key, groups.size()).first->second;
    }
    out.count = groups.size();
  }
  return out;
}

// Returns 1 for rows at which the values rise and -1 where they fall: after a turn, from a fiftieth
// of their range on. Empty if less than a tenth of the rows rise, or fall.
std::vector<double> directions_of(std::span<const double> values) {
  const double least = 0.02 * (largest(values) - smallest(values));
  std::vector<double> out;
  double extreme = values[0], way = 1;
  for (const double x : values) {
    if (way * (x - extreme) > 0) extreme = x;
    if (way * (extreme - x) > least) way = -way, extreme = x;
    out.push_back(way);
  }
  const auto rising = static_cast<std::size_t>(std::ranges::count(out, 1.0));
  if (10 * std::min(rising, out.size() - rising) < out.size()) out.clear();
  return out;
}

std::vector<double> rows_in(const RowGroups& groups) {
  std::vector<double> out(groups.count);
  for (const std::size_t group : groups.of_row) ++out[group];
  return out;
}

double variance(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, sum = 0;
  for (const double x : values) mean += x / n;
  for (const double x : values) sum += (x - mean) * (x - mean) / n;
  return sum;
}

// Returns how many of a series' values are independent; at most `blocks` averages are compared.
double independent(std::span<const double> series) {
  constexpr std::size_t blocks = 1000;
  const std::size_t n = series.size(), each = 1 + (n - 1) / blocks;
  std::vector<double> means(n / each);
  for (std::size_t i = 0; i < means.size() * each; ++i)
    means[i / each] += series[i] / static_cast<double>(each);
  const double size = variance(series);
  if (means.size() < 2 || !(size > 0)) return 1;
  const double rows_per_one =
      static_cast<double>(each) * variance(means) / size * inflation_of(means);
  return std::max(1.0, static_cast<double>(n) / std::max(1.0, rows_per_one));
}

// Returns the values of each group, in the order of the rows.
std::vector<std::vector<double>> values_in(const RowGroups& groups,
                                           std::span<const double> values) {
  std::vector<std::vector<double>> out(groups.count);
  for (std::size_t row = 0; row < values.size(); ++row)
    out[groups.of_row[row]].push_back(values[row]);
  return out;
}

// Replaces the rows by the averages of their groups, with the line of the group's first row.
void average(const RowGroups& groups, Measured& data) {
  const std::vector<double> count = rows_in(groups);
  std::vector<int> lines;
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (groups.of_row[row] == lines.size()) lines.push_back(data.lines[row]);
  for (Column& c : data.columns) {
    std::vector<double> mean(groups.count);
    for (std::size_t row = 0; row < data.rows(); ++row)
      mean[groups.of_row[row]] += c.values[row] / count[groups.of_row[row]];
    c.values = std::move(mean);
  }
  data.lines = std::move(lines);
}

}  // namespace

Measured settings_averaged(Measured data, std::string_view response, std::vector<bool>* of_rows) {
  std::vector<bool> none, &kinds = of_rows ? *of_rows : none;
  const std::size_t rows = data.rows();
  if (data.has("time") || rows <= most_rows) return data;
  std::vector<Setting> settings;
  for (const Column& c : data.columns)
    if (c.name != response)
      settings.push_back({c.values, c.name == "rest_length" || c.name == "branch"});
  const std::vector<double> kind(kinds.begin(), kinds.end());
  if (!kinds.empty()) settings.push_back({kind, true});
  std::vector<double> direction;
  if (data.has("pressure") && !data.has("branch")) direction = directions_of(data["pressure"]);
  if (!direction.empty()) settings.push_back({direction, true});
  constexpr double finest = 4096;
  double steps = finest;
  RowGroups groups = cells_of(settings, rows, steps);
  while (groups.count > averaged_rows && steps > 2) groups = cells_of(settings, rows, steps /= 2);
  std::vector<double> weights = rows_in(groups), variances(groups.count);
  double squares = 0, sum = 0, top = 0;
  if (data.has(response)) {
    const std::vector<std::vector<double>> responses = values_in(groups, data[response]);
    for (std::size_t g = 0; g < groups.count; ++g) {
      variances[g] = variance(responses[g]);
      squares += weights[g] * variances[g];
      if (steps == finest) weights[g] = independent(responses[g]);
    }
    top = largest(data[response]);
  }
  for (const double w : weights) sum += w;
  const double counted = std::min(sum, static_cast<double>(most_rows));
  for (double& w : weights) w *= counted / sum;
  const double freedom = static_cast<double>(rows - groups.count);
  const double scatter = freedom > 0 && top > 0 ? std::sqrt(squares / freedom) / top : 0;
  average(groups, data);
  data.weights = std::move(weights);
  data.variances = std::move(variances);
  if (!kinds.empty()) {
    std::vector<bool> of_group(groups.count);
    for (std::size_t row = 0; row < rows; ++row) of_group[groups.of_row[row]] = kinds[row];
    kinds = std::move(of_group);
  }
  data.notes.push_back(fmt::format(
      "{} rows are averaged to {} settings{}: within one each column but {} differs by at most "
      "1/{:.0f} of its range, and that by {:.2g} % of the largest, rms: noise, or what no column "
      "shows. An average weighs as its independent rows; together they count as {:.0f} readings",
      rows, data.rows(), direction.empty() ? "" : ", rising and falling pressure apart", response,
      steps, 100 * scatter, counted));
  return data;
}

QuickChange quickest_change(std::span<const double> time, std::span<const double> values) {
  const double half = 0.5 * (largest(values) - smallest(values));
  QuickChange out{time.front(), time.back() - time.front()};
  std::deque<std::size_t> highest, lowest;  // rows of the maximum and minimum since `first`
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (!highest.empty() && values[highest.back()] <= values[i]) highest.pop_back();
    while (!lowest.empty() && values[lowest.back()] >= values[i]) lowest.pop_back();
    highest.push_back(i);
    lowest.push_back(i);
    while (first < i && values[highest.front()] - values[lowest.front()] >= half) {
      if (time[i] - time[first] < out.duration) out = {time[first], time[i] - time[first]};
      ++first;
      if (highest.front() < first) highest.pop_front();
      if (lowest.front() < first) lowest.pop_front();
    }
  }
  return out;
}

Measured times_averaged(Measured data, std::size_t most,
                        const std::optional<QuickChange>& quickest) {
  const std::size_t rows = data.rows();
  if (!data.has("time") || rows <= most) return data;
  std::size_t each = (rows + most - 1) / most;
  std::string kept;
  if (quickest) {
    constexpr double averages = 100;  // during the change
    const std::vector<double>& time = data["time"];
    const double step = (time.back() - time.front()) / static_cast<double>(rows - 1);
    const double longest = std::max(1.0, quickest->duration / (averages * step));
    each = std::min(each, static_cast<std::size_t>(std::min(longest, 1e9)));
    if (const std::size_t count = most * each; count < rows) {
      const auto at = std::ranges::lower_bound(time, quickest->from) - time.begin();
      const std::size_t before = std::min(static_cast<std::size_t>(at), count / 10);
      const std::size_t from = std::min(static_cast<std::size_t>(at) - before, rows - count);
      std::vector<std::size_t> some(count);
      std::iota(some.begin(), some.end(), from);
      kept = fmt::format(", those from {:.4g} to {:.4g} s: longer averages hide its changes",
                         time[from], time[from + count - 1]);
      data = data.subset(some);
    }
  }
  const std::size_t used = data.rows();
  RowGroups groups{std::vector<std::size_t>(used), (used + each - 1) / each};
  for (std::size_t row = 0; row < used; ++row) groups.of_row[row] = row / each;
  average(groups, data);
  const std::string count =
      each > 1 ? fmt::format("{} rows are averaged to {}, each of {} rows", rows, data.rows(), each)
               : fmt::format("{} of {} rows are used", data.rows(), rows);
  data.notes.push_back(count + kept);
  return data;
}

Measured times_averaged(Measured data, std::size_t most, std::string_view watched) {
  if (!data.has("time") || data.rows() <= most) return data;
  const QuickChange quickest = quickest_change(data["time"], data[watched]);
  return times_averaged(std::move(data), most, quickest);
}

}  // namespace sinew::identify
