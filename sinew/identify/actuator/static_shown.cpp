// Curves, errors by part and omitted points of the report on a static law.
#include "sinew/identify/actuator/static.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sinew/identify/actuator/static_predict.h"

namespace sinew::identify {

namespace {

using Points = std::vector<StaticPoint>;

constexpr int curve_nodes = 33;          // nodes of a curve between the ends of its points
constexpr int nodes_beyond = 4;          // on each side
constexpr double room_beyond = 0.08;     // share of the range of all points
constexpr std::size_t most_shown = 240;  // points left out for one reason
constexpr double off_branch = 1000;  // distance added for another branch, more than any length [m]

// Returns whether the x axis is the pressure; otherwise it is the length.
bool over_pressure(const Rows& rows) { return rows.x == "pressure"; }

double& along(StaticPoint& point, bool pressure) {
  return pressure ? point.pressure : point.length;
}

double along(StaticPoint point, const Rows& rows) { return along(point, over_pressure(rows)); }

// Returns the nodes of a curve: evenly between its ends, then on either side as far as `room`
// allows.
std::vector<double> places_of(double low, double high, double room) {
  std::vector<double> out;
  const double least = std::max(0.0, low - room);
  for (int i = 0; i < nodes_beyond; ++i) out.push_back(least + (low - least) * i / nodes_beyond);
  for (int i = 0; i < curve_nodes; ++i) out.push_back(low + (high - low) * i / (curve_nodes - 1.0));
  for (int i = 1; i <= nodes_beyond; ++i) out.push_back(high + room * i / nodes_beyond);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

// Returns the law along one group, at the values that its points have in common.
PredictedCurve curve_of(const StaticResult& result, const std::string& group, const Points& points,
                        double room) {
  const bool pressure = over_pressure(result.report.rows);
  StaticPoint at = points.front();
  double& moved = along(at, pressure);
  double& held = along(at, !pressure);
  double low = moved, high = moved, sum = 0;
  for (const StaticPoint& p : points) {
    low = std::min(low, along(p, result.report.rows));
    high = std::max(high, along(p, result.report.rows));
    sum += pressure ? p.length : p.pressure;
  }
  held = sum / static_cast<double>(points.size());
  PredictedCurve out{.group = group, .at = places_of(low, high, room)};
  for (const double place : out.at) {
    moved = place;
    const StaticForce f = predict(result, at);
    out.value.push_back(f.force);
    out.half_68.push_back(f.half_68);
    out.half_95.push_back(f.half_95);
  }
  return out;
}

std::vector<PredictedCurve> curves_of(const StaticResult& result, const Points& points) {
  const Rows& rows = result.report.rows;
  const auto [low, high] = std::ranges::minmax(rows.at);
  std::vector<std::string> names;
  std::vector<Points> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = std::ranges::find(names, rows.group[i]);
    const auto place = static_cast<std::size_t>(at - names.begin());
    if (at == names.end()) names.push_back(rows.group[i]), groups.emplace_back();
    groups[place].push_back(points[i]);
  }
  std::vector<PredictedCurve> out;
  for (std::size_t k = 0; k < names.size(); ++k)
    out.push_back(curve_of(result, names[k], groups[k], room_beyond * (high - low)));
  return out;
}

// Returns the part of each point: its muscle.
std::vector<int> muscle_parts(const Points& points) {
  const std::set<double> muscles = muscles_in(points);
  std::vector<int> out;
  for (const StaticPoint& p : points)
    out.push_back(static_cast<int>(std::distance(muscles.begin(), muscles.find(p.rest_length))));
  return out;
}

std::vector<int> branch_parts(const Points& points) {
  std::vector<int> out;
  for (const StaticPoint& p : points)
    out.push_back(p.branch == Branch::fill ? 0 : p.branch == Branch::vent ? 1 : 2);
  return out;
}

// Returns the errors by every quantity that was varied.
std::vector<ErrorBy> errors_of(const Report& report, const Points& points) {
  const std::vector<double>& residuals = report.best().residuals;
  const auto by = [&](const char* what, const char* unit, double StaticPoint::*value,
                      const std::vector<int>& part) {
    return error_by(what, unit, residuals, part, values_of(points, value), report.full_scale);
  };
  std::vector<ErrorBy> out = {
      by("muscle", "m", &StaticPoint::rest_length, muscle_parts(points)),
      by("length", "m", &StaticPoint::length, length_groups(points)),
      by("pressure", "Pa gauge", &StaticPoint::pressure, pressure_groups(points)),
      by("branch", "", &StaticPoint::force, branch_parts(points))};
  const std::set<int> branches = [&] {
    const std::vector<int> parts = branch_parts(points);
    return std::set<int>(parts.begin(), parts.end());
  }();
  constexpr const char* names[] = {"filling", "venting", "not given"};
  std::size_t k = 0;
  for (const int branch : branches) out.back().parts[k++].name = names[branch];
  std::erase_if(out, [](const ErrorBy& e) { return e.parts.size() < 2; });
  return out;
}

// Returns the group of the nearest point, by the quantity that differs between groups.
std::string group_near(const StaticPoint& point, const Rows& rows, const Points& points) {
  std::string out;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const StaticPoint& p = points[i];
    double away = over_pressure(rows) ? std::abs(p.length - point.length)
                                      : std::abs(p.pressure - point.pressure);
    if (p.rest_length != point.rest_length || p.branch != point.branch) away += off_branch;
    if (away >= least) continue;
    least = away;
    out = rows.group[i];
  }
  return out;
}

Omitted omitted_of(const StaticOmitted& from, const Rows& rows, const Points& points) {
  Omitted out{.reason = from.reason, .criterion = from.criterion, .count = from.count, .rows = {}};
  const std::size_t stride = from.why.empty() ? 1 + from.points.size() / most_shown : 1;
  for (std::size_t i = 0; i < from.points.size(); i += stride) {
    const StaticPoint& p = from.points[i];
    out.rows.push_back({.at = along(p, rows),
                        .measured = p.force,
                        .group = group_near(p, rows, points),
                        .why = from.why.empty() ? "" : from.why[i]});
  }
  return out;
}

}  // namespace

void show_static(const StaticSplit& split, std::span<const StaticOmitted> left_out,
                 StaticResult& result) {
  const Points points = all_points(split);
  Report& report = result.report;
  report.curves = curves_of(result, points);
  report.errors = errors_of(report, points);
  for (const StaticOmitted& omitted : left_out)
    if (omitted.count > 0) report.left_out.push_back(omitted_of(omitted, report.rows, points));
}

}  // namespace sinew::identify
