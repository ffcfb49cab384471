#include "sinew/analysis/measures/foot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sinew::analysis::foot_test {
namespace {

constexpr robot::TwoLinks leg{0.225, 0.159};

TEST(Foot, SlipIsTheVelocityOfTheLowestPoint) {
  const double r = 0.02, h = 1e-6;
  const auto ground_point = [&](double t) {  // x of the disc's lowest point if it rolls
    const double a = 5.0 + 0.7 * t, b = 5.4 - 0.3 * t;
    return 0.1 * t + robot::foot_position(leg, a, b).x + r * (a + b);
  };
  const double expected = (ground_point(h) - ground_point(-h)) / (2 * h);
  EXPECT_NEAR(slip_velocity(leg, {5.0, 5.4}, {0.7, -0.3}, r, 0.1), expected, 1e-9);
}

// The result for n paths that are shifted by e_i along x is the rms of e_i about its mean.
TEST(Foot, RepeatOfShiftedPathsIsTheSpreadOfTheShifts) {
  std::vector<Path> paths;
  for (const double shift : {0.0, 0.003, 0.006}) {
    Path path;
    for (int k = 0; k < 50; ++k) path.push_back({std::cos(0.1 * k) + shift, std::sin(0.1 * k)});
    paths.push_back(path);
  }
  const std::vector<double> weights(50, 0.7);
  EXPECT_NEAR(repeat_rms(paths, weights), 0.003 * std::sqrt(2.0 / 3.0), 1e-15);
  EXPECT_NEAR(repeat_rms(std::vector<Path>(3, paths[0]), weights), 0, 1e-15);
  EXPECT_TRUE(std::isnan(repeat_rms(std::span(paths).first(1), weights)));
}

TEST(Foot, PointsWithoutANumberAreLeftOut) {
  std::vector<Path> paths = {{{0, 0}, {0, 0}}, {{0.002, 0}, {std::nan(""), 0}}};
  EXPECT_NEAR(repeat_rms(paths, std::vector<double>{1, 1}), 0.001, 1e-15);
}

TEST(Foot, ProgressReadsBetweenTheRows) {
  std::vector<double> line;
  for (int i = 0; i < 40; ++i) line.push_back(2.0 * i);
  const auto out = at_progress(line, 10, 30, 50);
  ASSERT_EQ(out.size(), 50u);
  for (int k = 0; k < 50; ++k)
    EXPECT_NEAR(out[static_cast<std::size_t>(k)], 2.0 * (10 + 20 * (k + 0.5) / 50), 1e-12);
}

// Both directions are tested.
TEST(Foot, RiseOfARampIsItsMiddleEightTenths) {
  for (const double way : {0.2, -0.2}) {
    std::vector<double> x(10, 1.0);
    for (int i = 1; i <= 100; ++i) x.push_back(1.0 + way * i / 100);
    for (int i = 0; i < 20; ++i) x.push_back(1.0 + way * 0.8);  // comes back
    const Rise r = rise(x, 0.01);
    ASSERT_TRUE(r.found);
    EXPECT_NEAR(r.partial, 0.8, 1e-12);
    EXPECT_NEAR(r.whole, 1.09, 1e-12);
  }
}

TEST(Foot, RiseEndsAtTheFirstPeakNotAtTheHighest) {
  std::vector<double> x;
  for (int i = 0; i <= 100; ++i) x.push_back(i);
  for (int i = 0; i <= 30; ++i) x.push_back(100 - i);
  for (int i = 0; i <= 50; ++i) x.push_back(70 + i);
  EXPECT_NEAR(rise(x, 0.01).whole, 1.0, 1e-12);
}

TEST(Foot, NoMotionNoRise) {
  EXPECT_FALSE(rise(std::vector<double>(50, 2.0), 0.01).found);
  EXPECT_FALSE(rise({}, 0.01).found);
}

}  // namespace
}  // namespace sinew::analysis::foot_test
