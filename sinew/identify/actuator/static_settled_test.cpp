// Samples at rest are separated from those of a valve's transient.
#include "sinew/identify/actuator/static_settled.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::identify::static_settled_test {
namespace {

// Steps of 50 kPa, each of which the pressure follows with a time constant of 50 ms; 512 Hz.
struct Steps {
  std::vector<double> time, pressure, since;  // since the last step  [s]
};

Steps steps(double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> scatter(0, 1);
  Steps out;
  for (int i = 0; i < 5000; ++i) {
    const double t = i / 512.0, since = std::fmod(t, 1.0);
    out.time.push_back(t);
    out.since.push_back(since);
    out.pressure.push_back(5e4 * (std::floor(t) + 1 - std::exp(-since / 0.05)) +
                           noise * scatter(random));
  }
  return out;
}

TEST(Settled, IsWhatHasNoTransientInItsWindow) {
  for (const double noise : {0.0, 200.0}) {
    const Steps s = steps(noise, 7);
    const Settled found = settled_samples(s.time, s.pressure);
    std::size_t right = 0, moving = 0;
    for (std::size_t i = 0; i < s.time.size(); ++i) {
      const bool at_rest = s.since[i] > 0.35 && s.since[i] < 0.92;
      if (at_rest && found.sample[i]) ++right;
      if (s.since[i] > 0.01 && s.since[i] < 0.1) moving += found.sample[i] ? 1 : 0;
      EXPECT_TRUE(found.sample[i] || !at_rest) << s.time[i];
    }
    EXPECT_GT(right, s.time.size() / 2);
    EXPECT_EQ(found.rests, 10);
    EXPECT_EQ(moving, 0u);
  }
}

TEST(Settled, DoesNotDependOnWhenTheClockBeganNorOnTheUnit) {
  Steps s = steps(100, 3);
  const std::vector<bool> first = settled_samples(s.time, s.pressure).sample;
  for (double& t : s.time) t += 1024;
  for (double& p : s.pressure) p *= 4;
  EXPECT_EQ(settled_samples(s.time, s.pressure).sample, first);
}

// A manual loop with one sample a second: the window is extended to contain samples.
TEST(Settled, RareSamplesAreLookedAtOverALongerWindow) {
  std::vector<double> time, pressure;
  for (int i = 0; i < 40; ++i) {
    time.push_back(i);
    pressure.push_back(1e5 * (i / 10));
  }
  const Settled found = settled_samples(time, pressure);
  EXPECT_EQ(found.window, 3);
  EXPECT_TRUE(found.sample[5]);
  EXPECT_EQ(found.moving() % 2, 0u);
  EXPECT_LT(found.moving(), 20u);
}

// A vessel that fills through a throttle rests before and after, but not between.
TEST(Settled, AFillThroughAThrottleHasNoLevels) {
  std::vector<double> time, pressure;
  for (int i = 0; i < 6000; ++i) {
    const double t = i / 200.0;
    time.push_back(t);
    pressure.push_back(t < 1 ? 0 : 6e5 * (1 - std::exp(-(t - 1) / 5)));
  }
  EXPECT_EQ(settled_samples(time, pressure).rests, 2);
}

TEST(Settled, APressureThatStaysHasSettled) {
  const std::vector<double> time{0, 1, 2, 3}, pressure{5, 5, 5, 5};
  EXPECT_EQ(settled_samples(time, pressure).moving(), 0u);
  EXPECT_EQ(settled_samples({}, {}).moving(), 0u);
}

}  // namespace
}  // namespace sinew::identify::static_settled_test
