// Static laws: known ones are identified from noisy points in any order and unit; problems are
// reported.
#include "sinew/identify/actuator/static.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/test_muscle.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::static_test {
namespace {

constexpr double bar = 1e5, rest = test_rest_length;

StaticSetting truth() { return test_muscle(); }

struct Noise {
  double force = 0, pressure = 0, length = 0;
};

Noise real_noise() { return {.force = 0.003 * 540, .pressure = 500, .length = 1e-4}; }

std::vector<StaticPoint> measured(const StaticSetting& s, unsigned seed, const Noise& noise,
                                  const std::vector<double>& contractions) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const StaticScales scales{.rest_length = rest};
  std::vector<StaticPoint> out;
  for (const double contraction : contractions)
    for (double p = 0.5 * bar; p <= 6.5 * bar; p += 0.5 * bar) {
      StaticPoint point{.length = rest * (1 - contraction), .pressure = p, .rest_length = rest};
      point.force = predicted(s, scales, point) + noise.force * normal(random);
      point.pressure += noise.pressure * normal(random);
      point.length += noise.length * normal(random);
      out.push_back(point);
    }
  return out;
}

const std::vector<double> many = {0, 0.01, 0.02, 0.035, 0.05, 0.08, 0.12, 0.16};

StaticScales scales_for(const std::vector<StaticPoint>& points) {
  StaticScales out{.rest_length = rest};
  for (const StaticPoint& p : points) {
    out.full_scale = std::max(out.full_scale, p.force);
    out.top_pressure = std::max(out.top_pressure, p.pressure);
  }
  return out;
}

std::vector<FreeParameter> free_parameters_named(const std::string& name) {
  for (const StaticModel& m : static_models())
    if (m.name == name) return free_parameters_of(m, {});
  return {};
}

// --- known laws are recovered ---

TEST(Static, WithoutNoiseTheLawComesBack) {
  const std::vector<StaticPoint> points = measured(truth(), 1, {}, many);
  const StaticFit fit =
      fit_static(free_parameters_named("saturating-elastic"), points, scales_for(points));
  StaticSetting found = fit.setting, right = truth();
  for (const FreeParameter free_parameter : fit.free_parameters)
    EXPECT_NEAR(value_of(found, free_parameter) / value_of(right, free_parameter), 1, 0.02)
        << key_of(free_parameter);
  EXPECT_LT(score(residuals_of(fit.setting, scales_for(points), points), 540).max_percent, 0.1);
}

// The toe does not show where a muscle pulls strongly: its error stays that of the prior for single
// readings, and for averages of which each has 25 readings with this noise.
TEST(Static, APriorKeepsItsDeviationForReadingsAndForAverages) {
  for (const double readings : {1.0, 25.0}) {
    std::mt19937_64 random(8);
    std::normal_distribution<double> noise(0, 5);
    std::vector<StaticPoint> points;
    for (StaticPoint p : measured(truth(), 1, {}, {0, 0.01, 0.02, 0.035, 0.05})) {
      if (p.pressure < 2.9 * bar) continue;
      p.force += noise(random) / std::sqrt(readings);
      p.weight = readings;
      p.variance = 25 * (1 - 1 / readings);
      points.push_back(p);
    }
    const StaticScales scales = scales_for(points);
    const StaticFit fit = fit_static(free_parameters_named("saturating-toe"), points, scales);
    const Estimate& e = fit.solution["toe_tension"];
    const double deviation = prior_of(FreeParameter::toe, scales)->deviation_at(e.value);
    EXPECT_NEAR(e.standard_error, deviation, 0.2 * deviation) << readings;
  }
}

