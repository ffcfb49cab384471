// Information of readings: closed forms for straight lines and for common errors of readings.
#include "sinew/identify/plan/information.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace sinew::identify::knowledge_test {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

// The variance of a straight line a + b x is s^2 (1/n + (x - mean)^2/sum (x_i - mean)^2), which is
// s^2 x'(X'X)^-1 x.
TEST(Information, OfAStraightLineIsTheClosedForm) {
  const std::vector<double> at{0, 1, 2, 5, 9};
  constexpr double s = 0.7;
  std::vector<PlannedReading> readings;
  double mean = 0, squares = 0;
  for (const double x : at) {
    readings.push_back({.slopes = {1, x}});
    mean += x / 5;
  }
  for (const double x : at) squares += (x - mean) * (x - mean);

  Information known(std::vector<double>{unknown, unknown});
  known += Information::of_mount(readings, s, 2);
  for (const double x : {-3.0, 0.0, 3.4, 20.0}) {
    const std::vector<std::vector<double>> place{{1, x}};
    EXPECT_NEAR(known.variances(place)[0], s * s * (1 / 5.0 + (x - mean) * (x - mean) / squares),
                1e-12);
  }
}

// n readings of one value with a common error t: s^2/n + t^2. Two such mounts halve it.
TEST(Information, AnErrorThatReadingsShareIsNotAveragedAway) {
  constexpr double s = 2, t = 0.5;
  const std::vector<std::vector<double>> place{{1}};
  for (const int n : {1, 4, 100}) {
    const std::vector<PlannedReading> readings(static_cast<std::size_t>(n), {{1}, {t}});
    const Information mount = Information::of_mount(readings, s, 1);
    Information known(std::vector<double>{unknown});
    known += mount;
    EXPECT_NEAR(known.variances(place)[0], s * s / n + t * t, 1e-9);
    known += mount;
    EXPECT_NEAR(known.variances(place)[0], 0.5 * (s * s / n + t * t), 1e-9);
  }
}

// Two independent sources for one value: 1/var = 1/d^2 + 1/s^2.
TEST(Information, WhatIsKnownBeforehandCountsAsAReading) {
  Information known(std::vector<double>{3});
  EXPECT_NEAR(known.variances(std::vector<std::vector<double>>{{2}})[0], 4 * 9, 1e-12);
  known += Information::of_mount(std::vector<PlannedReading>{{{1}, {}}}, 2, 1);
  EXPECT_NEAR(known.variances(std::vector<std::vector<double>>{{1}})[0], 1 / (1 / 9.0 + 1 / 4.0),
              1e-12);
}

TEST(Information, OfWhatIsNotDeterminedIsNone) {
  Information known(std::vector<double>{unknown, unknown});
  known += Information::of_mount(std::vector<PlannedReading>{{{1, 2}, {}}, {{2, 4}, {}}}, 1, 2);
  EXPECT_EQ(known.variances(std::vector<std::vector<double>>{{1, 0}})[0], unknown);
}

// A further reading or mount never makes a prediction worse, at any place.
TEST(Information, MoreReadingsNeverRaiseAVariance) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto row = [&](std::size_t n) {
    std::vector<double> out;
    for (std::size_t i = 0; i < n; ++i) out.push_back(normal(random));
    return out;
  };
  std::vector<std::vector<double>> places;
  for (int i = 0; i < 20; ++i) places.push_back(row(4));
  for (int trial = 0; trial < 50; ++trial) {
    Information base(std::vector<double>(4, 2.0));
    std::vector<PlannedReading> readings;
    std::vector<double> before = base.variances(places);
    for (int i = 0; i < 6; ++i) {
      readings.push_back({row(4), row(2)});
      Information known = base;
      known += Information::of_mount(readings, 0.3, 4);
      const std::vector<double> after = known.variances(places);
      for (std::size_t k = 0; k < places.size(); ++k) EXPECT_LE(after[k], before[k] * (1 + 1e-9));
      before = after;
    }
  }
}

}  // namespace
}  // namespace sinew::identify::knowledge_test
