#include "sinew/identify/actuator/static_tried.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sinew/identify/actuator/static_groups.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

using Points = std::vector<StaticPoint>;

constexpr int pressure_parts = 4;

double mean_square(std::span<const double> residuals) {
  double sum = 0;
  for (const double r : residuals) sum += r * r;
  return residuals.empty() ? 0 : sum / static_cast<double>(residuals.size());
}

// Returns a part for each point: -1 for those at the ends, which are always fitted. Fewer than
// three groups have nothing between their ends: each is a part then.
std::vector<int> interior_pressures(const Points& points) {
  std::vector<int> part = pressure_groups(points);
  const int last = *std::max_element(part.begin(), part.end());
  if (last < 2) return part;
  for (int& p : part) p = p == 0 || p == last ? -1 : p % pressure_parts;
  return part;
}

// A length of one muscle.
struct Mount {
  double length = 0, rest_length = 0;
  int group = 0;
  bool at_end = false;  // the longest or the shortest of its muscle
};

std::vector<Mount> mounts_of(const Points& points, const std::vector<int>& group) {
  std::vector<Mount> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::ranges::find(out, group[i], &Mount::group) == out.end())
      out.push_back({points[i].length, points[i].rest_length, group[i]});
  for (Mount& m : out) {
    const auto beyond = [&](int sign) {
      return std::ranges::any_of(out, [&](const Mount& other) {
        return other.rest_length == m.rest_length && sign * (other.length - m.length) > 0;
      });
    };
    m.at_end = !beyond(1) || !beyond(-1);
  }
  return out;
}

// Returns predicted - measured of the end lengths or of those between, each predicted by all other
// lengths  [N]. Adds a text for each length to `each`.
std::vector<double> cross_lengths(const Tried& model, const Points& points, const StaticFit& whole,
                                  bool at_end, double full_scale, std::string& each) {
  const std::vector<int> group = length_groups(points);
  std::vector<double> out;
  for (const Mount& mount : mounts_of(points, group)) {
    if (mount.at_end != at_end) continue;
    std::vector<int> mine(points.size(), 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (group[i] == mount.group) mine[i] = 0;
    const std::vector<double> r = model.cross(points, mine, 1, whole);
    const Score s = score(r, full_scale);
    each += fmt::format("{}{:.4g} mm {:.2f}/{:.2f}", each.empty() ? "" : ", ", 1e3 * mount.length,
                        s.rmse_percent, s.max_percent);
    out.insert(out.end(), r.begin(), r.end());
  }
  return out;
}

}  // namespace

Tried::Tried(const StaticModel& model, const StaticScales& scales, const Points& points)
    : model_(model), scales_(scales), knobs_(knobs_of(model, scales)) {
  std::set<double> muscles;
  bool fill = false, vent = false;
  for (const StaticPoint& p : points) {
    muscles.insert(p.rest_length);
    fill |= p.branch == Branch::fill;
    vent |= p.branch == Branch::vent;
  }
  if (muscles.size() > 1) knobs_.push_back(Knob::end_loss);
  if (fill && vent) knobs_.push_back(Knob::half_width);
  if (count_of(length_groups(points)) > 1) return;
  if (!scales.braid)
    throw Refusal("lengths", "one length only", "several lengths, or a braid that is known",
                  "measure at other lengths, or actuator=FILE with the braid's geometry");
  for (const Knob knob : knobs_)
    if (needs_lengths(knob)) throw Refusal("lengths", "one length only", "several for this", "");
}

bool Tried::by_ratio() const { return model_.name == "effectiveness-by-ratio"; }

StaticFit Tried::fit(const Points& points, const StaticFit* start) const {
  if (by_ratio()) return fit_by_ratio(points, scales_);
  return fit_static(knobs_, points, scales_, start);
}

std::vector<double> Tried::cross(const Points& points, const std::vector<int>& part, int parts,
                                 const StaticFit& whole) const {
  std::vector<double> out;
  for (int k = 0; k < parts; ++k) {
    const StaticSplit s = split(points, [&](std::size_t i) { return part[i] != k; });
    if (s.held_out.empty()) continue;
    const StaticFit one = fit(s.fitted, &whole);
    const std::vector<double> r = misses(one.setting, scales_of_fit(one), s.held_out);
    out.insert(out.end(), r.begin(), r.end());
  }
  return out;
}

StaticScales Tried::scales_of_fit(const StaticFit& fit) const {
  StaticScales out = scales_;
  if (by_ratio()) out.braid = fit.setting.actuator.braid;
  return out;
}

void cross_validate(const Tried& model, const Points& points, const StaticFit& whole,
                    double full_scale, Fit& fit) {
  const std::vector<int> part = interior_pressures(points);
  const int parts = 1 + *std::max_element(part.begin(), part.end());
  std::vector<double> all = model.cross(points, part, parts, whole);
  double square = mean_square(all);
  fit.notes.push_back(fmt::format("pressures between the ends that it did not see: {:.2f} % rmse",
                                  100 * std::sqrt(square) / full_scale));

  std::string inside, ends;
  const auto between = cross_lengths(model, points, whole, false, full_scale, inside);
  if (!between.empty()) {
    fit.notes.push_back("lengths between the ends that it did not see, rmse/max %: " + inside);
    square = 0.5 * (square + mean_square(between));
    all.insert(all.end(), between.begin(), between.end());
  }
  fit.cross_validated = score(all, full_scale);
  fit.cross_validated->rmse = std::sqrt(square);
  fit.cross_validated->rmse_percent = 100 * fit.cross_validated->rmse / full_scale;

  if (count_of(length_groups(points)) < 3) return;
  const auto beyond = cross_lengths(model, points, whole, true, full_scale, ends);
  fit.extrapolated = score(beyond, full_scale);
  fit.notes.push_back("lengths at the ends that it did not see, rmse/max %: " + ends);
}

}  // namespace sinew::identify