// A constant setting that a logger reads 30 times is one reading: the intervals are those of the
// settings, within a fifth.
TEST(Static, AHeldSettingIsOneReading) {
  const std::vector<FreeParameter> free_parameters = free_parameters_named("saturating-elastic");
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const std::vector<StaticPoint> once = measured(truth(), seed, real_noise(), many);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<StaticPoint> held;
    for (const StaticPoint& point : once)
      for (int k = 0; k < 30; ++k) {
        held.push_back(point);
        held.back().force += 0.02 * normal(random);
        held.back().pressure += 20 * normal(random);
        held.back().length += 1e-6 * normal(random);
      }
    const StaticFit few = fit_static(free_parameters, once, scales_for(once)),
                    all = fit_static(free_parameters, held, scales_for(held));
    for (std::size_t i = 0; i < free_parameters.size(); ++i) {
      const Estimate &one = few.solution.estimates[i], &many_times = all.solution.estimates[i];
      if (!one.identifiable || !many_times.identifiable) continue;
      EXPECT_GT(many_times.high - many_times.low, 0.8 * (one.high - one.low))
          << key_of(free_parameters[i]);
      EXPECT_LT(many_times.high - many_times.low, 1.25 * (one.high - one.low))
          << key_of(free_parameters[i]);
    }
  }
}

// Noise: force 0.3 % of full scale, pressure 0.5 kPa, length 0.1 mm. The 95 % intervals of
// identifiable parameters contain the truth in 90 to 99 % of 200 trials, and the mean is correct
// within 1 %.
TEST(Static, IntervalsCoverTheTruth) {
  const std::vector<FreeParameter> free_parameters = free_parameters_named("saturating-elastic");
  std::vector<int> covered(free_parameters.size()), seen(free_parameters.size());
  std::vector<double> sum(free_parameters.size());
  StaticSetting right = truth();
  constexpr int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    const auto points = measured(truth(), 100 + static_cast<unsigned>(trial), real_noise(), many);
    const StaticFit fit = fit_static(free_parameters, points, scales_for(points));
    for (std::size_t i = 0; i < free_parameters.size(); ++i) {
      const Estimate& e = fit.solution.estimates[i];
      const double value = value_of(right, free_parameters[i]);
      seen[i] += e.identifiable;
      covered[i] += e.identifiable && e.low <= value && value <= e.high;
      sum[i] += e.value;
    }
  }
  for (std::size_t i = 0; i < free_parameters.size(); ++i) {
    const double value = value_of(right, free_parameters[i]);
    ASSERT_GT(seen[i], trials / 2) << key_of(free_parameters[i]);
    EXPECT_GE(covered[i], 0.90 * seen[i]) << key_of(free_parameters[i]);
    EXPECT_LE(covered[i], 0.99 * seen[i]) << key_of(free_parameters[i]);
    EXPECT_NEAR(sum[i] / trials / value, 1, 0.01) << key_of(free_parameters[i]);
  }
}

// Two lengths do not determine the saturation of a bladder: it stays at its prior, which is noted.
TEST(Static, WhatTheDataDoNotSayIsNotIdentifiable) {
  const auto points = measured(truth(), 3, real_noise(), {0.08, 0.12, 0.16});
  const StaticFit fit =
      fit_static(free_parameters_named("saturating-elastic"), points, scales_for(points));
  const auto at = std::find(fit.free_parameters.begin(), fit.free_parameters.end(),
                            FreeParameter::saturation_length);
  const Estimate& e =
      fit.solution.estimates[static_cast<std::size_t>(at - fit.free_parameters.begin())];
  EXPECT_FALSE(e.identifiable);
  EXPECT_NE(std::find(fit.unknown.begin(), fit.unknown.end(), FreeParameter::saturation_length),
            fit.unknown.end());
}

// --- invariances ---

StaticResult identify(const std::vector<StaticPoint>& points, const std::string& model = "") {
  StaticOptions options;
  options.model = model;
  return identify_static({.points = points}, options);
}

TEST(Static, OrderOfTheRowsDoesNotMatter) {
  std::vector<StaticPoint> points = measured(truth(), 4, real_noise(), many);
  const StaticResult before = identify(points, "saturating");
  std::mt19937_64 random(5);
  std::shuffle(points.begin(), points.end(), random);
  const StaticResult after = identify(points, "saturating");
  EXPECT_EQ(before.fit.solution.values, after.fit.solution.values);
  EXPECT_EQ(before.report.best().cross_validated->rmse, after.report.best().cross_validated->rmse);
}

