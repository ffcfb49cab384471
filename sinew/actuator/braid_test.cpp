// Geometry of the braid and the tensions that follow from it.

#include "sinew/actuator/braid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sinew/actuator/tension.h"

namespace sinew::actuator::braid_test {
namespace {

constexpr Braid braid{.thread_length = 0.1071372, .turns = 2.3125};

double any_length(std::mt19937_64& random) {
  return std::uniform_real_distribution<>(0.02, 0.106)(random);
}

TEST(Braid, VolumeIsThatOfACylinder) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100; ++i) {
    const double length = any_length(random);
    const double d = diameter(braid, length);
    const double cylinder = std::numbers::pi / 4 * d * d * length;
    EXPECT_NEAR(volume(braid, length) / cylinder, 1, 1e-14);
  }
}

TEST(Braid, ThreadIsAsLongAsItsHelix) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const double length = any_length(random);
    const double around = braid.turns * std::numbers::pi * diameter(braid, length);
    EXPECT_NEAR(std::hypot(length, around), braid.thread_length, 1e-15);
    EXPECT_NEAR(braid.thread_length * std::cos(braid_angle(braid, length)), length, 1e-15);
  }
}

TEST(Braid, VolumeSlopeIsTheDerivative) {
  std::mt19937_64 random(3);
  const double h = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const double length = any_length(random);
    const double numeric = (volume(braid, length + h) - volume(braid, length - h)) / (2 * h);
    EXPECT_NEAR(volume_slope(braid, length), numeric, 1e-11);
  }
}

TEST(Braid, VolumeIsLargestAtTheShortestLength) {
  const double shortest = shortest_length(braid);
  EXPECT_NEAR(volume_slope(braid, shortest), 0, 1e-18);
  EXPECT_NEAR(braid_angle(braid, shortest) * 180 / std::numbers::pi, 54.7356, 1e-4);
  for (double away : {-1e-3, 1e-3}) {
    EXPECT_LT(volume(braid, shortest + away), volume(braid, shortest));
  }
}

TEST(Braid, HasNoVolumeBeyondItsThread) {
  EXPECT_EQ(volume(braid, braid.thread_length), 0);
  EXPECT_EQ(volume(braid, 2 * braid.thread_length), 0);
  EXPECT_EQ(volume_slope(braid, 2 * braid.thread_length), 0);
}

TEST(Braid, DoesNotDependOnHowTheMeshIsCounted) {
  // Finer mesh, same thread: twice as many trapezoids of half the side.
  const Braid coarse = braid_from_trapezoids(37, 16, 0.0014478);
  const Braid fine = braid_from_trapezoids(74, 32, 0.0007239);
  EXPECT_DOUBLE_EQ(coarse.thread_length, fine.thread_length);
  EXPECT_DOUBLE_EQ(coarse.turns, fine.turns);
}

// [10]: the work of the air at constant gauge pressure equals that of the tension.
TEST(Braid, IdealTensionIsTheVirtualWorkOfTheAir) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<> pressure(-1e5, 8e5);
  for (int i = 0; i < 1000; ++i) {
    const double length = any_length(random), p = pressure(random);
    EXPECT_NEAR(ideal_tension(braid, length, p), -p * volume_slope(braid, length), 1e-9);
  }
}

// [13] = [22].
TEST(Braid, TensionByAngleAndByLengthAgree) {
  std::mt19937_64 random(5);
  const double p = 4e5;
  for (int i = 0; i < 100; ++i) {
    const double length = any_length(random);
    const double c = std::cos(braid_angle(braid, length));
    const double b = braid.thread_length;
    EXPECT_NEAR(ideal_tension(braid, length, p), p * b * b * (3 * c * c - 1) * braid_factor(braid),
                1e-11);
  }
}

// Work over a stroke is P times the change of volume.
TEST(Braid, WorkOfAStrokeIsPressureTimesVolume) {
  const double p = 5e5, from = 0.065, to = 0.099;
  const int steps = 1000;
  double work = 0;
  for (int i = 0; i < steps; ++i) {  // Simpson; the tension is a parabola, so it is exact
    const double h = (to - from) / steps, a = from + i * h;
    work += h / 6 *
            (ideal_tension(braid, a, p) + 4 * ideal_tension(braid, a + h / 2, p) +
             ideal_tension(braid, a + h, p));
  }
  EXPECT_NEAR(work, p * (volume(braid, from) - volume(braid, to)), 1e-12);
}

}  // namespace
}  // namespace sinew::actuator::braid_test
