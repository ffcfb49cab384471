// Intervals of measured forces: narrowest where it was measured, wider between and beyond.
#include "sinew/actuator/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::actuator {
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
          .beyond_95 = 11};
}

double half_95(const Prediction& p, double length, double pressure = 3e5) {
  return force_interval(p, length, pressure).half_95;
}

TEST(Prediction, EveryHalfWidthStandsWhereItIsToldOf) {
  const Prediction p = known();
  for (const double length : p.lengths) EXPECT_EQ(half_95(p, length), 3);
  EXPECT_NEAR(half_95(p, 0.225), 5, 1e-12);  // halfway in the widest gap
  EXPECT_NEAR(half_95(p, 0.26), 11, 1e-12);  // a fifth of the range beyond
  EXPECT_NEAR(half_95(p, 0.19), 11, 1e-12);
  EXPECT_NEAR(half_95(p, 0.24, 5.8e5), 11, 1e-12);
  const ForceInterval halfway = force_interval(p, 0.225, 3e5);
  EXPECT_NEAR(halfway.half_68, 2, 1e-12);
  EXPECT_TRUE(halfway.measured && halfway.known);
  EXPECT_FALSE(force_interval(p, 0.26, 3e5).measured);
}

// Squares add: an error of the law's form, which grows with the distance, and one of the fit.
TEST(Prediction, BetweenLengthsSquaresGrowWithTheSquareOfTheDistance) {
  const Prediction p = known();
  for (double away = 0; away < 0.015; away += 0.001) {
    const double part = away / 0.015;
    const double wanted = std::sqrt(9 + 16 * part * part);
    EXPECT_NEAR(half_95(p, 0.21 + away), wanted, 1e-12);
    EXPECT_NEAR(half_95(p, 0.24 - away), wanted, 1e-12);
    if (away <= 0.005) {
      EXPECT_NEAR(half_95(p, 0.20 + away), wanted, 1e-12);
    }
  }
}

TEST(Prediction, WhatNobodyTriedIsNotKnown) {
  Prediction p = known();
  EXPECT_FALSE(force_interval(p, 0.31, 3e5).known);  // more than a range beyond
  p.beyond_68 = p.beyond_95 = 0;
  EXPECT_FALSE(force_interval(p, 0.26, 3e5).known);
  EXPECT_TRUE(force_interval(p, 0.225, 3e5).known);
  p.between_68 = p.between_95 = 0;
  EXPECT_FALSE(force_interval(p, 0.225, 3e5).known);
  EXPECT_EQ(half_95(p, 0.2405), 3);  // the length that was measured, within 0.4 %
  EXPECT_FALSE(force_interval({}, 0.2, 3e5).known);
}

// One length: nothing is known of others.
TEST(Prediction, OneLengthSpeaksForItself) {
  Prediction p = known();
  p.lengths = {0.25};
  EXPECT_EQ(half_95(p, 0.25), 3);
  EXPECT_FALSE(force_interval(p, 0.24, 3e5).known);
}

}  // namespace
}  // namespace sinew::actuator