TEST(Static, SlackPointsSayNoMoreThanThat) {
  std::vector<StaticPoint> points = measured(truth(), 6, real_noise(), many);
  const auto fit = [&] {
    return fit_static(free_parameters_named("saturating-elastic"), points, scales_for(points))
        .setting;
  };
  StaticSetting before = fit();
  for (int i = 0; i < 200; ++i)
    points.push_back({.length = rest * 0.75, .pressure = 0.5 * bar + 500 * i, .rest_length = rest});
  StaticSetting after = fit();
  for (const FreeParameter free_parameter : free_parameters_named("saturating-elastic"))
    EXPECT_NEAR(value_of(after, free_parameter) / value_of(before, free_parameter), 1, 0.01)
        << key_of(free_parameter);
}

TEST(Static, OutliersCountLittle) {
  std::vector<StaticPoint> points = measured(truth(), 7, real_noise(), many);
  const StaticFit clean =
      fit_static(free_parameters_named("saturating-elastic"), points, scales_for(points));
  for (std::size_t i = 5; i < points.size(); i += 12) points[i].force += 80;
  const StaticFit fit =
      fit_static(free_parameters_named("saturating-elastic"), points, scales_for(points));
  EXPECT_GE(fit.outliers, points.size() / 13);
  for (std::size_t i = 0; i < fit.free_parameters.size(); ++i) {
    const Estimate& e = clean.solution.estimates[i];
    EXPECT_NEAR(fit.solution.values[i], e.value, 1.5 * (e.high - e.low)) << e.name;
  }
}

// A slipped decimal in a few points must not lead to a wrong law for all others.
TEST(Static, WildPointsDoNotChangeTheChoice) {
  std::vector<StaticPoint> points = measured(truth(), 11, real_noise(), many);
  const StaticOptions options{.diameter = actuator::diameter(truth().actuator.braid, rest)};
  const StaticResult clean = identify_static({.points = points}, options);
  EXPECT_TRUE(clean.report.warnings.empty());
  for (const std::size_t i : {20u, 33u, 47u}) points[i].force *= 3;
  const StaticResult wild = identify_static({.points = points}, options);
  EXPECT_EQ(wild.report.best().model, clean.report.best().model);
  EXPECT_LT(wild.report.best().fit.rmse_percent, 1.1 * clean.report.best().fit.rmse_percent);
  EXPECT_NEAR(wild.report.full_scale, clean.report.full_scale, 0.01 * clean.report.full_scale);
  ASSERT_EQ(wild.report.warnings.size(), 1u);
  EXPECT_NE(wild.report.warnings[0].find("3 of 104 points left out"), std::string::npos)
      << wild.report.warnings[0];
}

TEST(Static, HeldOutPointsHaveNoPartInTheFit) {
  std::vector<StaticPoint> points = measured(truth(), 8, real_noise(), many);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i].fitted = false;
  const StaticResult before = identify(points, "saturating");
  for (StaticPoint& p : points)
    if (!p.fitted) p.force *= 0.9;
  const StaticResult after = identify(points, "saturating");
  EXPECT_EQ(before.fit.solution.values, after.fit.solution.values);
  EXPECT_GT(after.report.best().held_out->rmse, before.report.best().held_out->rmse);
}

// --- choice of the model ---

// Data of a simple law are not explained by a complex one.
TEST(Static, TheLawThatMadeTheDataIsSimpleEnough) {
  StaticSetting s = truth();
  s.actuator.bladder = {};
  s.actuator.effectiveness.threshold = 0;
  const StaticResult found = identify(measured(s, 9, real_noise(), {0, 0.03, 0.06, 0.1, 0.15}));
  EXPECT_EQ(found.report.best().model, "ideal");
  EXPECT_LT(found.report.best().cross_validated->rmse_percent, 0.6);
}

// With fewer than two lengths between the ends a law whose bladder saturates is chosen, but only if
// it describes the data about as well as the best law.
TEST(Static, WithFewLengthsASaturatingBladderMustDescribeTheData) {
  StaticSetting without = truth();
  without.actuator.bladder = {};
  without.actuator.effectiveness = {.c1 = 3e-6};
  for (const std::vector<double>& few : {std::vector{0.0, 0.06, 0.14}, {0.0, 0.14}}) {
    const Noise noise{.force = 1};
    const Report simple = identify(measured(without, 11, noise, few)).report;
    EXPECT_FALSE(simple.best().model.starts_with("saturating")) << simple.rule;
    const Report saturating = identify(measured(truth(), 11, noise, few)).report;
    EXPECT_TRUE(saturating.best().model.starts_with("saturating")) << saturating.rule;
    EXPECT_TRUE(saturating.rule.starts_with("of the laws whose bladder saturates"));
  }
}

