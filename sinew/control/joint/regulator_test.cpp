// Tests the laws for pressure regulators: levels, integrals, and their limits.
#include "sinew/control/joint/regulator.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace sinew::control::regulator_test {
namespace {

TEST(Regulator, LevelsCoverTheRange) {
  EXPECT_EQ(level_of(0), 0);
  EXPECT_EQ(level_of(-5), 0);
  EXPECT_EQ(level_of(100), signals::max_level);
  EXPECT_EQ(level_of(3e38f), signals::max_level);
  EXPECT_EQ(level_of(std::numeric_limits<float>::quiet_NaN()), 0);
  for (int l = 0; l <= signals::max_level; ++l)
    ASSERT_EQ(level_of(static_cast<float>(l) * 100.0f / signals::max_level), l);
}

// Without integrals the mean is bias + U_k, and half the difference is U_theta.
TEST(Regulator, StiffnessMovesTheMeanAndAngleTheDifference) {
  RegulatorState state;
  const Levels l = regulate(state, {.bias = 40, .u_k = 10, .u_theta = 20});
  EXPECT_EQ(l, (Levels{level_of(70), level_of(30)}));
  EXPECT_EQ(state.mean, 0);
}

// A constant error moves both pressures apart at a constant rate, up to the ends of the range.
TEST(Regulator, IntegratesAnErrorThatStays) {
  RegulatorState state;
  for (int i = 1; i <= 40; ++i) {
    const Levels l = regulate(state, {.bias = 50, .angle_step = 0.5f});
    ASSERT_EQ(l, (Levels{level_of(50 + 0.5f * i), level_of(50 - 0.5f * i)}));
  }
}

// After any time at the limit, the first step in the other direction moves it back.
TEST(Regulator, WindsUpNoFurtherThanTheRange) {
  for (const float sign : {1.0f, -1.0f}) {
    RegulatorState state;
    for (int i = 0; i < 10'000; ++i) regulate(state, {.bias = 50, .angle_step = sign * 3});
    const Levels end = regulate(state, {.bias = 50, .angle_step = sign * 3});
    EXPECT_EQ(end.flexor, sign > 0 ? signals::max_level : 0);
    EXPECT_EQ(end.extensor, sign > 0 ? 0 : signals::max_level);
    regulate(state, {.bias = 50, .angle_step = -sign * 3});
    const Levels back = regulate(state, {.bias = 50, .angle_step = -sign * 3});
    EXPECT_NE(back.flexor, end.flexor);
    EXPECT_NE(back.extensor, end.extensor);
  }
}

// The mean is limited in the same way, also while a large U_k holds it at the limit.
TEST(Regulator, MeanWindsUpNoFurtherEither) {
  RegulatorState state;
  for (int i = 0; i < 10'000; ++i) regulate(state, {.bias = 50, .u_k = 300, .stiffness_step = 2});
  EXPECT_LE(state.mean, 2.0f);
  for (int i = 0; i < 10'000; ++i) regulate(state, {.bias = 50, .stiffness_step = -2});
  EXPECT_EQ(regulate(state, {.bias = 50, .stiffness_step = -2}), (Levels{0, 0}));
  regulate(state, {.bias = 50, .stiffness_step = 2});
  EXPECT_GT(regulate(state, {.bias = 50, .stiffness_step = 2}).flexor, 0);
}

TEST(Regulator, StateStaysWithinTheRangeWhateverComes) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-200, 200);
  RegulatorState state;
  for (int i = 0; i < 100'000; ++i) {
    const float wild = i % 100 == 0 ? inf : any(random);
    regulate(state, {.bias = 30,
                     .u_k = any(random),
                     .u_theta = any(random),
                     .stiffness_step = wild,
                     .angle_step = any(random)});
    ASSERT_TRUE(state.mean >= -30 && state.mean <= 70);
    ASSERT_TRUE(state.difference >= -100 && state.difference <= 100);
  }
}

}  // namespace
}  // namespace sinew::control::regulator_test
