#include "sinew/identify/actuator/static_outliers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "sinew/identify/actuator/static_explain.h"
#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

constexpr double scatters = 8, share = 0.05, most = 0.1;

std::vector<double> distances(const StaticFit& fit, const StaticScales& scales,
                              const std::vector<StaticPoint>& points) {
  std::vector<double> out = misses(fit.setting, scales, points);
  for (double& r : out) r = std::abs(r);
  return out;
}

// Every other law is one of these with a term left out, or the kin of one (series).
constexpr std::string_view freest[] = {"wall",
                                       "taper",
                                       "elastic-linear",
                                       "elastic-cubic",
                                       "saturating-effectiveness",
                                       "saturating-end-caps"};

// A law, and how far each point lies from it.
struct Closest {
  StaticFit fit;
  std::vector<double> distances;  // empty: there is none
};

// The law that most points are closest to, among the freest or among all others.
Closest closest_of(bool free, const std::vector<StaticPoint>& points, const StaticScales& scales) {
  std::set<double> muscles;
  for (const StaticPoint& p : points) muscles.insert(p.rest_length);
  Closest closest;
  for (const StaticModel& model : static_models()) {
    if (model.name == "effectiveness-by-ratio") continue;
    if ((std::ranges::find(freest, model.name) != std::end(freest)) != free) continue;
    std::vector<Knob> knobs = knobs_of(model, scales);
    if (std::ranges::find(knobs, Knob::series) != knobs.end()) continue;
    if (muscles.size() > 1) knobs.push_back(Knob::end_loss);
    try {
      const StaticFit fit = fit_static(knobs, points, scales, nullptr, 1e-7);
      const std::vector<double> d = distances(fit, scales, points);
      if (closest.distances.empty() || median(d) < median(closest.distances)) closest = {fit, d};
    } catch (const Refusal&) {
      continue;  // too few points for this one
    }
  }
  return closest;
}

// The same; the simpler laws only where the data are too few for the freest.
Closest the_closest(const std::vector<StaticPoint>& points, const StaticScales& scales) {
  const Closest free = closest_of(true, points, scales);
  return free.distances.empty() ? closest_of(false, points, scales) : free;
}

// The largest force that is not alone: what one wild point says does not count.
double common_force(const std::vector<StaticPoint>& points) {
  std::vector<double> forces;
  for (const StaticPoint& p : points) forces.push_back(p.force);
  const auto at = forces.begin() + static_cast<std::ptrdiff_t>(forces.size() * 9 / 10);
  std::nth_element(forces.begin(), at, forces.end());
  return *at;
}

}  // namespace

Outliers gross_outliers(const std::vector<StaticPoint>& points, const StaticScales& scales) {
  if (points.empty()) return {};
  StaticScales common = scales;
  common.full_scale = common_force(points);
  if (!(common.full_scale > 0)) return {};
  const auto [fit, d] = the_closest(points, common);
  Outliers out{.points = {}, .scatter = d.empty() ? 0 : 1.4826 * median(d)};
  out.limit = std::max(scatters * out.scatter, share * common.full_scale);
  for (std::size_t i = 0; i < d.size(); ++i)
    if (d[i] > out.limit) out.points.push_back({.point = i, .law = 0, .why = ""});
  if (static_cast<double>(out.points.size()) > most * static_cast<double>(points.size())) return {};
  for (Outlier& o : out.points) {
    o.law = predicted(fit.setting, common, points[o.point]);
    o.why = explanation_of(points[o.point], fit, common, points, out.scatter);
  }
  return out;
}

}  // namespace sinew::identify
