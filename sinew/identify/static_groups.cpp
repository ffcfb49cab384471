#include "sinew/identify/static_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/identify/quality.h"

namespace sinew::identify {

namespace {

using Points = std::vector<StaticPoint>;

// The branch of a recording with its length and, of several muscles, its muscle.
std::string branch_of(const StaticPoint& p, bool several) {
  std::string out = several ? fmt::format("{:.0f} mm muscle, ", 1e3 * p.rest_length) : "";
  out += fmt::format("{:.4g} mm", 1e3 * p.length);
  if (p.branch != Branch::unknown) out += p.branch == Branch::fill ? ", filling" : ", venting";
  return out;
}

}  // namespace

std::vector<int> pressure_groups(const Points& points) {
  std::vector<double> p;
  for (const StaticPoint& point : points) p.push_back(point.pressure);
  const double range = largest(p) - smallest(p);
  return groups_of(p, 0.015 * range, 0.1 * range);
}

std::vector<int> length_groups(const Points& points) {
  std::vector<double> l;
  double longest = 0;
  for (const StaticPoint& point : points) longest = std::max(longest, point.length);
  for (const StaticPoint& point : points) l.push_back(point.length + 10 * point.rest_length);
  return groups_of(l, 0.004 * longest, 1e9);
}

int count_of(const std::vector<int>& groups) {
  return static_cast<int>(std::set<int>(groups.begin(), groups.end()).size());
}

Rows rows_of(const StaticSplit& s) {
  Points points = s.fitted;
  points.insert(points.end(), s.held_out.begin(), s.held_out.end());
  std::set<double> muscles;
  for (const StaticPoint& p : points) muscles.insert(p.rest_length);
  const std::vector<int> pressure = pressure_groups(points);
  const bool by_length =
      muscles.size() > 1 || count_of(length_groups(points)) <= count_of(pressure);
  Rows out{.x = by_length ? "pressure" : "length", .x_unit = by_length ? "Pa gauge" : "m"};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const StaticPoint& p = points[i];
    out.at.push_back(by_length ? p.pressure : p.length);
    out.measured.push_back(p.force);
    out.group.push_back(by_length ? branch_of(p, muscles.size() > 1)
                                  : fmt::format("{:.0f} kPa", 1e-3 * p.pressure));
    out.held_out.push_back(i >= s.fitted.size());
  }
  return out;
}

}  // namespace sinew::identify
