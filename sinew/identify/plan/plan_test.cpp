// A plan's predicted error is that of simulated rigs with noise, measured and fitted; it stops when
// the required error is reached, and spends its time where it helps.
#include "sinew/identify/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/identify/actuator/static_fit.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::plan_test {
namespace {

ExpectedMuscle muscle() { return muscle_by_size(0.25, 0.012, 6e5, 101325); }

PlanOptions options() { return {.noise = 3, .length_error = 2e-4, .law_error = 0.005}; }

TEST(Plan, AMuscleBySizeIsThatOfItsBraid) {
  const ExpectedMuscle m = muscle();
  const double b = m.setting.actuator.braid.thread_length, n = m.setting.actuator.braid.turns;
  EXPECT_NEAR(std::sqrt(b * b - 0.25 * 0.25) / (M_PI * n), 0.012, 1e-12);
  EXPECT_NEAR(expected_force(m, 0.25, 6e5), m.scales.full_scale, 1e-9 * m.scales.full_scale);
  const double free = free_length(m);
  EXPECT_EQ(expected_force(m, free - 1e-6, 6e5), 0);
  EXPECT_GT(expected_force(m, free + 1e-4, 6e5), 0);
  EXPECT_GT(free, 0.6 * 0.25);
}

// The slopes match differences with ten times the step.
TEST(Plan, SlopesAreThoseOfTheForce) {
  const ExpectedMuscle m = muscle();
  const std::vector<double> slopes = slopes_at(m, 0.22, 4e5, Branch::fill);
  for (std::size_t i = 0; i < m.free_parameters.size(); ++i) {
    ExpectedMuscle up = m, down = m;
    const double step = 0.01 * parameter_of(m.free_parameters[i], m.scales).scale;
    value_of(up.setting, m.free_parameters[i]) += step;
    value_of(down.setting, m.free_parameters[i]) -= step;
    const double wide = (expected_force(up, 0.22, 4e5, Branch::fill) -
                         expected_force(down, 0.22, 4e5, Branch::fill)) /
                        0.02;
    EXPECT_NEAR(slopes[i], wide, 1e-3 * std::abs(wide) + 1e-6) << i;
  }
}

TEST(Plan, StepsAreRoundAndWithinTheirRange) {
  const std::vector<double> lengths = round_steps(0.1983, 0.25, 14);
  EXPECT_DOUBLE_EQ(lengths.back(), 0.25);
  EXPECT_DOUBLE_EQ(lengths.front(), 0.1983);
  for (std::size_t i = 1; i < lengths.size(); ++i) EXPECT_GT(lengths[i], lengths[i - 1]);
  for (std::size_t i = 1; i + 1 < lengths.size(); ++i)
    EXPECT_NEAR(lengths[i] / 0.002, std::round(lengths[i] / 0.002), 1e-6) << lengths[i];
}

// One rig: lengths of mounts have errors, the law has an error at each mount, readings have noise;
// then the law is fitted. Returns the mean square error.
double squares_of_rig(const ExpectedMuscle& m, const MeasurementPlan& plan, const PlanOptions& o,
                      unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<StaticPoint> points;
  const auto read = [&](double length, double off, double law, double p, Branch branch) {
    const double force = expected_force(m, length + off, p, branch);
    points.push_back({.length = length,
                      .pressure = p,
                      .force = force > 0 ? force + law + o.noise * normal(random) : 0,
                      .rest_length = m.scales.rest_length,
                      .branch = branch});
  };
  for (const PlannedMount& mount : plan.mounts) {
    const double off = o.length_error * normal(random);
    const double law = o.law_error * m.scales.full_scale * normal(random);
    for (const double p : mount.pressures) read(mount.length, off, law, p, Branch::fill);
    for (const double p : mount.pressures)
      if (p != mount.pressures.back()) read(mount.length, off, law, p, Branch::vent);
  }
  ExpectedMuscle found = m;
  found.setting = fit_static(m.free_parameters, points, m.scales).setting;
  double sum = 0, count = 0;
  for (int i = 0; i < 11; ++i)
    for (int k = 0; k < 7; ++k) {
      const PlanRegion& r = plan.region;
      const double length = r.shortest + i / 10.0 * (r.longest - r.shortest);
      const double p = r.lowest + k / 6.0 * (r.highest - r.lowest);
      const double truth = expected_force(m, length, p);
      if (!(truth > 0)) continue;
      const double off = expected_force(found, length, p) - truth;
      sum += off * off;
      ++count;
    }
  return sum / count;
}

// The prediction is linear, and the fit gives readings equal weight: they agree within 20 %.
TEST(Plan, TheErrorThatIsPromisedIsThatOfSyntheticRigs) {
  const ExpectedMuscle m = muscle();
  for (const auto& [noise, error] : {std::pair{3.0, 0.02}, {3.0, 0.008}, {12.0, 0.02}}) {
    PlanOptions o = options();
    o.noise = noise;
    o.error = error;
    const MeasurementPlan plan = plan_measurements(m, region_of(m), o);
    ASSERT_TRUE(plan.reached) << error;
    double mean = 0;
    constexpr unsigned rigs = 60;
    for (unsigned seed = 0; seed < rigs; ++seed) mean += squares_of_rig(m, plan, o, seed) / rigs;
    const double law = o.law_error * m.scales.full_scale;
    const double found = std::sqrt(mean + law * law) / m.scales.full_scale;
    EXPECT_NEAR(found / plan.after().rms, 1, 0.2) << plan.after().rms << " " << found;
  }
}

TEST(Plan, EachMountLowersTheErrorAndTheLastReachesIt) {
  const ExpectedMuscle m = muscle();
  PlanOptions o = options();
  o.error = 0.01;
  const MeasurementPlan plan = plan_measurements(m, region_of(m), o);
  ASSERT_TRUE(plan.reached);
  double before = plan.before.rms;
  for (const PlannedMount& mount : plan.mounts) {
    EXPECT_LT(mount.after.rms, before);
    before = mount.after.rms;
    EXPECT_TRUE(std::ranges::is_sorted(mount.pressures));
    EXPECT_DOUBLE_EQ(mount.time,
                     o.mount_time + o.step_time * static_cast<double>(mount.readings()));
  }
  EXPECT_LE(plan.after().rms, 0.01);
  EXPECT_GE(plan.mounts.size(), 3u);
}

TEST(Plan, ABetterErrorTakesNoLessTimeAndSlowerMountsNoMoreOfThem) {
  const ExpectedMuscle m = muscle();
  PlanOptions o = options();
  double time = 0;
  for (const double error : {0.03, 0.02, 0.012, 0.009}) {
    o.error = error;
    const MeasurementPlan plan = plan_measurements(m, region_of(m), o);
    ASSERT_TRUE(plan.reached) << error;
    EXPECT_GE(plan.time(), 0.95 * time) << error;
    time = plan.time();
  }
  o.mount_time = 60;
  const std::size_t quick = plan_measurements(m, region_of(m), o).mounts.size();
  o.mount_time = 3600;
  EXPECT_LE(plan_measurements(m, region_of(m), o).mounts.size(), quick);
}

// The exchange is no worse than the same number of evenly spread lengths and pressures.
TEST(Plan, IsNoWorseThanAnEvenOne) {
  const ExpectedMuscle m = muscle();
  const PlanOptions o = options();
  const PlanRegion region = region_of(m);
  const MeasurementPlan plan = plan_measurements(m, region, o);
  const DesignSpace space(m, region, o);
  Information even = space.before();
  const auto n = static_cast<double>(plan.mounts.size());
  for (std::size_t i = 0; i < plan.mounts.size(); ++i) {
    const double length =
        region.shortest + static_cast<double>(i) / (n - 1) * (region.longest - region.shortest);
    even += space.of(length, space.even_pressures(length, plan.mounts[i].pressures.size()));
  }
  EXPECT_LE(plan.after().rms, 1.001 * space.error(even).rms);
}

TEST(Plan, WhatNoPlanReachesIsReportedAsNotReached) {
  PlanOptions o = options();
  o.noise = 300;
  o.error = 0.006;
  EXPECT_FALSE(plan_measurements(muscle(), region_of(muscle()), o).reached);
}

// Existing mounts count, and are not planned again.
TEST(Plan, WhatIsMeasuredAlreadyIsNotPlannedAgain) {
  const ExpectedMuscle m = muscle();
  PlanOptions o = options();
  o.error = 0.01;
  const MeasurementPlan whole = plan_measurements(m, region_of(m), o);
  std::vector<MeasuredMount> half;
  for (const PlannedMount& mount : whole.mounts) {
    if (half.size() == 2) break;
    half.push_back({.length = mount.length});
    for (const Branch branch : {Branch::fill, Branch::vent})
      for (const double p : mount.pressures)
        if (branch == Branch::fill || p != mount.pressures.back())
          half.back().points.push_back({.length = mount.length,
                                        .pressure = p,
                                        .rest_length = m.scales.rest_length,
                                        .branch = branch});
  }
  const MeasurementPlan next = plan_measurements(m, region_of(m), o, half);
  EXPECT_NEAR(next.before.rms, whole.mounts[1].after.rms, 1e-9);
  EXPECT_TRUE(next.reached);
  EXPECT_LT(next.time(), whole.time());
  // All mounts of the plan exist: nothing remains to be measured.
  std::vector<MeasuredMount> all = half;
  all.push_back(half[0]);
  o.error = 0.5;
  EXPECT_TRUE(plan_measurements(m, region_of(m), o, all).mounts.empty());
}

TEST(Plan, OfPointsOfSeveralMusclesIsRefused) {
  const std::vector<StaticPoint> points{{.length = 0.2, .rest_length = 0.2},
                                        {.length = 0.2, .rest_length = 0.25}};
  EXPECT_THROW(muscle_by_points(points, 101325, {}), Refusal);
}

}  // namespace
}  // namespace sinew::identify::plan_test
