// Parts of a real tube other than its braid: caps, taper, wall, threshold, a nonlinear bladder.

#include "sinew/actuator/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/bladder.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::body_test {
namespace {

const double atmosphere = thesis_atmosphere;

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

// The thesis's actuator with every term other than the braid.
Actuator full(std::mt19937_64& random) {
  Actuator a = thesis_actuator();
  a.effectiveness.valid_from = -1e6;
  a.effectiveness.valid_to = 2e6;
  a.effectiveness.threshold = uniform(random, 0, 6e4);
  a.caps.length = uniform(random, 0, 0.01);
  a.taper = {.gain = uniform(random, 0.9, 1.2),
             .extra_gain = uniform(random, 0, 0.3),
             .extra_pressure = uniform(random, 5e4, 3e5),
             .rest_length = 0.098};
  a.wall.thickness = uniform(random, 0, 1e-3);
  a.series.compliance = uniform(random, 0, 2e-5);
  a.toe.tension = uniform(random, 0, 10);
  a.bladder = {.stiffness = uniform(random, 0, 400),
               .rest_length = 0.098,
               .quadratic = uniform(random, -1e3, 1e3),
               .cubic = uniform(random, -1e4, 1e4),
               .saturating_tension = uniform(random, 0, 20),
               .saturation_length = uniform(random, 1e-3, 5e-3)};
  return a;
}

TEST(Body, NeutralIsTheBraidToTheBit) {
  std::mt19937_64 random(1);
  const Actuator a = thesis_actuator();
  ASSERT_TRUE(is_plain(a));
  for (int i = 0; i < 500; ++i) {
    const double l = uniform(random, 0.03, 0.11), p = uniform(random, -1e5, 8e5);
    EXPECT_EQ(working_length(a, l, p), l);
    EXPECT_EQ(volume(a, l), volume(a.braid, l));
    EXPECT_EQ(volume_slope(a, l), volume_slope(a.braid, l));
    EXPECT_EQ(braid_pull(a, l, p, atmosphere),
              ideal_tension(a.braid, l, p) * effectiveness(a.effectiveness, p, atmosphere));
  }
  EXPECT_EQ(shortest_length(a), shortest_length(a.braid));
}

TEST(Body, EachTermIsNoLongerPlain) {
  for (int term = 0; term < 11; ++term) {
    Actuator a = thesis_actuator();
    if (term == 10) a.air.offset = 1e-6;
    if (term == 0) a.effectiveness.threshold = 1;
    if (term == 1) a.caps.length = 1e-3;
    if (term == 2) a.taper.gain = 1.1;
    if (term == 3) a.taper.extra_gain = 0.1;
    if (term == 4) a.wall.thickness = 1e-4;
    if (term == 5) a.bladder.quadratic = 1;
    if (term == 6) a.bladder.saturating_tension = 1;
    if (term == 7) a.bladder.valid_to = 0.1;
    if (term == 8) a.series.compliance = 1e-6;
    if (term == 9) a.toe.tension = 1;
    EXPECT_FALSE(is_plain(a)) << term;
  }
}

// The same volume offset at each length, down to no air.
TEST(Body, AirBesideTheBraidIsAdded) {
  Actuator a = thesis_actuator();
  for (const double offset : {3e-6, -3e-6}) {
    a.air.offset = offset;
    for (double l = 0.03; l < 0.11; l += 1e-3) {
      EXPECT_EQ(volume(a, l), std::max(0.0, volume(a.braid, l) + offset));
      EXPECT_EQ(volume_slope(a, l), volume(a, l) > 0 ? volume_slope(a.braid, l) : 0.0);
    }
  }
}

TEST(Body, VolumeIsThatInsideTheWall) {
  Actuator a = thesis_actuator();
  a.wall.thickness = 8e-4;
  a.caps.length = 0.005;
  for (double l : {0.07, 0.08, 0.1}) {
    const double d = diameter(a.braid, l - 0.005) - 2 * 8e-4;
    EXPECT_NEAR(volume(a, l), M_PI / 4 * d * d * (l - 0.005), 1e-18);
  }
}

// [10] for the whole tube: caps and wall change the volume, and the tension with it.
TEST(Body, TensionIsTheVirtualWorkOfTheAirWithin) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    Actuator a = full(random);
    a.taper = {};
    a.effectiveness = {.c0 = 1};
    const double l = uniform(random, 0.07, 0.1), p = uniform(random, 1e4, 7e5), h = 1e-6;
    const double slope = (volume(a, l + h) - volume(a, l - h)) / (2 * h);
    EXPECT_NEAR(volume_slope(a, l), slope, 1e-10);
    EXPECT_NEAR(braid_pull(a, l, p, atmosphere), -p * slope, 1e-10 * p);
  }
}

