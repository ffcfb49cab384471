#include "sinew/identify/data/averaged.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

// Which group each row is in; the groups are counted from 0 in the order of the rows.
struct RowGroups {
  std::vector<std::size_t> of_row;
  std::size_t count = 0;
};

// Returns groups of rows that have the same cell of each column, whose range has so many steps.
RowGroups cells_of(const std::vector<std::span<const double>>& columns, std::size_t rows,
                   double steps) {
  RowGroups out{std::vector<std::size_t>(rows), 1};
  for (const std::span<const double> values : columns) {
    const double low = smallest(values), width = (largest(values) - low) / steps;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> groups;
    for (std::size_t row = 0; row < rows; ++row) {
      const double cell = width > 0 ? std::round((values[row] - low) / width) : 0;
      const std::pair key(out.of_row[row], static_cast<std::size_t>(cell));
      out.of_row[row] = groups.try_emplace(key, groups.size()).first->second;
    }
    out.count = groups.size();
  }
  return out;
}

// Replaces the rows by the averages of their groups; each has the line of its group's first row.
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
  std::vector<std::span<const double>> settings;
  for (const Column& c : data.columns)
    if (c.name != response) settings.emplace_back(c.values);
  const std::vector<double> kind(kinds.begin(), kinds.end());
  if (!kinds.empty()) settings.emplace_back(kind);
  double steps = 4096;
  RowGroups groups = cells_of(settings, rows, steps);
  while (groups.count > averaged_rows && steps > 2) groups = cells_of(settings, rows, steps /= 2);
  average(groups, data);
  if (!kinds.empty()) {
    std::vector<bool> of_group(groups.count);
    for (std::size_t row = 0; row < rows; ++row) of_group[groups.of_row[row]] = kinds[row];
    kinds = std::move(of_group);
  }
  data.notes.push_back(fmt::format(
      "{} rows are averaged to {} settings: within one each column but {} differs by at most "
      "1/{:.0f} of its range",
      rows, data.rows(), response, steps));
  return data;
}

Measured settings_averaged(Measured data, std::string_view response) {
  std::vector<bool> of_one_kind;
  return settings_averaged(std::move(data), response, of_one_kind);
}

Measured times_averaged(Measured data, std::size_t most) {
  const std::size_t rows = data.rows();
  if (!data.has("time") || rows <= most) return data;
  const std::size_t each = (rows + most - 1) / most;
  RowGroups groups{std::vector<std::size_t>(rows), (rows + each - 1) / each};
  for (std::size_t row = 0; row < rows; ++row) groups.of_row[row] = row / each;
  average(groups, data);
  data.notes.push_back(
      fmt::format("{} rows are averaged to {}, each of {} rows", rows, data.rows(), each));
  return data;
}

}  // namespace sinew::identify
