// Intervals of predicted forces have the stated coverage.
#include "sinew/identify/actuator/static_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/prediction.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/actuator/test_muscle.h"

namespace sinew::identify::static_spread_test {
namespace {

// Measures muscles of some rest lengths: seven lengths, ten pressures, noise [N].
std::vector<StaticPoint> measure(const std::vector<double>& rest_lengths, double noise,
                                 unsigned seed, double offset = 0) {
  const StaticSetting truth = test_muscle();
  const StaticScales scales{.rest_length = test_rest_length, .atmosphere = units::atmosphere};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> scatter(0, noise);
  std::vector<StaticPoint> out;
  for (const double rest : rest_lengths)
    for (int i = 0; i < 7; ++i)
      for (int k = 0; k < 10; ++k) {
        StaticPoint p{.length = rest * (0.82 + 0.03 * (i + offset)),
                      .pressure = 1e5 + 5e4 * (k + offset),
                      .rest_length = rest};
        p.force = std::max(0.0, predicted(truth, scales, p) + scatter(random));
        out.push_back(p);
      }
  return out;
}

StaticResult fit_of(const std::vector<StaticPoint>& points, const std::string& model) {
  StaticData data;
  data.points = points;
  return identify_static(data, {.model = model});
}

// Averages of 20 readings with noise of 5 N: half-widths are those of measured forces.
TEST(Spread, HalfWidthsOfAveragesContainReadings) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0, 5);
  StaticData data;
  for (const double contraction : {0.0, 0.01, 0.02, 0.035, 0.05, 0.08, 0.12, 0.16})
    for (double p = 1e5; p <= 6.5e5; p += 0.5e5) {
      StaticPoint point{.length = test_rest_length * (1 - contraction),
                        .pressure = p,
                        .rest_length = test_rest_length,
                        .weight = 20};
      point.force = predicted(test_muscle(), {.rest_length = test_rest_length}, point);
      double sum = 0, squares = 0;
      for (int k = 0; k < 20; ++k) {
        const double off = noise(random);
        sum += off / 20;
        squares += off * off / 20;
      }
      point.force += sum;
      point.variance = squares - sum * sum;
      data.points.push_back(point);
    }
  const StaticResult result = identify_static(data, {.model = "saturating-elastic"});
  const StaticForce f = predict(
      result,
      {.length = 0.95 * test_rest_length, .pressure = 4e5, .rest_length = test_rest_length});
  EXPECT_NEAR(f.half_95, 10, 1);
  EXPECT_NEAR(f.half_68, 5, 0.5);
}

TEST(Spread, QuantilesAreThoseOfTheNormalDistribution) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, 3);
  HeldOutErrors u;
  for (int i = 0; i < 20000; ++i) {
    u.residuals.push_back(normal(random));
    u.widths.push_back(3);
  }
  const Quantiles q = quantiles(u);
  EXPECT_NEAR(q.q68, 0.9945, 0.02);
  EXPECT_NEAR(q.q95, 1.96, 0.045);  // 3.4 standard errors
}

// Few points give no empirical 95th percentile; without points it is infinite.
TEST(Spread, FewPointsTakeStudentsFactorAndNoneAreInfinite) {
  const Quantiles q = quantiles({.residuals = {1, -1, 1, -1}, .widths = {2, 2, 2, 2}});
  EXPECT_NEAR(q.q95, 0.5 * t_quantile(4), 1e-12);
  EXPECT_TRUE(std::isinf(quantiles({}).q95));
}

// Without lengths that were left out, only the prior counts; errors equal to the prior leave it
// unchanged, one length has a quarter of the weight, and several soon outweigh it.
TEST(Spread, BetweenLengthsItGrowsWithWhatLengthsWereMissedBy) {
  const auto half_68 = [](const std::vector<LengthError>& missed) {
    StaticSpread spread;
    add_between(missed, 1000, spread);
    return spread.between_68 / 1000;
  };
  constexpr double c = 0.1;  // share of the largest force per root of the distance
  EXPECT_NEAR(half_68({}), c, 1e-12);
  const double a = 0.04, square = c * c * a;
  EXPECT_NEAR(half_68({{square, a}, {square, a}}), c, 1e-12);
  EXPECT_NEAR(half_68({{0, a}}), c * std::sqrt(3.0 / 4), 1e-12);
  EXPECT_NEAR(half_68({{0, a}, {0, a}}), c * std::sqrt(3.0 / 19), 1e-12);
  EXPECT_NEAR(half_68({{-square, a}, {0, a}}), half_68({{0, a}, {0, a}}), 1e-12);
  EXPECT_NEAR(half_68({{100 * square, a}}), c * std::sqrt(103.0 / 4), 1e-12);
  EXPECT_NEAR(half_68({{100 * square, 2 * a}}), c * std::sqrt(53.0 / 4), 1e-12);
  EXPECT_LT(half_68(std::vector<LengthError>(5, {0, a})), 0.1 * c);
}