TEST(Static, ASaturatingBladderIsFound) {
  const StaticResult found = identify(measured(truth(), 10, real_noise(), many));
  EXPECT_TRUE(found.report.best().model.starts_with("saturating")) << found.report.rule;
  EXPECT_GE(found.report.fits.size(), 6u);
  for (const Fit& fit : found.report.fits) {
    EXPECT_FALSE(fit.law.empty());
    EXPECT_FALSE(fit.source.empty());
  }
}

// Filling and venting differ by 2 w.
TEST(Static, HalfWidthOfTheHysteresisComesBack) {
  for (const Noise& noise : {Noise{}, real_noise()}) {
    std::vector<StaticPoint> points;
    for (const Branch branch : {Branch::fill, Branch::vent})
      for (StaticPoint p : measured(truth(), 20 + static_cast<unsigned>(branch), noise, many)) {
        p.pressure += static_cast<int>(branch) * 4000;
        p.branch = branch;
        points.push_back(p);
      }
    const StaticResult found = identify(points, "saturating-elastic");
    const Estimate& e = found.fit.solution["half_width"];
    EXPECT_NEAR(e.value, 4000, noise.force > 0 ? 2 * (e.high - e.value) : 40);
    EXPECT_EQ(found.muscles[0].actuator.hysteresis.half_width, e.value);
  }
}

// Returns a fit to both branches of a muscle; `branched` changes a point for its branch.
template <class Branched>
StaticResult of_both_branches(Branched branched) {
  std::vector<StaticPoint> points;
  for (const Branch branch : {Branch::fill, Branch::vent})
    for (StaticPoint p : measured(truth(), 20 + static_cast<unsigned>(branch), {}, many)) {
      p.branch = branch;
      branched(p);
      points.push_back(p);
    }
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, 0.002 * 540);
  for (StaticPoint& p : points) p.force += noise(random);
  return identify(points, "saturating-elastic");
}

// Friction of 2.5 % of the pressure is within an interval of a fifth of it; without friction
// none is found.
TEST(Static, HysteresisThatGrowsWithThePressureComesBack) {
  for (const double share : {0.025, 0.0}) {
    StaticSetting s = truth();
    s.actuator.hysteresis.width_per_pressure = share;
    const StaticResult found =
        of_both_branches([&](StaticPoint& p) { p.force = predicted(s, {.rest_length = rest}, p); });
    const Estimate& e = found.fit.solution["width_per_pressure"];
    EXPECT_LE(e.low, share);
    EXPECT_GE(e.high, share);
    EXPECT_LE(e.high - e.low, 0.2 * 0.025);
    EXPECT_EQ(found.muscles[0].actuator.hysteresis.width_per_pressure, e.value);
  }
}

// Friction of 2.5 % of the force is within its interval, which zero is not, and is pinned; the
// other two parts may be zero. The loop by the muscle's file is that of the muscle within a
// twentieth.
TEST(Static, HysteresisThatGrowsWithTheForceComesBack) {
  const StaticResult found =
      of_both_branches([](StaticPoint& p) { p.force *= 1 - 0.025 * static_cast<int>(p.branch); });
  int shares = 0;
  for (const Estimate& e : found.report.best().parameters) {
    if (e.name != "width_per_tension" && e.name != "width_per_pressure") continue;
    const bool is_share = e.name == "width_per_tension";
    EXPECT_LE(e.at_bound ? 0 : e.low, is_share ? 0.025 : 0);
    EXPECT_GE(e.at_bound ? 0 : e.high, is_share ? 0.025 : 0);
    if (!is_share) continue;
    ++shares;
    EXPECT_GT(e.low, 0.01);
    ASSERT_TRUE(e.profile);
    EXPECT_TRUE(e.profile->pinned);
    EXPECT_EQ(found.muscles[0].actuator.hysteresis.width_per_tension, e.value);
  }
  EXPECT_EQ(shares, 1);
  for (const double contraction : {0.0, 0.05, 0.12}) {
    StaticPoint p{.length = rest * (1 - contraction), .pressure = 6 * bar, .rest_length = rest};
    const double loop = 0.05 * predicted(truth(), {.rest_length = rest}, p);
    double found_loop = 0;
    for (const Branch branch : {Branch::fill, Branch::vent}) {
      p.branch = branch;
      found_loop -= static_cast<int>(branch) *
                    law_force(found.muscles[0].actuator, p.length, p, units::atmosphere);
    }
    EXPECT_NEAR(found_loop, loop, 0.05 * loop) << contraction;
  }
}

