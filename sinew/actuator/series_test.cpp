// Elastic ends: a spring in series with braid and bladder.
#include "sinew/actuator/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::series_test {
namespace {

const double atmosphere = thesis_atmosphere;

double between(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

// An actuator whose bladder loses tension steeply, which is hardest for the iteration.
Actuator steep() {
  Actuator a = thesis_actuator();
  a.long_end.length = 1;  // its threads are parallel to the spring, not behind it
  a.bladder = {
      .stiffness = 300, .rest_length = 0.098, .saturating_tension = 20, .saturation_length = 2e-3};
  return a;
}

TEST(Series, TheSpringIsStretchedByTheTension) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    Actuator a = steep();
    a.series.compliance = between(random, 1e-6, 1e-4);
    const double l = between(random, 0.065, 0.1), p = between(random, 0, 6e5);
    const double x = braid_length(a, l, p, atmosphere);
    EXPECT_NEAR((l - x) / a.series.compliance, clamped_tension(a, l, 0, p, atmosphere), 1e-6);
  }
}

TEST(Series, TheBladderIsOneHoweverOftenItIsEvaluated) {
  const Bladder b = steep().bladder;
  for (const double l : {0.06, 0.09, 0.0975, 0.1}) {
    EXPECT_DOUBLE_EQ(bladder_pull(b, l).tension, bladder_tension(b, l));
    EXPECT_DOUBLE_EQ(bladder_pull(b, l).stiffness, bladder_stiffness(b, l));
  }
}

TEST(Series, NothingGivesWayWithoutCompliance) {
  const Actuator a = steep();
  for (const double l : {0.065, 0.08, 0.1}) {
    EXPECT_EQ(braid_length(a, l, 4e5, atmosphere), l);
    EXPECT_EQ(share_of_stiffness(a, l, 4e5, atmosphere), 1.0);
  }
}

// Two linear springs in series: 1/k + C.
TEST(Series, ALinearBladderHasItsClosedForm) {
  Actuator a = thesis_actuator();
  a.bladder = {.stiffness = 5000, .rest_length = 0.08};
  a.series.compliance = 1e-4;
  for (const double l : {0.07, 0.081, 0.09})
    EXPECT_NEAR(clamped_tension(a, l, 0, 0, atmosphere), (l - 0.08) / (1 / 5000.0 + 1e-4), 1e-9);
}

// To first order the tension falls by C F times its slope; the rest falls with C squared.
TEST(Series, LittleComplianceCostsItsFirstOrder) {
  Actuator a = steep();
  const double l = 0.085, p = 4e5, f = clamped_tension(a, l, 0, p, atmosphere);
  const double slope = braid_pull_slope(a, l, p, atmosphere) + bladder_stiffness(a.bladder, l);
  double before = 0;
  for (const double c : {8e-7, 4e-7, 2e-7}) {
    a.series.compliance = c;
    const double rest = std::abs(clamped_tension(a, l, 0, p, atmosphere) - (f - c * f * slope));
    if (before > 0) {
      EXPECT_NEAR(before / rest, 4, 0.2);
    }
    before = rest;
  }
}

// Elastic ends never increase pull or push, and more pressure never reduces the pull.
TEST(Series, TensionFallsAsEndsGiveWayAndGrowsWithPressure) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    Actuator a = steep();
    const double l = between(random, 0.07, 0.1), p = between(random, 1e5, 6e5);
    double before = clamped_tension(a, l, 0, p, atmosphere);
    for (const double c : {1e-6, 1e-5, 1e-4}) {
      a.series.compliance = c;
      const double now = clamped_tension(a, l, 0, p, atmosphere);
      EXPECT_LE(std::abs(now), std::abs(before) + 1e-9);
      EXPECT_GT(clamped_tension(a, l, 0, p + 1e4, atmosphere), now);
      before = now;
    }
  }
}

}  // namespace
}  // namespace sinew::actuator::series_test