// The width grows from a length to the middle of the gap, and is that of the fit at the length.
TEST(Spread, BetweenTwoLengthsItIsWidestHalfway) {
  const StaticResult found = fit_of(measure({0.25}, 3, 7), "saturating-elastic");
  const auto half = [&](double part) {
    return predict(found,
                   {.length = 0.25 * (0.91 + 0.03 * part), .pressure = 3e5, .rest_length = 0.25})
        .half_95;
  };
  EXPECT_GT(half(0.25), half(0));
  EXPECT_GT(half(0.5), half(0.25));
  EXPECT_GT(half(0.5), half(0.75));
  EXPECT_NEAR(std::hypot(half(0), std::sqrt(0.5 * 0.03) * form_95 * found.spread.between_68),
              half(0.5), 0.1 * half(0));

  // The file gives approximately the same.
  actuator::Prediction p = prediction_of(found, found.muscles[0]);
  EXPECT_EQ(p.lengths.size(), 7u);
  EXPECT_NEAR(actuator::force_interval(p, 0.25 * 0.91, 3e5, 0).half_95, half(0), 0.2 * half(0));
  EXPECT_NEAR(actuator::force_interval(p, 0.25 * 0.925, 3e5, 0).half_95, half(0.5),
              0.2 * half(0.5));
}

// New measurements of forces between the fitted ones, in 12 rigs: 92 to 98 % are within the 95 %
// interval.
TEST(Spread, IntervalsHoldTheShareTheySay) {
  int all = 0, in_68 = 0, in_95 = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const StaticResult found = fit_of(measure({0.25}, 3, seed), "saturating-elastic");
    for (const StaticPoint& p : measure({0.25}, 3, 1000 + seed, 0.5)) {
      if (p.length > 0.25 || p.pressure > 5.5e5 || !(p.force > 0)) continue;
      const StaticForce f = predict(found, p);
      const double off = std::abs(f.force - p.force);
      ++all;
      in_68 += off <= f.half_68;
      in_95 += off <= f.half_95;
    }
  }
  EXPECT_GT(all, 500);
  EXPECT_NEAR(100.0 * in_95 / all, 95, 3);
  EXPECT_NEAR(100.0 * in_68 / all, 68, 6);
}

TEST(Spread, IntervalsGrowOutsideTheData) {
  const StaticResult found = fit_of(measure({0.25}, 3, 7), "saturating-elastic");
  const auto half = [&](double length, double pressure) {
    return predict(found, {.length = length, .pressure = pressure, .rest_length = 0.25});
  };
  const StaticForce inside = half(0.23, 3e5);
  double before = inside.half_95;
  EXPECT_EQ(inside.kind, PredictionKind::inside);
  for (const double pressure : {5.8e5, 6.6e5, 8e5}) {
    const StaticForce f = half(0.23, pressure);
    EXPECT_EQ(f.kind, PredictionKind::beyond);
    EXPECT_GT(f.half_95, before);
    EXPECT_GT(f.half_95, f.half_68);
    before = f.half_95;
  }
  EXPECT_TRUE(std::isinf(half(0.252, 3e5).half_95));  // beyond the longest
}

// Each of three muscles of one make is predicted without using it.
TEST(Spread, MusclesOfOneMakePredictEachOther) {
  const auto points = measure({0.15, 0.25, 0.35}, 2, 3);
  StaticData data;
  data.points = points;
  const StaticResult found =
      identify_static(data, {.model = "saturating-elastic", .hold_out = HoldOut::muscle});
  ASSERT_TRUE(found.report.best().held_out);
  EXPECT_EQ(found.report.best().held_out->points, points.size());
  EXPECT_LT(found.report.best().held_out->rmse_percent, 1.5);
  EXPECT_GT(found.spread.other_share_95, 0);
  EXPECT_NEAR(found.spread.other_reach, std::log(0.25 / 0.15), 1e-9);

  // A muscle of a length between them was not measured: its true forces are within the interval.
  const auto unseen = measure({0.2}, 0, 1);
  int in = 0;
  for (const StaticPoint& p : unseen) {
    const StaticForce f = predict(found, p);
    EXPECT_EQ(f.kind, PredictionKind::other_muscle);
    in += std::abs(f.force - p.force) <= f.half_95;
  }
  EXPECT_GE(in, 65);  // of 70
}

TEST(Spread, OneMuscleDeterminesNothingOfOthers) {
  const StaticResult found = fit_of(measure({0.25}, 3, 7), "saturating");
  const StaticForce f = predict(found, {.length = 0.17, .pressure = 3e5, .rest_length = 0.18});
  EXPECT_GT(f.force, 0);
  EXPECT_TRUE(std::isinf(f.half_95));
  EXPECT_EQ(prediction_of(found, muscle_of(found, 0.18)).inside_95, 0);
}

}  // namespace
}  // namespace sinew::identify::static_spread_test