// A file holds at most 0.4 of the force: friction beyond that ends there.
TEST(Static, HysteresisThatGrowsWithTheForceFitsIntoAFile) {
  const StaticResult found =
      of_both_branches([](StaticPoint& p) { p.force *= 1 - 0.55 * static_cast<int>(p.branch); });
  const double share = found.muscles[0].actuator.hysteresis.width_per_tension;
  EXPECT_GT(share, 0.2);
  EXPECT_LE(share, 0.4);
}

// A file holds widths that grow by less than the pressure: friction beyond that ends there too.
TEST(Static, HysteresisOfPressureAndForceFitsIntoAFile) {
  StaticSetting s = truth();
  s.actuator.hysteresis = {.width_per_pressure = 0.5, .width_per_tension = 0.35};
  const StaticResult found =
      of_both_branches([&](StaticPoint& p) { p.force = predicted(s, {.rest_length = rest}, p); });
  const actuator::Actuator read = without_idle_digits(found.muscles[0].actuator);
  EXPECT_GT(actuator::width_growth(read.hysteresis), 0.9);
  EXPECT_LT(actuator::width_growth(read.hysteresis), actuator::most_width_growth);
}

// Three muscles of one make, whose ends take the same length from each.
TEST(Static, TheRestLengthsEffectComesBack) {
  StaticSetting s = truth();
  s.end_loss = 0.02;
  const StaticScales scales{.rest_length = rest};
  std::vector<StaticPoint> points;
  for (const double length : {0.1, 0.15, 0.25})
    for (StaticPoint p : measured(truth(), 12, {}, many)) {
      p.length *= length / rest;
      p.rest_length = length;
      p.force = predicted(s, scales, p);
      points.push_back(p);
    }
  const StaticResult found = identify(points, "saturating-elastic");
  EXPECT_EQ(found.muscles.size(), 3u);
  EXPECT_EQ(found.muscles[0].rest_length, 0.25);
  EXPECT_NEAR(found.fit.setting.end_loss, 0.02, 0.002);
  EXPECT_LT(found.report.best().fit.max_percent, 0.5);
}

// Beyond the measured range the force is bounded, and never falls with the pressure.
TEST(Static, OutsideTheDataItStaysBoundedAndMonotone) {
  const auto points = measured(truth(), 13, real_noise(), many);
  for (const char* model : {"effectiveness-quadratic", "taper", "elastic-cubic", "saturating"}) {
    const StaticResult found = identify(points, model);
    const std::string file = static_file(found, found.muscles[0], "m", "a test", "");
    EXPECT_NE(file.find("valid"), file.npos);
    actuator::Actuator a = found.muscles[0].actuator;
    a.effectiveness.valid_from = found.muscles[0].lowest;
    a.effectiveness.valid_to = found.muscles[0].highest;
    a.bladder.valid_from = found.muscles[0].lengths.front();
    a.bladder.valid_to = found.muscles[0].lengths.back();
    for (double l = 0.5 * rest; l < 1.1 * rest; l += 0.01 * rest) {
      double before = 0;
      for (double p = 0; p < 20 * bar; p += 0.1 * bar) {
        const double force = actuator::tension(a, l, 0, p, 101325);
        EXPECT_GE(force, before - 1e-9) << model << " " << l << " " << p;
        EXPECT_LT(force, 10 * 540);
        before = force;
      }
    }
  }
}

}  // namespace
}  // namespace sinew::identify::static_test
