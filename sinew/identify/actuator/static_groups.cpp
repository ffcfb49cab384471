#include "sinew/identify/actuator/static_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "sinew/actuator/prediction.h"
#include "sinew/identify/data/quality.h"

namespace sinew::identify {

namespace {

using Points = std::vector<StaticPoint>;

// Returns the mean of a field for each group.
std::vector<double> means(const Points& points, const std::vector<int>& group,
                          double StaticPoint::*what) {
  std::vector<double> sum(points.size() + 1), count(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum[static_cast<std::size_t>(group[i])] += points[i].*what;
    count[static_cast<std::size_t>(group[i])] += 1;
  }
  for (std::size_t g = 0; g < sum.size(); ++g) sum[g] /= std::max(1.0, count[g]);
  return sum;
}

// Returns the curve's name: a length or pressure, with the branch if known, and the muscle if
// several.
std::string branch_of(const StaticPoint& p, const std::string& own, bool several) {
  std::string out = several ? fmt::format("{:.0f} mm muscle, ", 1e3 * p.rest_length) : "";
  out += own;
  if (p.branch != Branch::unknown) out += p.branch == Branch::fill ? ", filling" : ", venting";
  return out;
}

}  // namespace

StaticScales scales_of(const Points& points, double atmosphere,
                       const std::optional<actuator::Braid>& braid) {
  StaticScales out{.atmosphere = atmosphere, .braid = braid};
  for (const StaticPoint& p : points) {
    out.rest_length = std::max(out.rest_length, p.rest_length);
    out.full_scale = std::max(out.full_scale, p.force);
    out.top_pressure = std::max(out.top_pressure, p.pressure);
  }
  return out;
}

std::vector<int> pressure_groups(const Points& points) {
  const std::vector<double> p = values_of(points, &StaticPoint::pressure);
  const double range = largest(p) - smallest(p), top = largest(p);
  return groups_of(p, std::max(0.015 * range, 0.01 * top), std::max(0.1 * range, 0.05 * top));
}

std::vector<int> length_groups(const Points& points) {
  std::vector<double> l;
  const double longest = std::max(0.0, largest(values_of(points, &StaticPoint::length)));
  for (const StaticPoint& point : points) l.push_back(point.length + 10 * point.rest_length);
  return mount_groups(l, actuator::same_length * longest, widest_mount * longest);
}

int count_of(const std::vector<int>& groups) {
  return static_cast<int>(std::set<int>(groups.begin(), groups.end()).size());
}

std::vector<int> setting_groups(const Points& points) {
  constexpr double same_mount = 2e-3, same_pressure = 0.01;  // shares of the largest
  const auto near = [&](double StaticPoint::*value, double share) {
    const std::vector<double> values = values_of(points, value);
    const double gap = share * largest(values);
    return groups_of(values, 0.5 * gap, gap);
  };
  const std::vector<int> mount = near(&StaticPoint::length, same_mount),
                         level = near(&StaticPoint::pressure, same_pressure);
  std::map<std::tuple<double, Branch, int, int>, int> known;
  std::vector<int> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    out.push_back(known
                      .try_emplace({points[i].rest_length, points[i].branch, mount[i], level[i]},
                                   static_cast<int>(known.size()))
                      .first->second);
  return out;
}

std::vector<double> lengths_of(const Points& points, double rest_length) {
  const std::vector<int> group = length_groups(points);
  const std::vector<double> mean = means(points, group, &StaticPoint::length);
  std::set<double> mounts, readings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].rest_length != rest_length) continue;
    mounts.insert(mean[static_cast<std::size_t>(group[i])]);
    readings.insert(points[i].length);
  }
  std::vector<double> out(mounts.begin(), mounts.end());
  if (out.empty()) return out;
  // The first and last are the extreme readings: beyond them nothing was measured.
  if (out.size() == 1 && *readings.begin() < *readings.rbegin()) out.push_back(out.front());
  out.front() = *readings.begin();
  out.back() = *readings.rbegin();
  return out;
}

std::vector<StaticPoint> all_points(const StaticSplit& s) {
  Points points = s.fitted;
  points.insert(points.end(), s.held_out.begin(), s.held_out.end());
  return points;
}

Rows rows_of(const StaticSplit& s) {
  const Points points = all_points(s);
  const std::set<double> muscles = muscles_in(points);
  const std::vector<int> pressure = pressure_groups(points), length = length_groups(points);
  const bool by_length = muscles.size() > 1 || count_of(length) <= count_of(pressure);
  const std::vector<int>& group = by_length ? length : pressure;
  const std::vector<double> mean =
      means(points, group, by_length ? &StaticPoint::length : &StaticPoint::pressure);
  Rows out{.x = by_length ? "pressure" : "length", .x_unit = by_length ? "Pa gauge" : "m"};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const StaticPoint& p = points[i];
    const double own = mean[static_cast<std::size_t>(group[i])];
    out.at.push_back(by_length ? p.pressure : p.length);
    out.measured.push_back(p.force);
    out.group.push_back(branch_of(
        p, by_length ? fmt::format("{:.4g} mm", 1e3 * own) : fmt::format("{:.0f} kPa", 1e-3 * own),
        muscles.size() > 1));
    out.venting.push_back(p.branch == Branch::vent);
    out.order.push_back(group[i]);
    out.held_out.push_back(i >= s.fitted.size());
  }
  return out;
}

}  // namespace sinew::identify
