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

// Returns the root mean square deviation of values from their group's average, as a share of the
// largest value.
double scatter_within(const RowGroups& groups, std::span<const double> values) {
  std::vector<double> sum(groups.count), count(groups.count);
  for (std::size_t row = 0; row < values.size(); ++row) {
    sum[groups.of_row[row]] += values[row];
    ++count[groups.of_row[row]];
  }
  double squares = 0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    const std::size_t group = groups.of_row[row];
    squares += std::pow(values[row] - sum[group] / count[group], 2);
  }
  const double freedom = static_cast<double>(values.size() - groups.count);
  return freedom > 0 && largest(values) > 0 ? std::sqrt(squares / freedom) / largest(values) : 0;
}

// Replaces the rows by the averages of their groups, with the line of the group's first row.
void average(const RowGroups& groups, Measured& data) {
  std::vector<double> count(groups.count);
  std::vector<int> lines;
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (count[groups.of_row[row]]++ == 0) lines.push_back(data.lines[row]);
  for (Column& c : data.columns) {
    std::vector<double> mean(groups.count);
    for (std::size_t row = 0; row < data.rows(); ++row)
      mean[groups.of_row[row]] += c.values[row] / count[groups.of_row[row]];
    c.values = std::move(mean);
  }
  data.lines = std::move(lines);
}

}  // namespace

Measured settings_averaged(Measured data, std::string_view response, std::vector<bool>& kinds) {
  const std::size_t rows = data.rows();
  if (data.has("time") || rows <= most_rows) return data;
  std::vector<Setting> settings;
  for (const Column& c : data.columns)
    if (c.name != response)
      settings.push_back({c.values, c.name == "rest_length" || c.name == "branch"});
  const std::vector<double> kind(kinds.begin(), kinds.end());
  if (!kinds.empty()) settings.push_back({kind, true});
  double steps = 4096;
  RowGroups groups = cells_of(settings, rows, steps);
  while (groups.count > averaged_rows && steps > 2) groups = cells_of(settings, rows, steps /= 2);
  const double scatter = data.has(response) ? scatter_within(groups, data[response]) : 0;
  average(groups, data);
  if (!kinds.empty()) {
    std::vector<bool> of_group(groups.count);
    for (std::size_t row = 0; row < rows; ++row) of_group[groups.of_row[row]] = kinds[row];
    kinds = std::move(of_group);
  }
  data.notes.push_back(fmt::format(
      "{} rows are averaged to {} settings: within one each column but {} differs by at most "
      "1/{:.0f} of its range, and that by {:.2g} % of the largest, rms: noise, or what no column "
      "shows, such as filling and venting",
      rows, data.rows(), response, steps, 100 * scatter));
  return data;
}

Measured settings_averaged(Measured data, std::string_view response) {
  std::vector<bool> of_one_kind;
  return settings_averaged(std::move(data), response, of_one_kind);
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