TEST(Body, CapsMoveTheBraidAlong) {
  std::mt19937_64 random(3);
  const Actuator a = thesis_actuator();
  Actuator capped = a;
  capped.caps.length = 0.007;
  for (int i = 0; i < 100; ++i) {
    const double l = uniform(random, 0.064, 0.099), p = uniform(random, 0, 7e5);
    EXPECT_NEAR(braid_pull(capped, l + 0.007, p, atmosphere), braid_pull(a, l, p, atmosphere),
                1e-9);
  }
  EXPECT_DOUBLE_EQ(shortest_length(capped), shortest_length(a) + 0.007);
}

TEST(Body, TaperEndsThePullAtALongerLength) {
  Actuator a = thesis_actuator();
  a.taper = {.gain = 1.25, .rest_length = 0.098};
  const double shortest = shortest_length(a), p = 4e5;
  EXPECT_NEAR(0.098 - shortest, (0.098 - shortest_length(a.braid)) / 1.25, 1e-15);
  EXPECT_NEAR(braid_pull(a, shortest, p, atmosphere), 0, 1e-9);
  EXPECT_DOUBLE_EQ(braid_pull(a, 0.098, p, atmosphere),
                   braid_pull(thesis_actuator(), 0.098, p, atmosphere));
}

TEST(Body, ThresholdTakesFromThePressureAndLeavesVacuum) {
  Effectiveness e;
  e.threshold = 3e4;
  EXPECT_EQ(acting_pressure(e, 5e5), 4.7e5);
  EXPECT_EQ(acting_pressure(e, 3e4), 0);
  EXPECT_EQ(acting_pressure(e, 1e4), 0);
  EXPECT_EQ(acting_pressure(e, -2e4), -2e4);
}

TEST(Bladder, SlopeIsTheDerivative) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 500; ++i) {
    Bladder b = full(random).bladder;
    b.valid_from = 0.07;
    b.valid_to = 0.105;
    const double l = uniform(random, 0.06, 0.11), h = 1e-7;
    if (std::min({std::abs(l - 0.07), std::abs(l - 0.105), std::abs(l - 0.098)}) < h) continue;
    const double slope = (bladder_tension(b, l + h) - bladder_tension(b, l - h)) / (2 * h);
    EXPECT_NEAR(bladder_stiffness(b, l), slope, 1e-4 * (1 + std::abs(slope)));
  }
}

TEST(Bladder, SaturatesAndIsHeldOutsideItsLengths) {
  const Bladder b{.rest_length = 0.1,
                  .saturating_tension = 50,
                  .saturation_length = 0.002,
                  .valid_from = 0.02,
                  .valid_to = 0.1};
  EXPECT_EQ(bladder_tension(b, 0.1), 0);
  EXPECT_NEAR(bladder_tension(b, 0.098), -50 * (1 - std::exp(-1)), 1e-12);
  EXPECT_NEAR(bladder_tension(b, 0.04), -50, 1e-9);
  EXPECT_EQ(bladder_tension(b, 0.3), 0);
  EXPECT_EQ(bladder_tension(b, -1e9), bladder_tension(b, 0.02));
}

// Every term at once: both stiffnesses are slopes of the tension.
TEST(Body, StiffnessIsTheSlopeOfTheWholeTension) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 500; ++i) {
    Actuator a = full(random);
    const double l = uniform(random, 0.079, 0.096), p = uniform(random, 1.8e5, 8e5), h = 1e-6;
    const double gauge = p - atmosphere, external = 1e-5, n = 1.2;
    const auto at = [&](double x, double pressure) {
      return clamped_tension(a, x, 0, pressure - atmosphere, atmosphere);
    };
    const double passive = passive_stiffness(a, l, gauge, atmosphere);
    const double k = (at(l + h, p) - at(l - h, p)) / (2 * h);
    EXPECT_NEAR(stiffness_at_constant_pressure(a, l, gauge, atmosphere) + passive, k,
                1e-4 + 1e-6 * std::abs(k));

    const auto trapped = [&](double x) {
      return p * std::pow((volume(a, l) + external) / (volume(a, x) + external), n);
    };
    const double sealed = (at(l + h, trapped(l + h)) - at(l - h, trapped(l - h))) / (2 * h);
    EXPECT_NEAR(stiffness_sealed(a, l, p, atmosphere, external, n) + passive, sealed,
                1e-3 + 1e-6 * std::abs(sealed));
  }
}

// For any parameters, within the lengths at which the braid pulls.
TEST(Body, TensionGrowsWithPressure) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 200; ++i) {
    Actuator a = full(random);
    a.effectiveness = {.c0 = 0.9, .threshold = a.effectiveness.threshold};
    a.wall.thickness = 0;
    const double l = uniform(random, std::max(0.08, shortest_length(a)), 0.0975);
    double before = -1e9;
    for (double p = -5e4; p < 2e6; p += 2.5e4) {
      if (working_length(a, l, p) < shortest_length(a.braid)) continue;
      const double now = clamped_tension(a, l, 0, p, atmosphere);
      EXPECT_GE(now, before - 1e-9);
      before = now;
    }
  }
}

}  // namespace
}  // namespace sinew::actuator::body_test
