// Soft beginning of the tension of a slack muscle.
#include "sinew/actuator/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::toe_test {
namespace {

const double atmosphere = thesis_atmosphere;

double between(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

// From where the pull is negligible to where the toe is negligible.
TEST(Toe, IsItsClosedFormToRounding) {
  for (const double s : {0.1, 3.0, 40.0})
    for (double b = -60; b <= 60; b += 0.37) {
      const double t = s * std::log1p(std::exp(b)), share = 1 / (1 + std::exp(-b));
      EXPECT_NEAR(toe_tension({s}, s * b), t, 1e-14 * t + 1e-8 * s * std::exp(-18)) << b;
      EXPECT_NEAR(toe_share({s}, s * b), share, 1e-14 * share) << b;
    }
}

TEST(Toe, NoneIsThePullToTheBit) {
  for (const double b : {-30.0, -0.0, 1e-300, 7.3}) {
    EXPECT_EQ(toe_tension({}, b), b);
    EXPECT_EQ(toe_share({}, b), 1.0);
  }
}

// ln(1 + e^x) - ln(1 + e^-x) = x.
TEST(Toe, PullAndPushDifferByThePull) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    const Toe toe{between(random, 0.1, 50)};
    const double b = between(random, 0, 500);
    EXPECT_NEAR(toe_tension(toe, b) - toe_tension(toe, -b), b, 1e-12 * (b + toe.tension));
    EXPECT_NEAR(toe_share(toe, b) + toe_share(toe, -b), 1, 1e-15);
  }
}

TEST(Toe, StaysFiniteHoweverFarAMuscleIsSlack) {
  for (const double b : {-1e300, -1e9, -700.0, 1e300}) {
    EXPECT_TRUE(std::isfinite(toe_tension({1}, b)));
    EXPECT_GE(toe_tension({1}, b), 0);
    EXPECT_GE(toe_share({1}, b), 0);
    EXPECT_LE(toe_share({1}, b), 1);
  }
}

// A muscle with a toe never pushes, never pulls less than one without, and more pressure never
// reduces the pull.
TEST(Toe, AMuscleOnlyPulls) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 500; ++i) {
    Actuator a = thesis_actuator();
    a.bladder.saturating_tension = between(random, 0, 100);
    a.bladder.saturation_length = 3e-3;
    const double l = between(random, 0.06, 0.1), p = between(random, 0, 6e5);
    const double hard = clamped_tension(a, l, 0, p, atmosphere);
    a.toe.tension = between(random, 0.1, 30);
    a.short_end.law = ShortEnd::Law::zero;
    if (l < shortest_length(a)) continue;
    const double soft = clamped_tension(a, l, 0, p, atmosphere);
    EXPECT_GE(soft, 0);
    EXPECT_GE(soft, hard - 1e-12);
    EXPECT_GE(clamped_tension(a, l, 0, p + 1e4, atmosphere), soft);
  }
}

// With elastic ends as well, the spring behind the clamps is stretched by the soft tension.
TEST(Toe, TheSpringIsStretchedByTheSoftTension) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    Actuator a = thesis_actuator();
    a.long_end.length = 1;
    a.bladder.saturating_tension = 60;
    a.bladder.saturation_length = 3e-3;
    a.series.compliance = between(random, 1e-6, 1e-4);
    a.toe.tension = between(random, 0.5, 30);
    const double l = between(random, 0.07, 0.1), p = between(random, 0, 6e5);
    const double x = braid_length(a, l, p, atmosphere);
    const double pull = braid_pull(a, x, p, atmosphere) + bladder_tension(a.bladder, x);
    EXPECT_NEAR((l - x) / a.series.compliance, toe_tension(a.toe, pull), 1e-6);
    EXPECT_NEAR(clamped_tension(a, l, 0, p, atmosphere), toe_tension(a.toe, pull), 1e-9);
  }
}

}  // namespace
}  // namespace sinew::actuator::toe_test
