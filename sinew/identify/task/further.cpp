#include "sinew/identify/task/further.h"

#include <fmt/format.h>

#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/plan/plan.h"

namespace sinew::identify {

namespace {

// An error just above the law's own: then mounts are added as long as there is room for them.
constexpr double wanted = 1.05;  // times the law's error
constexpr int mounts = 3;

double percent(double share) { return 100 * share; }

Further further_of(const std::vector<StaticPoint>& points, double atmosphere,
                   const std::optional<actuator::Braid>& braid) {
  const FittedMuscle fitted = muscle_by_points(points, atmosphere, braid);
  PlanOptions options{.noise = fitted.scatter, .most = mounts};
  options.error = wanted * options.law_error;
  const MeasurementPlan plan =
      plan_measurements(fitted.muscle, region_of(fitted.muscle), options, mounts_of(points));
  Further out{.of = "",
              .readings = points.size(),
              .rms = percent(plan.before.rms),
              .half = percent(plan.before.half_width),
              .mounts = {},
              .note = ""};
  double time = 0;
  for (const PlannedMount& m : plan.mounts) {
    time += m.time;
    out.mounts.push_back({.length = m.length,
                          .pressures = m.pressures,
                          .readings = m.readings(),
                          .time = time,
                          .rms = percent(m.after.rms),
                          .half = percent(m.after.half_width)});
  }
  out.note = fmt::format(
      "Expected errors of the richest law, {:.2g} % of them the law's own, which no measurement "
      "lowers. A reading is taken to scatter by {:.2g} N as these did, a mount's length to be off "
      "by {:.1g} mm; a mount takes {:.0f} min, a reading {:.1g} min.",
      percent(options.law_error), options.noise, 1e3 * options.length_error,
      options.mount_time / 60, options.step_time / 60);
  return out;
}

}  // namespace

std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid) {
  std::vector<Further> out;
  for (const StaticMuscle& muscle : result.muscles) {
    std::vector<StaticPoint> own;
    for (const StaticPoint& p : result.points)
      if (p.rest_length == muscle.rest_length) own.push_back(p);
    try {
      out.push_back(further_of(own, atmosphere, braid));
    } catch (const Refusal&) {
      continue;  // too few points for a plan: the models of the report say what is missing
    }
    if (result.muscles.size() > 1)
      out.back().of = fmt::format("the muscle of {:.4g} mm", 1e3 * muscle.rest_length);
  }
  return out;
}

}  // namespace sinew::identify
