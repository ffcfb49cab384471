// Designs and estimates of sensitivity against functions with known closed-form results.
#include "sinew/tune/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sinew::tune::sensitivity_test {
namespace {

using Point = std::span<const double>;

template <class F>
std::vector<double> figures(const Design& design, F f) {
  const std::vector<double> u = shares(design);
  std::vector<double> out;
  for (std::size_t i = 0; i < size(design); ++i)
    out.push_back(f(Point(u).subspan(i * design.ranges, design.ranges)));
  return out;
}

// Ishigami and Homma (1990), x in (-pi, pi): a = 7, b = 0.1.
double ishigami(Point u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2 * u[i] - 1); };
  const double s = std::sin(x(0));
  return s + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * s;
}
constexpr double ishigami_first[3] = {0.31390519114781146, 0.4424111447900409, 0};
constexpr double ishigami_total[3] = {0.5575888552099591, 0.4424111447900409, 0.24368366406214773};

double linear(Point u) { return 1 + 2 * u[0] - 3 * u[1] + 0.5 * u[2]; }

TEST(Sensitivity, SobolsIndicesOfIshigami) {
  const Design design{Method::sobol, 3, 4096, 1};
  ASSERT_EQ(size(design), 5U * 4096U);
  const Sensitivity s = sensitivity(design, figures(design, ishigami)).value();
  EXPECT_NEAR(s.mean, 3.5, 0.01);
  EXPECT_NEAR(s.variance, 13.844587940719254, 0.1);
  EXPECT_EQ(s.left_out, 0U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.effects[i].first.value, ishigami_first[i], 0.01) << i;
    EXPECT_NEAR(s.effects[i].total.value, ishigami_total[i], 0.01) << i;
  }
}

// The error decreases with the number of rows, by far more than 8 for 64 times as many.
TEST(Sensitivity, SobolsIndicesConverge) {
  const auto error = [](std::size_t n) {
    double square = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Design design{Method::sobol, 3, n, seed};
      const Sensitivity s = sensitivity(design, figures(design, ishigami)).value();
      for (std::size_t i = 0; i < 3; ++i)
        square += std::pow(s.effects[i].total.value - ishigami_total[i], 2);
    }
    return std::sqrt(square / 30);
  };
  EXPECT_LT(error(4096), error(64) / 8);
}

// The intervals are those of 95 % for independent rows; Sobol's rows have smaller errors, so that
// at least this share contains the true value.
TEST(Sensitivity, IntervalsHoldTheTruth) {
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Design design{Method::sobol, 3, 256, seed};
    const Sensitivity s = sensitivity(design, figures(design, ishigami)).value();
    for (std::size_t i = 0; i < 3; ++i) {
      const Estimate& e = s.effects[i].total;
      EXPECT_LE(e.low, e.value);
      EXPECT_GE(e.high, e.value);
      inside += e.low <= ishigami_total[i] && ishigami_total[i] <= e.high;
      ++all;
    }
  }
  EXPECT_GE(inside, 0.9 * all) << inside << " of " << all;
}

// For a linear figure, every elementary effect is the slope.
TEST(Sensitivity, MorrisOfALinearFigureIsExact) {
  const Design design{Method::morris, 3, 8, 5};
  ASSERT_EQ(size(design), 32U);
  const Sensitivity s = sensitivity(design, figures(design, linear)).value();
  const double slope[] = {2, -3, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.effects[i].mean.value, slope[i], 1e-13);
    EXPECT_NEAR(s.effects[i].mean_size.value, std::abs(slope[i]), 1e-13);
    EXPECT_NEAR(s.effects[i].mean_size.high, std::abs(slope[i]), 1e-13);
    EXPECT_NEAR(s.effects[i].spread.value, 0, 1e-13);
  }
}

// Each path moves each range once, by two thirds, on the grid.
TEST(Sensitivity, APathMovesEachRangeOnce) {
  const Design design{Method::morris, 6, 50, 2};
  const std::vector<double> u = shares(design);
  for (std::size_t path = 0; path < 50; ++path) {
    std::vector<int> moved(6);
    for (std::size_t step = 0; step < 6; ++step)
      for (std::size_t i = 0; i < 6; ++i) {
        const double* at = &u[(path * 7 + step) * 6 + i];
        const double by = std::abs(at[6] - at[0]);
        if (by > 0) {
          EXPECT_NEAR(by, 2.0 / 3.0, 1e-15);
        }
        moved[i] += by > 0;
        EXPECT_NEAR(std::round(3 * at[0]), 3 * at[0], 1e-12);
      }
    EXPECT_EQ(moved, std::vector<int>(6, 1));
  }
}

TEST(Sensitivity, OneAtATimeIsTheWayToBothEnds) {
  const Design design{Method::one_at_a_time, 3, 0, 1};
  ASSERT_EQ(size(design), 7U);
  const Sensitivity s = sensitivity(design, figures(design, linear)).value();
  EXPECT_DOUBLE_EQ(s.effects[0].to_high.value, 1);
  EXPECT_DOUBLE_EQ(s.effects[1].to_low.value, 1.5);
  EXPECT_DOUBLE_EQ(s.effects[2].to_low.value, -0.25);
}

// Runs without the figure exclude their path or row only.
TEST(Sensitivity, WhatHasNoFigureIsLeftOut) {
  for (const Method method : {Method::morris, Method::sobol}) {
    const Design design{method, 3, 512, 1};
    std::vector<double> f = figures(design, ishigami);
    f[7] = f[8] = f[1000] = std::nan("");
    const Sensitivity s = sensitivity(design, f).value();
    EXPECT_GE(s.left_out, 2U);
    EXPECT_LE(s.left_out, 3U);
    if (method == Method::sobol) {
      EXPECT_NEAR(s.effects[0].total.value, ishigami_total[0], 0.05);
    }
    f.assign(f.size(), std::nan(""));
    EXPECT_FALSE(sensitivity(design, f));
  }
  const Design ends{Method::one_at_a_time, 2, 0, 1};
  EXPECT_FALSE(sensitivity(ends, std::vector<double>{std::nan(""), 1, 1, 1, 1}));
  EXPECT_EQ(sensitivity(ends, std::vector<double>{0, std::nan(""), 1, 1, 1})->left_out, 1U);
  const Design rows{Method::sobol, 2, 16, 1};
  EXPECT_FALSE(sensitivity(rows, std::vector<double>(64, 3.0))) << "a figure that never changes";
}

}  // namespace
}  // namespace sinew::tune::sensitivity_test
