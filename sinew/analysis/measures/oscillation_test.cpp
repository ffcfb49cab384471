#include "sinew/analysis/measures/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace sinew::analysis::oscillation_test {
namespace {

constexpr double back = 1;

// Returns a sine of n periods in `samples`, plus a slope.
std::vector<double> sine(double amplitude, int periods, int samples, double slope = 0) {
  std::vector<double> out;
  for (int i = 0; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    out.push_back(amplitude * std::sin(2 * std::numbers::pi * periods * share) + slope * share);
  }
  return out;
}

TEST(TurningPoints, OfASineAreTwoInAPeriodAndItsAmplitudeIsBetweenThem) {
  for (const int periods : {1, 2, 3, 7})
    for (const double amplitude : {1.001, 1.5, 20.0}) {
      const auto points = turning_points(sine(amplitude, periods, 400 * periods), back);
      ASSERT_EQ(points.size(), 2U * static_cast<unsigned>(periods)) << amplitude;
      for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(points[k].row, 100 + 200 * k);  // at a quarter, three quarters, …
        EXPECT_NEAR(points[k].value, k % 2 == 0 ? amplitude : -amplitude, 1e-12);
      }
      const auto half_swings = amplitudes(points);
      EXPECT_EQ(half_swings.size(), points.size() - 1);
      for (const double a : half_swings) EXPECT_NEAR(a, amplitude, 1e-12);
    }
}

// Turning points do not depend on the sign or on an offset.
TEST(TurningPoints, AreTheSameUpsideDownAndElsewhere) {
  std::mt19937 random(1);
  std::normal_distribution<double> walk(0, 0.5);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> x{0}, mirrored{7};
    for (int i = 0; i < 200; ++i) {
      x.push_back(x.back() + walk(random));
      mirrored.push_back(7 - x.back());
    }
    const auto a = turning_points(x, back), b = turning_points(mirrored, back);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].row, b[k].row);

    // Maxima and minima alternate, each at least `back` from the next.
    for (std::size_t k = 1; k < a.size(); ++k) {
      const double step = a[k].value - a[k - 1].value;
      EXPECT_GE(std::abs(step), back);
      EXPECT_TRUE(k == 1 || step * (a[k - 1].value - a[k - 2].value) < 0);
    }
  }
}

TEST(TurningPoints, OfARampWithCornersAreNone) {
  std::vector<double> x;
  for (int i = 0; i < 50; ++i) x.push_back(0.1 * i);
  for (int i = 0; i < 50; ++i) x.push_back(5.0);
  for (int i = 0; i < 50; ++i) x.push_back(5.0 + 2 * i);
  EXPECT_TRUE(turning_points(x, back).empty());
  EXPECT_TRUE(turning_points(sine(1, 3, 300, 60), back).empty()) << "steeper than it swings";
}

// The error of a lag at a corner of the path grows and dies away without a swing.
TEST(TurningPoints, OfAHumpAreOneAndNoSwing) {
  std::vector<double> x;
  for (int i = -50; i <= 50; ++i) x.push_back(-0.2 * std::abs(i));
  const auto points = turning_points(x, back);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].row, 50U);
  EXPECT_TRUE(amplitudes(points).empty());
}

TEST(TurningPoints, OfNoiseThatIsSmallerAreNoneAndAddNone) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> count(-1, 1);
  constexpr double one_count = 0.08;  // deg
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> quiet(300), swings = sine(3, 2, 300);
    for (std::size_t i = 0; i < quiet.size(); ++i) {
      quiet[i] = one_count * count(random);
      swings[i] += one_count * count(random);
    }
    EXPECT_TRUE(turning_points(quiet, back).empty());
    const auto points = turning_points(swings, back);
    ASSERT_EQ(points.size(), 4U);
    for (const double a : amplitudes(points)) EXPECT_NEAR(a, 3, one_count);
  }
}

TEST(TurningPoints, OfLittleOrNothingAreNone) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(turning_points({}, back).empty());
  EXPECT_TRUE(turning_points(std::vector<double>{5}, back).empty());
  EXPECT_TRUE(turning_points(std::vector<double>(20, none), back).empty());

  // Gaps do not break a swing.
  std::vector<double> x = sine(2, 2, 80);
  for (std::size_t i = 0; i < x.size(); i += 3) x[i] = none;
  EXPECT_EQ(turning_points(x, back).size(), 4U);
}

}  // namespace
}  // namespace sinew::analysis::oscillation_test
