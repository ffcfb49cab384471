// Tests the estimators: ramps, noise, bounds, and a joint with real motion.
#include "sinew/control/joint/velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sinew::control::velocity_test {
namespace {

constexpr float rate = 100;  // laws per second

VelocityConfig average_of(std::uint8_t n) {
  return {.estimator = Estimator::weighted_average, .samples = n, .weight = line_weights(n, rate)};
}

// Returns the estimates after each of these angles.
std::vector<double> estimates(const VelocityConfig& config, const std::vector<std::int32_t>& angles,
                              const std::vector<float>& push = {}) {
  VelocityState state;
  std::vector<double> out;
  for (std::size_t i = 0; i < angles.size(); ++i)
    out.push_back(static_cast<double>(estimate(config, state,
                                               {.angle = angles[i],
                                                .push = push.empty() ? 0.0f : push[i],
                                                .sensor = angles[i],
                                                .rate = rate})));
  return out;
}

std::vector<std::int32_t> ramp(int counts_per_period, int n) {
  std::vector<std::int32_t> angles;
  for (int i = 0; i < n; ++i) angles.push_back(2000 + counts_per_period * i);
  return angles;
}

double variance(const std::vector<double>& x, std::size_t from) {
  double sum = 0, squares = 0;
  for (std::size_t i = from; i < x.size(); ++i) sum += x[i], squares += x[i] * x[i];
  const double n = static_cast<double>(x.size() - from);
  return squares / n - (sum / n) * (sum / n);
}

// --- difference and weighted average ------------------------------------------------------------

TEST(Difference, OneCountIsAHundredCountsPerSecond) {
  EXPECT_EQ(difference(1001, 1000, rate), 100.0f);
  EXPECT_EQ(difference(988, 1000, rate), -1200.0f);  // what figure 6-15 shows
}

TEST(Velocity, RampsAreExactForDifferenceAndLine) {
  for (const int slope : {-12, 0, 1, 7}) {
    EXPECT_EQ(estimates({}, ramp(slope, 30)).back(), 100.0 * slope);
    for (std::uint8_t n = 2; n <= max_samples; ++n)
      EXPECT_NEAR(estimates(average_of(n), ramp(slope, 30)).back(), 100.0 * slope,
                  1e-4 * std::abs(100.0 * slope))
          << int{n};
  }
}

TEST(Velocity, TheFirstLawSeesNone) {
  for (const Estimator e : {Estimator::difference, Estimator::weighted_average,
                            Estimator::bounded_observer, Estimator::kalman}) {
    VelocityConfig config = average_of(5);
    config.estimator = e;
    config.margin = 1000;
    EXPECT_EQ(estimates(config, {3000}).front(), 0) << static_cast<int>(e);
  }
}

TEST(WeightedAverage, OfTwoIsTheDifference) {
  std::mt19937 random(1);
  std::vector<std::int32_t> angles;
  for (int i = 0; i < 1000; ++i) angles.push_back(static_cast<std::int32_t>(random() % 4096));
  EXPECT_EQ(estimates(average_of(2), angles), estimates({}, angles));
}

// White noise of variance s^2 leaves s^2 rate^2 12/(n (n^2 - 1)): 2 s^2 rate^2 for n = 2.
TEST(WeightedAverage, ReducesNoiseAsLeastSquaresPredicts) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(2000, 20);  // large against a count's 1/sqrt 12
  std::vector<std::int32_t> angles;
  for (int i = 0; i < 200'000; ++i)
    angles.push_back(static_cast<std::int32_t>(std::lround(noise(random))));
  const double s2 = 400 + 1.0 / 12;
  for (const int n : {2, 3, 5, 8, 16}) {
    const double expected = s2 * 100 * 100 * 12.0 / (n * (n * n - 1.0));
    EXPECT_NEAR(variance(estimates(average_of(static_cast<std::uint8_t>(n)), angles), 100),
                expected, 0.03 * expected)
        << n;
  }
}

// --- bounded observer ---------------------------------------------------------------------------

TEST(BoundedObserver, NeverExceedsItsBounds) {
  std::mt19937 random(3);
  VelocityConfig config{.estimator = Estimator::bounded_observer,
                        .decay = 0.9f,
                        .speed_gain = 0.05f,
                        .margin = 37,
                        .limit = 400};
  VelocityState state;
  float last = 0, last_push = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto angle = static_cast<std::int32_t>(random() % 4096);
    const float push = static_cast<float>(random() % 8192) - 4096.0f;
    const float v = estimate(config, state, {.angle = angle, .push = push, .rate = rate});
    ASSERT_LE(std::abs(v), config.limit);
    if (i > 0) {
      const float expected = config.decay * last + config.speed_gain * 0.5f * (push + last_push);
      ASSERT_LE(std::abs(v - clamped(expected, config.limit + config.margin)),
                config.margin + 1e-3f);
    }
    last = v, last_push = push;
  }
}

// With large bounds it equals the difference, with zero bounds the model.
TEST(BoundedObserver, LiesBetweenDifferenceAndModel) {
  std::mt19937 random(4);
  std::vector<std::int32_t> angles;
  std::vector<float> push;
  for (int i = 0; i < 500; ++i) {
    angles.push_back(static_cast<std::int32_t>(random() % 4096));
    push.push_back(100);
  }
  VelocityConfig config{.estimator = Estimator::bounded_observer, .margin = speed_limit};
  EXPECT_EQ(estimates(config, angles, push), estimates({}, angles));
  config.margin = 0, config.speed_gain = 0.25f, config.decay = 0.5f;
  EXPECT_NEAR(estimates(config, angles, push).back(), 25.0 / (1 - 0.5), 1e-4);  // its steady speed
}

// --- Kalman -------------------------------------------------------------------------------------

// A model without error needs no correction; a wrong initial value decays.
TEST(Kalman, FollowsARampWithoutError) {
  const VelocityConfig config{
      .estimator = Estimator::kalman, .travel = 0.01f, .angle_share = 0.4f, .speed_share = 10.0f};
  const std::vector<double> v = estimates(config, ramp(5, 200));
  EXPECT_NEAR(v.back(), 500, 0.05);  // a float of 3000 counts has 2.4e-4
  EXPECT_GT(std::abs(v[1] - 500), 100);
}

// --- sensor -------------------------------------------------------------------------------------

TEST(VelocitySensor, IsItsScale) {
  const VelocityConfig config{.estimator = Estimator::sensor, .at_rest = 2048, .scale = 1.5f};
  EXPECT_EQ(estimates(config, {2048, 2050, 0}), (std::vector<double>{0, 3, -3072}));
}

TEST(Velocity, AnyInputGivesAFiniteSpeed) {
  std::mt19937 random(5);
  for (const Estimator e : {Estimator::difference, Estimator::weighted_average,
                            Estimator::bounded_observer, Estimator::kalman, Estimator::sensor}) {
    VelocityConfig config = average_of(16);
    config.estimator = e;
    config.decay = 1e5f, config.speed_gain = -1e5f, config.travel = config.travel_gain = 1e5f;
    config.angle_share = config.speed_share = -1e5f, config.scale = 1e5f;
    VelocityState state;
    for (int i = 0; i < 1000; ++i) {
      const Motion now{.angle = static_cast<std::int32_t>(random() % 4096),
                       .push = static_cast<float>(random() % 8190) - 4095.0f,
                       .sensor = static_cast<std::int32_t>(random() % 4096),
                       .rate = 5000};
      ASSERT_LE(std::abs(estimate(config, state, now)), 2.1e7f);
    }
  }
}

}  // namespace
}  // namespace sinew::control::velocity_test
