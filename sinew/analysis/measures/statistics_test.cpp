#include "sinew/analysis/measures/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sinew::analysis::statistics_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double dt = 0.01;
const double nan_value = std::nan("");

std::vector<double> sampled(int n, double (*of)(double)) {
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(of(i * dt));
  return out;
}

std::vector<double> always(std::size_t n) { return std::vector<double>(n, dt); }

TEST(Statistics, RmsOfASineOverWholePeriodsIsItsAmplitudeByRootTwo) {
  const auto x = sampled(300, [](double t) { return 3.0 * std::sin(2 * pi * t); });
  EXPECT_NEAR(rms(x, always(300)), 3.0 / std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(mean(x, always(300)), 0.0, 1e-14);
}

TEST(Statistics, SamplesCountByTheirTime) {
  const std::vector<double> x = {1, 4}, seconds = {3, 1};
  EXPECT_DOUBLE_EQ(mean(x, seconds), 1.75);
  EXPECT_DOUBLE_EQ(deviation(x, seconds), std::sqrt((3 * 0.5625 + 5.0625) / 4));
}

TEST(Statistics, WhatIsNoNumberOrHasNoTimeIsLeftOut) {
  const std::vector<double> x = {nan_value, 2, 100, 4, std::numeric_limits<double>::infinity()};
  const std::vector<double> seconds = {1, 1, 0, 1, 1};
  EXPECT_DOUBLE_EQ(mean(x, seconds), 3);
  EXPECT_DOUBLE_EQ(smallest(x, seconds), 2);
  EXPECT_DOUBLE_EQ(largest(x, seconds), 4);
  EXPECT_DOUBLE_EQ(largest_magnitude(std::vector<double>{-5, 4}, std::vector<double>{1, 1}), 5);
}

TEST(Statistics, NothingLeftIsNotANumber) {
  const std::vector<double> x = {nan_value}, seconds = {1};
  for (const auto& statistic : {mean, rms, deviation, smallest, largest, largest_magnitude}) {
    EXPECT_TRUE(std::isnan(statistic(x, seconds)));
    EXPECT_TRUE(std::isnan(statistic({}, {})));
  }
}

TEST(HighPass, RemovesConstantsAndRamps) {
  const auto x = sampled(200, [](double t) { return 5.2 + 0.7 * t; });
  const auto out = high_passed(x, 10);
  for (std::size_t i = 10; i < 190; ++i) EXPECT_NEAR(out[i], 0, 1e-13);
}

TEST(HighPass, IsNotANumberWhereTheWindowIsNotWhole) {
  const auto out = high_passed(std::vector<double>(50, 1.0), 10);
  for (std::size_t i = 0; i < out.size(); ++i)
    EXPECT_EQ(std::isnan(out[i]), i < 10 || i >= 40) << i;
  for (const double x : high_passed(std::vector<double>(20, 1.0), 10)) EXPECT_TRUE(std::isnan(x));
}

// The gain of a sine is one less the mean of 2 half + 1 cosines about 0.
TEST(HighPass, PassesASineWithItsKnownGain) {
  for (const double period : {0.1, 0.21, 0.33, 1.0, 5.0}) {
    std::vector<double> x;
    for (int i = 0; i < 400; ++i) x.push_back(std::sin(2 * pi * i * dt / period));
    const double half_angle = pi * dt / period;
    const double gain = 1 - std::sin(21 * half_angle) / (21 * std::sin(half_angle));
    const auto out = high_passed(x, 10);
    for (std::size_t i = 10; i < 390; ++i) ASSERT_NEAR(out[i], gain * x[i], 1e-12) << period;
  }
}

TEST(HighPass, AMissingReadingCostsOneSample) {
  std::vector<double> x(60, 2.5);
  x[30] = nan_value;
  const auto out = high_passed(x, 10);
  for (std::size_t i = 10; i < 50; ++i)
    if (i == 30)
      EXPECT_TRUE(std::isnan(out[i]));
    else
      EXPECT_NEAR(out[i], 0, 1e-15);
}

TEST(HighPass, WindowOfTwentyOneSamplesAtTenMilliseconds) {
  EXPECT_EQ(half_window(0.21, 0.01), 10u);
  EXPECT_EQ(half_window(0.21, 0.001), 105u);
  EXPECT_EQ(half_window(0.21, 1.0), 0u);
}

}  // namespace
}  // namespace sinew::analysis::statistics_test
