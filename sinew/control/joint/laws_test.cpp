// Tests the laws as functions: the thesis's numbers, exact truncation, the pole, extreme inputs.
#include "sinew/control/joint/laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sinew/control/joint/test_leg.h"

namespace sinew::control::laws_test {
namespace {

constexpr JointControllerConfig leg = test_leg();
constexpr double counts_per_lbf = 0.17 * 4096 / 5;  // 4.4
constexpr double counts_per_rad = 767;              // B.1

std::int32_t counts(double lbf) {
  return static_cast<std::int32_t>(std::lround(lbf * counts_per_lbf));
}

// --- exact arithmetic ---------------------------------------------------------------------------

TEST(Exact, ProductIsCutOffWhereSinglePrecisionRoundsUp) {
  static_assert(0.12f * 25.0f == 3.0f);
  EXPECT_EQ(truncated(two_product(0.12f, 25.0f)), 2);
  EXPECT_EQ(truncated(two_product(0.12f, -25.0f)), -2);
  EXPECT_EQ(truncated(two_product(0.125f, 24.0f)), 3);
  EXPECT_EQ(truncated(two_product(0.9f, 10.0f)), static_cast<int>(0.9f * 10.0));
}

// Reference: gains as whole multiples of 2^-60 in 128-bit integers, whose division truncates.
TEST(Exact, AngleLawAgreesWithIntegerArithmetic) {
  __extension__ using Wide = __int128;
  constexpr int scale = 60;
  const auto whole = [](float x) {
    return static_cast<Wide>(std::ldexp(static_cast<long double>(x), scale));
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-10, 2);
  std::uniform_int_distribution<int> reading(0, 4095);
  std::uniform_int_distribution<int> thousandths(0, 999);
  for (int i = 0; i < 200'000; ++i) {
    Gains g{.angle = i % 2 ? std::exp2(exponent(random))
                           : static_cast<float>(thousandths(random)) / 1000.0f,
            .velocity = i % 3 ? 0.01f * std::exp2(exponent(random)) : 0.0f};
    const int desired = reading(random), actual = reading(random), previous = reading(random);
    const Wide u =
        whole(g.angle) * (desired - actual) - whole(g.velocity) * (100 * (actual - previous));
    const int expected = clamped(static_cast<int>(u / (Wide(1) << scale)), -16'000, 16'000);
    ASSERT_EQ(truncated(angle_law(g, 1, desired, actual, difference(actual, previous, 100.0f))),
              expected)
        << g.angle << " " << g.velocity << " " << desired << " " << actual << " " << previous;
  }
}

TEST(Exact, RoundingGoesToTheNearest) {
  EXPECT_EQ(rounded({2.4f, 0}), 2);
  EXPECT_EQ(rounded({2.5f, 0}), 3);
  EXPECT_EQ(rounded({-2.5f, 0}), -3);
  EXPECT_EQ(rounded({2.5f, -1e-8f}), 2);
  EXPECT_EQ(rounded({0, 0}), 0);
}

// The code divides by the double 0.01: 0.5 x 99.999999999999998 is truncated to 49. Here it is
// 100/s.
TEST(Exact, SpeedIsTheStepTimesAHundred) {
  const Gains g{.velocity = 0.5f};
  EXPECT_EQ(truncated(angle_law(g, 1, 0, 1, difference(1, 0, 100.0f))), -50);
  EXPECT_EQ(static_cast<int>(-0.5f * (1 / static_cast<long double>(0.01))), -49);
}

// --- the angle law [59] -------------------------------------------------------------------------

// 1 / 0.035 = 28.6 counts, 1 / 0.12 = 8.3 counts: smaller errors give no whole percent.
TEST(AngleLaw, DeadBand) {
  const auto u = [](const JointConfig& joint, int error) {
    return truncated(angle_law(joint.gains, +1, error, 0, 0.0f));
  };
  for (const int sign : {-1, 1}) {
    EXPECT_EQ(u(leg.joint[hip], sign * 28), 0);
    EXPECT_EQ(u(leg.joint[hip], sign * 29), sign);
    EXPECT_EQ(u(leg.joint[knee], sign * 8), 0);
    EXPECT_EQ(u(leg.joint[knee], sign * 9), sign);
  }
}

TEST(AngleLaw, FlexionDeterminesTheDirection) {
  const Gains g{.angle = 0.1f, .velocity = 0.001f};
  const Exact up = angle_law(g, +1, 2000, 1800, difference(1800, 1790, 100.0f));
  const Exact down = angle_law(g, -1, 2000, 1800, difference(1800, 1790, 100.0f));
  EXPECT_EQ(up.high, -down.high);
  EXPECT_EQ(up.low, -down.low);
  EXPECT_EQ(truncated(up), 19);
}

// --- the stiffness [27], [60] -------------------------------------------------------------------

TEST(Stiffness, ThreadLengthIsTheActuators) {
  const double b = std::sqrt(leg.joint[hip].flexor.thread_length_squared);
  EXPECT_NEAR(b / counts_per_rad, 4.218, 0.0005);  // [17], with 1 in of moment arm
  EXPECT_NEAR(leg.joint[hip].flexor.free_length / counts_per_rad, 3.15, 0.0005);
}

// At 0.4 rad of flexion with 12 lbf in the flexor and 6 in the extensor: 33.0 by the code, 46.8
// with correct lengths.
TEST(Stiffness, KneeWithLengthsSwappedAndCorrected) {
  JointConfig joint = leg.joint[knee];
  const int flexed = joint.angle_at_rest - static_cast<int>(std::lround(0.4 * counts_per_rad));
  const auto k = [&](Truncation mode) {
    return joint_stiffness(joint, mode, flexed, counts(12), counts(6)).value;
  };
  EXPECT_NEAR(k(Truncation::each_law), 33.0, 0.05);
  EXPECT_NEAR(k(Truncation::none), 33.0, 0.05);
  joint.lengths_swapped = false;
  EXPECT_NEAR(k(Truncation::each_law), 46.8, 0.05);
  EXPECT_NEAR(k(Truncation::none), 46.8, 0.05);
}

TEST(Stiffness, AgreesWithEquation27) {
  const JointConfig& joint = leg.joint[hip];
  for (int angle = 1500; angle < 2300; angle += 7) {
    const double flexor = 2416 - (angle - 1895), extensor = 2416 + (angle - 1895), b2 = 10465225;
    const double expected =
        5.5 * 6 * (1000 / (3 * flexor - b2 / flexor) + 700 / (3 * extensor - b2 / extensor));
    EXPECT_NEAR(joint_stiffness(joint, Truncation::none, angle, 1000, 700).value, expected,
                1e-5 * expected);
  }
}

TEST(Stiffness, NoValueNearThePole) {
  JointConfig joint = leg.joint[hip];
  const double pole = std::sqrt(joint.flexor.thread_length_squared / 3.0);
  const auto valid = [&](double length) {  // of the flexor
    const int angle = joint.angle_at_rest + 2416 - static_cast<int>(length);
    return joint_stiffness(joint, Truncation::each_law, angle, 1, 1).valid;
  };
  EXPECT_TRUE(valid(pole + joint.pole_clamp + 1.5));
  EXPECT_FALSE(valid(pole + joint.pole_clamp - 1.5));
  EXPECT_FALSE(valid(pole - 200));
  joint.pole_clamp = -10'000;  // computed through the pole: negative beyond it, as in the code
  EXPECT_TRUE(valid(pole - 200));
  EXPECT_LT(joint_stiffness(joint, Truncation::each_law, joint.angle_at_rest + 700, 1000, 0).value,
            0);
}

// --- conversion [54]-[57] -----------------------------------------------------------------------

TEST(Duties, NeverBothValvesOfAMuscle) {
  for (int flexor = -250; flexor <= 250; ++flexor) {
    const Duties d = to_duties(Pair{flexor, -flexor / 2});
    EXPECT_TRUE(d.flexor_inlet == 0 || d.flexor_exhaust == 0);
    EXPECT_TRUE(d.extensor_inlet == 0 || d.extensor_exhaust == 0);
    EXPECT_EQ(d.flexor_inlet - d.flexor_exhaust, clamped(flexor, -100, 100));
  }
  EXPECT_EQ(open_loop_duties({50, 20, 120, -3}, JointKind::antagonist), (Duties{0, 20, 100, 0}));
  EXPECT_EQ(open_loop_duties({50, 20, 120, -3}, JointKind::cylinder), (Duties{50, 20, 100, 0}));
}

TEST(Duties, WhereRealPercentsBecomeWhole) {
  const Exact u_k{1.9f, 0}, u_theta{3.9f, 0};
  EXPECT_EQ(to_duties(signed_duties(u_k, u_theta, Truncation::each_law)), (Duties{4, 0, 0, 2}));
  EXPECT_EQ(to_duties(signed_duties(u_k, u_theta, Truncation::sum)), (Duties{5, 0, 0, 2}));
  EXPECT_EQ(to_duties(signed_duties(u_k, u_theta, Truncation::none)), (Duties{6, 0, 0, 2}));
}

TEST(Duties, CylinderWorksAgainstItsFeedforward) {
  EXPECT_EQ(cylinder_duties({55, 55, 45, 45}, {10.5f, 0}, Truncation::each_law),
            (Duties{65, 45, 35, 55}));
}

// --- extreme inputs; the preset asan runs these under -fsanitize=undefined ----------------------

TEST(Laws, AnyInputGivesDuties) {
  constexpr float inf = std::numeric_limits<float>::infinity(),
                  nan = std::numeric_limits<float>::quiet_NaN();
  const float floats[] = {0, -0.0f, 1e-44f, 0.12f, 999, -1e9f, 3e38f, inf, -inf, nan};
  const std::int32_t ints[] = {0,
                               1,
                               1895,
                               2416,
                               4095,
                               -32768,
                               1 << 30,
                               std::numeric_limits<int>::min(),
                               std::numeric_limits<int>::max()};
  JointConfig joint = leg.joint[hip];
  for (const int clamp : {134, 0, -10'000})
    for (const int reading : {0, 1, 1895 + 547, 1895 + 548, 1895 + 549, 4095})
      for (const float x : floats)
        for (const float y : floats)
          for (const std::int32_t desired : ints)
            for (const Truncation mode :
                 {Truncation::each_law, Truncation::sum, Truncation::none}) {
              joint.pole_clamp = clamp;
              const Stiffness k = joint_stiffness(joint, mode, reading, 4095, 0);
              const Exact u_theta =
                  angle_law({x, 0, y}, -1, desired, reading, difference(reading, 0, 100.0f));
              const Duties d =
                  to_duties(signed_duties(stiffness_law(x, y, k.value), u_theta, mode));
              for (const int duty :
                   {d.flexor_inlet, d.flexor_exhaust, d.extensor_inlet, d.extensor_exhaust})
                ASSERT_TRUE(duty >= 0 && duty <= 100);
            }
}

}  // namespace
}  // namespace sinew::control::laws_test
