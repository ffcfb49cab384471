// Intervals of measured forces: narrowest at measured lengths, wider between and beyond.
#include "sinew/actuator/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::actuator::prediction_test {
namespace {

// Four lengths of which the middle two are furthest apart.
Prediction known() {
  return {.rest_length = 0.25,
          .lengths = {0.20, 0.21, 0.24, 0.25},
          .lowest = 1e5,
          .highest = 5e5,
          .inside_68 = 1,
          .inside_95 = 3,
          .between_68 = 2,
          .between_95 = 5,
          .beyond_68 = 4,
          .beyond_95 = 11,
          .above_68 = 2,
          .above_95 = 7};
}

double half_95(const Prediction& p, double length, double pressure = 3e5) {
  return force_interval(p, length, pressure, 0).half_95;
}

TEST(Prediction, EveryHalfWidthIsAtItsPlaceInTheReport) {
  const Prediction p = known();
  for (const double length : p.lengths) EXPECT_EQ(half_95(p, length), 3);
  EXPECT_NEAR(half_95(p, 0.225), 5, 1e-12);        // halfway in the widest gap
  EXPECT_NEAR(half_95(p, 0.19), 11, 1e-12);        // a fifth of the range beyond
  EXPECT_NEAR(half_95(p, 0.24, 5.8e5), 7, 1e-12);  // a fifth of their range beyond the pressures
  EXPECT_NEAR(half_95(p, 0.24, 0.2e5), 7, 1e-12);
  EXPECT_NEAR(half_95(p, 0.19, 5.8e5), 11, 1e-12);  // the larger of both
  const ForceInterval halfway = force_interval(p, 0.225, 3e5, 0);
  EXPECT_NEAR(halfway.half_68, 2, 1e-12);
  EXPECT_TRUE(halfway.measured && halfway.known);
  EXPECT_FALSE(force_interval(p, 0.19, 3e5, 0).measured);
}

// A share of the force adds as a square, at every length and pressure.
TEST(Prediction, AShareOfTheForceAdds) {
  Prediction p = known();
  p.per_force_95 = 0.04;
  EXPECT_NEAR(force_interval(p, 0.21, 3e5, 100).half_95, 5, 1e-12);
  EXPECT_NEAR(force_interval(p, 0.225, 3e5, 300).half_95, 13, 1e-12);
  EXPECT_NEAR(widest_inside_95(p, 300), 13, 1e-12);
}

// Squares add: an error of the law's form, a random walk between two lengths, and one of the fit.
// The variance of a random walk in the middle of a gap grows with the gap.
TEST(Prediction, BetweenLengthsSquaresGrowWithTheHarmonicMeanOfTheDistances) {
  const Prediction p = known();
  for (double away = 0; away < 0.015; away += 0.001) {
    const double part = away * (0.03 - away) / (0.015 * 0.015);
    const double wanted = std::sqrt(9 + 16 * part);
    EXPECT_NEAR(half_95(p, 0.21 + away), wanted, 1e-12);
    EXPECT_NEAR(half_95(p, 0.24 - away), wanted, 1e-12);
  }
  EXPECT_NEAR(half_95(p, 0.205), std::sqrt(9 + 16.0 / 3), 1e-12);
}

// In either direction and from any start beyond the ends, the interval never shrinks.
TEST(Prediction, NothingShrinksOnTheWayOut) {
  const Prediction p = known();
  for (const double length : {0.2, 0.205, 0.225, 0.25})
    for (const double end : {1e5, 5e5}) {
      double before = half_95(p, length, end);
      for (double off = 0; off < 3e5; off += 1e3) {
        const double now = half_95(p, length, end + (end > 3e5 ? off : -off));
        EXPECT_GE(now, before - 1e-12);
        EXPECT_LT(now, before + 0.1);
        before = now;
      }
    }
  for (double off = 0, before = 3; off < 0.04; off += 1e-4) {
    EXPECT_GE(half_95(p, 0.2 - off), before - 1e-12);
    before = half_95(p, 0.2 - off);
  }
}

TEST(Prediction, WhatNobodyTriedIsNotKnown) {
  Prediction p = known();
  EXPECT_FALSE(force_interval(p, 0.31, 3e5, 0).known);  // more than a range beyond
  p.beyond_68 = p.beyond_95 = 0;
  EXPECT_FALSE(force_interval(p, 0.19, 3e5, 0).known);
  EXPECT_TRUE(force_interval(p, 0.25, 5.1e5, 0).known);
  p.above_68 = p.above_95 = 0;
  EXPECT_FALSE(force_interval(p, 0.25, 5.1e5, 0).known);
  EXPECT_TRUE(force_interval(p, 0.225, 3e5, 0).known);
  p.between_68 = p.between_95 = 0;
  EXPECT_FALSE(force_interval(p, 0.225, 3e5, 0).known);
  EXPECT_EQ(half_95(p, 0.2405), 3);  // the length that was measured, within 0.4 %
  EXPECT_FALSE(force_interval({}, 0.2, 3e5, 0).known);
}

// Beyond the longest mount the slope is unknown; within 0.4 % it is the same mount.
TEST(Prediction, BeyondTheLongestNothingIsKnown) {
  const Prediction p = known();
  EXPECT_FALSE(force_interval(p, 0.252, 3e5, 0).known);
  EXPECT_TRUE(force_interval(p, 0.2505, 3e5, 0).known);
  EXPECT_TRUE(force_interval(p, 0.198, 3e5, 0).known);
}

// One length: the interval at others is unknown.
TEST(Prediction, OneLengthSpeaksForItself) {
  Prediction p = known();
  p.lengths = {0.0762};
  EXPECT_EQ(half_95(p, 0.0762), 3);
  EXPECT_EQ(half_95(p, 3 * 0.0254), 3);  // 3 in: another double
  p.lengths = {0.25};
  EXPECT_FALSE(force_interval(p, 0.24, 3e5, 0).known);
}

}  // namespace
}  // namespace sinew::actuator::prediction_test
