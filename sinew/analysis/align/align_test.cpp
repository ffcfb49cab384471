#include "sinew/analysis/align/align.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sinew/analysis/align/correlation.h"
#include "sinew/analysis/align/test_motion.h"
#include "sinew/config/diagnostics.h"

namespace sinew::analysis::align_test {
namespace {

using test::Measured;
using test::recorded;

std::string refusal_of(const signals::Table& a, const signals::Table& b, const AlignRequest& how) {
  try {
    align(a, b, how);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(Transform, GoesBackAndKeepsTheEnergy) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  std::vector<std::complex<double>> x(256), was;
  for (auto& v : x) v = {normal(random), normal(random)};
  was = x;
  transform(x, false);
  double before = 0, after = 0;
  for (const auto& v : was) before += std::norm(v);
  for (const auto& v : x) after += std::norm(v);
  EXPECT_NEAR(after, 256 * before, 1e-8 * after);
  transform(x, true);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(std::abs(x[i] - was[i]), 1e-12);
}

TEST(Align, TheSameSamplesGiveExactlyZero) {
  const signals::Table a = recorded({.noise = 0.01});
  for (const bool fit : {false, true}) {
    const Alignment found = align(a, a, {.fit_clock = fit});
    EXPECT_TRUE(found.same);
    EXPECT_EQ(found.clock.shift, 0);
    EXPECT_EQ(found.clock.rate, 0);
    EXPECT_EQ(found.correlation, 1);
  }
  EXPECT_EQ(align(a, a, {.by = AlignBy::event}).clock.shift, 0);
}

TEST(Align, AShiftIsFoundWithinAThirdOfASampleUnderNoise) {
  const signals::Table a = recorded({.noise = 0.005, .seed = 10});
  for (const double shift : {-3.217, -0.0042, 0.5, 4.6081}) {
    const signals::Table b = recorded({.clock = {shift, 0}, .noise = 0.01, .seed = 20});
    const Alignment found = align(a, b, {});
    EXPECT_NEAR(found.clock.shift, shift, 0.003) << shift;
    EXPECT_LT(found.shift_uncertainty, 0.003);
    EXPECT_GT(found.correlation, 0.98);
    EXPECT_EQ(found.rate_seen, 0) << found.rate_seen_uncertainty;
    EXPECT_EQ(found.channels, std::vector<std::string>{"/joint/elbow/angle"});
  }
}

TEST(Align, OtherSamplePeriodsDoNotMatter) {
  const signals::Table a = recorded({.noise = 0.005, .seed = 10});
  const signals::Table b =
      recorded({.clock = {1.2345, 0}, .period = 0.0037, .noise = 0.01, .seed = 20});
  EXPECT_NEAR(align(a, b, {}).clock.shift, 1.2345, 0.003);
  EXPECT_NEAR(align(b, a, {}).clock.shift, -1.2345, 0.003);
}

TEST(Align, ShiftAndRateAreFoundAndTheirUncertaintyIsHonest) {
  const signals::Table a = recorded({.noise = 0.005, .seed = 10});
  int within = 0, all = 0;
  for (const double rate : {0.003, -0.003, 0.0, 0.012})
    for (const unsigned seed : {20u, 40u, 60u}) {
      const Clock clock{2.5, rate};
      const signals::Table b = recorded({.clock = clock, .noise = 0.01, .seed = seed});
      const Alignment found = align(a, b, {.fit_clock = true});
      EXPECT_NEAR(found.clock.rate, rate, 3e-4) << seed;
      EXPECT_NEAR(found.clock.shift, 2.5, 0.006) << rate;
      EXPECT_GT(found.rate_uncertainty, 0);
      EXPECT_LT(found.rate_uncertainty, 3e-4);
      within += std::abs(found.clock.rate - rate) < 2.5 * found.rate_uncertainty;
      ++all;
    }
  EXPECT_GE(within, all - 3);
}

TEST(Align, ARateThatWasNotFittedShowsItself) {
  const signals::Table a = recorded({.noise = 0.005, .seed = 10});
  const signals::Table b = recorded({.clock = {0.7, 0.003}, .noise = 0.01, .seed = 20});
  const Alignment found = align(a, b, {});
  EXPECT_EQ(found.clock.rate, 0);
  EXPECT_NEAR(found.rate_seen, 0.003, 5e-4);
}

TEST(Align, AClockIsFollowedThroughManyPeriodsOfAWalk) {
  const auto walk = [](double t) {
    return std::sin(2 * std::numbers::pi * t / 1.5) + 0.3 * std::sin(9 * t);
  };
  signals::Table a, b;
  test::add_channel(a, "/joint/hip/angle", "rad", {.duration = 300}, 0.05, walk);
  test::add_channel(b, "/joint/hip/angle", "rad",
                    {.clock = {0.2, 0.004}, .duration = 300, .seed = 9}, 0.05, walk);
  const Alignment found = align(a, b, {.by = AlignBy::known, .shift = 0.21, .fit_clock = true});
  EXPECT_NEAR(found.clock.rate, 0.004, 2e-5);
  EXPECT_NEAR(found.clock.shift, 0.2, 0.003);
}

TEST(Align, AMotionThatRepeatsItselfIsNotGuessed) {
  const auto walk = [](double t) { return std::sin(2 * std::numbers::pi * t / 1.5); };
  signals::Table a, b;
  test::add_channel(a, "/joint/hip/angle", "rad", {}, 0.05, walk);
  test::add_channel(b, "/joint/hip/angle", "rad", {.clock = {0.2, 0}, .seed = 9}, 0.05, walk);
  EXPECT_TRUE(says(refusal_of(a, b, {}), "repeats itself"));
  EXPECT_NEAR(align(a, b, {.largest_shift = 0.7}).clock.shift, 0.2, 0.003);
}

TEST(Align, RestBeforeAndAfterDistinguishesRepetitions) {
  const auto thrice = [](double t) {
    const double u = std::clamp(t - 2, 0.0, 12.0);
    return 0.5 * (1 - std::cos(2 * std::numbers::pi * u / 4));
  };
  for (const double shift : {-3.1, 0.2, 5.4}) {
    signals::Table a, b;
    test::add_channel(a, "/joint/hip/angle", "rad", {.duration = 17}, 0.005, thrice);
    test::add_channel(b, "/joint/hip/angle", "rad",
                      {.clock = {shift, 0.003}, .duration = 22, .seed = 9}, 0.01, thrice);
    const Alignment found = align(a, b, {.fit_clock = true});
    EXPECT_NEAR(found.clock.shift, shift, 0.01);
    EXPECT_NEAR(found.clock.rate, 0.003, 6e-4);
  }
}

TEST(Align, WhatIsConstantOrNoiseOrMissingIsRefused) {
  const signals::Table a = recorded({.seed = 10}), b = recorded({.clock = {1, 0}, .seed = 20});
  EXPECT_TRUE(
      says(refusal_of(a, b, {.channels = {"/room/pressure"}}), "constant or nothing but noise"));
  EXPECT_TRUE(
      says(refusal_of(a, b, {.channels = {"/room/temperature"}}), "constant or nothing but noise"));
  EXPECT_TRUE(
      says(refusal_of(a, b, {.channels = {"/joint/elbo/angle"}}), "try \"/joint/elbow/angle\""));
  signals::Table still;
  test::add_channel(still, "/joint/elbow/angle", "rad", {}, 0.01, [](double) { return 1.0; });
  EXPECT_TRUE(says(refusal_of(a, still, {}), "no common channel that moves"));
  signals::Table strange;
  test::add_channel(strange, "/joint/elbow/angle", "rad", {}, 0,
                    [](double t) { return std::exp(-3 * (t - 15) * (t - 15)); });
  EXPECT_TRUE(says(refusal_of(a, strange, {}), "at best")) << refusal_of(a, strange, {});
}

TEST(Align, AMotionThatCannotBeDistinguishedFromLaterIsRefused) {
  signals::Table a, b;
  const auto ramp = [](double t) { return 0.1 * t; };
  test::add_channel(a, "/joint/hip/angle", "rad", {}, 0, ramp);
  test::add_channel(b, "/joint/hip/angle", "rad", {.clock = {1, 0}}, 0, ramp);
  EXPECT_TRUE(says(refusal_of(a, b, {}), "hardly changes")) << refusal_of(a, b, {});
}

TEST(Event, ACrossingLiesOnTheLineBetweenSamples) {
  const Signal s{"/x", {0, 1, 2, 3, 4}, {0, -1, 1, 3, 1}};
  EXPECT_DOUBLE_EQ(first_crossing(s, 0.5, true)->time, 1.75);
  EXPECT_DOUBLE_EQ(first_crossing(s, 2, false)->time, 3.5);
  EXPECT_FALSE(first_crossing(s, 5, true));
}

TEST(Event, FirstMotionOrALevelGivesTheShift) {
  const signals::Table a = recorded({.noise = 0.001, .seed = 10});
  const signals::Table b = recorded({.clock = {2.34, 0}, .noise = 0.001, .seed = 20});
  const Alignment surest = align(a, b, {.by = AlignBy::event});
  EXPECT_NEAR(surest.clock.shift, 2.34, 0.006);
  EXPECT_TRUE(says(surest.event, "/joint/elbow/angle moves by"));
  EXPECT_LT(std::abs(surest.clock.shift - 2.34), 4 * surest.shift_uncertainty);

  AlignRequest level{.by = AlignBy::event, .event = "/joint/elbow/angle > 25 deg"};
  EXPECT_NEAR(align(a, b, level).clock.shift, 2.34, 0.006);
  level.event = "/joint/elbow/angle > 170 deg";
  EXPECT_TRUE(says(refusal_of(a, b, level), "never crosses 170 deg upwards"));
  for (const auto& [text, words] : {std::pair{"/joint/elbow/angle", "without > or <"},
                                    {"x > 3 deg", "begins with no channel"},
                                    {"/joint/elbow/angle >", "without a level"},
                                    {"/joint/elbow/angle > 3 psi", "angle"}}) {
    level.event = text;
    EXPECT_TRUE(says(refusal_of(a, b, level), words)) << refusal_of(a, b, level);
  }
}

TEST(Reclock, PutsTheOtherOnesTimesOnTheFirstOnesClock) {
  const Clock clock{2.5, 0.003};
  signals::Table b = recorded({.clock = clock});
  reclock(b, clock);
  const signals::Series& s = b.series.front();
  for (const std::size_t i : {0u, 500u, 2999u})
    EXPECT_NEAR(s.columns[0][i], test::motion(1e-9 * static_cast<double>(s.time_ns[i])), 1e-8);
  EXPECT_NEAR(clock.other(clock.first(17.0)), 17.0, 1e-12);
}

}  // namespace
}  // namespace sinew::analysis::align_test
