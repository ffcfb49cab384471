#include "sinew/identify/check/recognised.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/actuator/static_settled.h"
#include "sinew/identify/data/quality.h"
#include "sinew/units/constants.h"

namespace sinew::identify {

namespace {

RecognisedFile file_of(const Measured& m) {
  RecognisedFile out{.file = m.file, .rows = m.rows(), .is_recording = m.has("time")};
  for (const Column& c : m.columns) {
    if (c.name == "branch") {  // words, not numbers
      out.columns.push_back({c.name, smallest(c.values) < 0 ? "vent" : "fill",
                             largest(c.values) > 0 ? "fill" : "vent"});
      continue;
    }
    out.columns.push_back({c.name, in_unit_of_file(m, c.name, smallest(c.values), 4),
                           in_unit_of_file(m, c.name, largest(c.values), 4)});
  }
  if (!out.is_recording || !m.has("pressure") || m.rows() == 0) return out;
  const Settled settled = settled_samples(m["time"], m["pressure"]);
  out.settled = 1 - static_cast<double>(settled.moving()) / static_cast<double>(m.rows());
  return out;
}

std::string branches_of(const std::vector<StaticPoint>& points) {
  std::string out;
  for (const auto& [branch, name] : {std::pair{Branch::fill, "fill"}, {Branch::vent, "vent"}})
    if (std::ranges::any_of(points,
                            [branch = branch](const StaticPoint& p) { return p.branch == branch; }))
      out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

RecognisedMount mount_of(const std::vector<StaticPoint>& points) {
  std::vector<double> lengths;
  for (const StaticPoint& p : points) lengths.push_back(p.length);
  RecognisedMount out{.rest_length = points[0].rest_length,
                      .length = median(lengths),
                      .branches = branches_of(points),
                      .pressures = count_of(pressure_groups(points)),
                      .lowest = points[0].pressure,
                      .highest = points[0].pressure,
                      .strongest = points[0].force};
  for (const StaticPoint& p : points) {
    ++(p.fitted ? out.points : out.held_out);
    out.lowest = std::min(out.lowest, p.pressure);
    out.highest = std::max(out.highest, p.pressure);
    out.strongest = std::max(out.strongest, p.force);
  }
  return out;
}

}  // namespace

Recognised recognise(const CheckInput& input) {
  Recognised out;
  for (const CheckedTable& t : input.tables) out.files.push_back(file_of(t.table));
  const std::vector<StaticPoint>& points = input.data.points;
  if (points.empty()) return out;
  const std::vector<int> group = length_groups(points);  // sorted by muscle, then by length
  for (int g = 0; g <= *std::ranges::max_element(group); ++g) {
    std::vector<StaticPoint> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (group[i] == g) own.push_back(points[i]);
    if (!own.empty()) out.mounts.push_back(mount_of(own));
  }
  out.noise = force_noise(input);
  return out;
}

// --- noise of the force ---

namespace {

constexpr std::size_t rest_window = 25;  // samples of a straight line
constexpr double same_length = 2e-3;     // share of the longest: readings of one mount
constexpr double same_pressure = 0.01;   // share of the highest: readings of one step

// Sum of squares of residuals, with its degrees of freedom.
struct Squares {
  double sum = 0, freedom = 0;
  std::size_t readings = 0;
};

// Adds the residuals about a straight line over x, or about the mean if all x are equal.
void add_about_line(std::span<const double> x, std::span<const double> y, Squares& out) {
  const auto n = static_cast<double>(y.size());
  double mx = 0, my = 0, sxy = 0, sxx = 0;
  for (std::size_t i = 0; i < y.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < y.size(); ++i) {
    sxy += (x[i] - mx) * (y[i] - my);
    sxx += (x[i] - mx) * (x[i] - mx);
  }
  const bool leans = sxx > 1e-12 * mx * mx && n > 2;
  const double slope = leans ? sxy / sxx : 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    out.sum += std::pow(y[i] - my - slope * (x[i] - mx), 2);
  out.freedom += n - (leans ? 2 : 1);
  out.readings += y.size();
}

// Adds samples at rest, in windows. A window that scatters far more than most is left out: the
// muscle may have reached an end of its travel there.
void add_rests(const Measured& m, Squares& out) {
  constexpr double far_more = 3;  // times the median scatter
  const bool weighs = m.has("load");
  const std::vector<double>& force = m[weighs ? "load" : "force"];
  const std::vector<bool> rests = settled_samples(m["time"], m["pressure"]).sample;
  std::vector<Squares> windows;
  std::vector<double> scatter;
  for (std::size_t i = 0; i < force.size();) {
    std::size_t end = i;
    while (end < force.size() && rests[end] && end - i < rest_window) ++end;
    if (end - i >= 5) {
      add_about_line(std::span(m["time"]).subspan(i, end - i), std::span(force).subspan(i, end - i),
                     windows.emplace_back());
      scatter.push_back(std::sqrt(windows.back().sum / windows.back().freedom));
    }
    i = std::max(end, i + 1);
  }
  const double unit = weighs ? units::standard_gravity : 1, most = far_more * median(scatter);
  for (std::size_t k = 0; k < windows.size(); ++k) {
    if (most > 0 && scatter[k] > most) continue;
    out.sum += windows[k].sum * unit * unit;
    out.freedom += windows[k].freedom;
    out.readings += windows[k].readings;
  }
}

// Adds readings of one muscle, length and branch, sorted by pressure, in groups of nearly equal
// pressure, each about its line.
void add_repeated(const std::vector<StaticPoint>& sorted, double near, Squares& out) {
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    std::vector<double> pressure, force;
    for (; end < sorted.size() && sorted[end].pressure - sorted[i].pressure <= near; ++end) {
      pressure.push_back(sorted[end].pressure);
      force.push_back(sorted[end].force);
    }
    if (force.size() >= 2) add_about_line(pressure, force, out);
    i = end;
  }
}

Squares of_tables(const std::vector<StaticPoint>& points) {
  double longest = 0, top = 0;
  for (const StaticPoint& p : points) {
    longest = std::max(longest, p.length);
    top = std::max(top, p.pressure);
  }
  std::vector<StaticPoint> sorted = points;
  sort_points(sorted);
  Squares out;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    while (end < sorted.size() && sorted[end].rest_length == sorted[i].rest_length &&
           sorted[end].branch == sorted[i].branch &&
           sorted[end].length - sorted[i].length <= same_length * longest)
      ++end;
    std::vector<StaticPoint> own(sorted.begin() + static_cast<std::ptrdiff_t>(i),
                                 sorted.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::stable_sort(own, {}, &StaticPoint::pressure);
    add_repeated(own, same_pressure * top, out);
    i = end;
  }
  return out;
}

}  // namespace

ForceNoise force_noise(const CheckInput& input) {
  Squares recorded;
  double strongest = 0;
  for (const StaticPoint& p : input.data.points) strongest = std::max(strongest, p.force);
  for (const CheckedTable& t : input.tables) {
    const Measured& m = t.table;
    if (m.has("time") && m.has("pressure") && m.has("force") != m.has("load"))
      add_rests(m, recorded);
  }
  const bool records = recorded.freedom > 0;
  const Squares squares = records ? recorded : of_tables(input.data.points);
  ForceNoise out;
  // Readings that differ only in the last digits of a number are copies.
  if (!(squares.freedom >= 3) || !(strongest > 0) ||
      !(std::sqrt(squares.sum / squares.freedom) > 1e-9 * strongest))
    return out;
  out.deviation = std::sqrt(squares.sum / squares.freedom);
  out.share = out.deviation / strongest;
  out.readings = squares.readings;
  out.from = records ? "settled samples" : "repeated readings";
  return out;
}

}  // namespace sinew::identify
