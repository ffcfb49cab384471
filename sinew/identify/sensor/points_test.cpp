// Steps, noise and limits are found from the readings of any sensor.
#include "sinew/identify/sensor/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sinew::identify::points_test {
namespace {

struct Readings {
  std::vector<double> known, output;
};

// Readings up and down over `levels`, `repeats` each: V = 0.3 + 0.17 x, with `lag` added on the way
// back, clipped to [0, top] and rounded to steps.
Readings readings(unsigned seed, int levels, int repeats, double noise, double step, double lag = 0,
                  double top = 1e9) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise > 0 ? noise : 1);
  Readings r;
  for (int i = 0; i < 2 * levels - 1; ++i)
    for (int k = 0; k < repeats; ++k) {
      const int level = i < levels ? i : 2 * levels - 2 - i;
      double v = 0.3 + 0.17 * level + (i < levels ? 0 : lag) + (noise > 0 ? normal(random) : 0);
      v = std::clamp(v, 0.0, top);
      r.known.push_back(level);
      r.output.push_back(step > 0 ? step * std::round(v / step) : v);
    }
  return r;
}

TEST(SensorPoints, AreTheMeansOfEachWay) {
  const Readings r = readings(1, 6, 4, 0.01, 0);
  const std::vector<Point> points = points_of(r.known, r.output);
  ASSERT_EQ(points.size(), 11u);
  EXPECT_EQ(level_count(points), 6u);
  double sum = 0, all = 0;
  for (const Point& p : points) sum += p.output * static_cast<double>(p.rows.size());
  for (const double v : r.output) all += v;
  EXPECT_NEAR(sum, all, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(points, {}, &Point::known));
  EXPECT_EQ(points[2].direction, 1);
  EXPECT_EQ(points[3].direction, -1);
  EXPECT_EQ(points[3].level, 1u) << "the top has one point: it is reached from below only";
}

double step(const Readings& r) { return step_of(points_of(r.known, r.output), r.output); }

TEST(SensorPoints, StepsAreFoundAndNothingIsFoundWhereThereAreNone) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const double truth = 5.0 / 4096;
    Readings r = readings(seed, 10, 20, 0.004, truth);
    EXPECT_NEAR(step(r), truth, 1e-9);
    for (double& v : r.output) v = std::round(v * 1e4) / 1e4;  // as files write it
    EXPECT_NEAR(step(r), truth, 0.01 * truth);
    EXPECT_TRUE(std::isnan(step(readings(seed, 10, 20, 0.004, 0))));
  }
  EXPECT_TRUE(std::isnan(step({{1, 2, 3}, {1, 2, 3}}))) << "too few to tell";
  EXPECT_TRUE(std::isnan(step(readings(1, 20, 1, 0, 0)))) << "that is the loads' distance";
  EXPECT_NEAR(step(readings(1, 200, 1, 0, 1)), 1, 1e-9) << "a coarse one shows on many loads";
}

TEST(SensorPoints, NoiseIsTheNoiseWithoutTheSteps) {
  for (const double size : {0.0, 0.004, 0.01}) {
    double mean = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Readings r = readings(seed, 10, 30, 0.005, size);
      mean += noise_of(points_of(r.known, r.output), r.output, size) / 20;
    }
    EXPECT_NEAR(mean, 0.005, 0.05 * 0.005) << size;
  }
  const Readings once = readings(1, 10, 1, 0.005, 0);
  EXPECT_TRUE(std::isnan(noise_of(points_of(once.known, once.output), once.output, 0)));
}

TEST(SensorPoints, HysteresisIsTheDifferenceOfTheWays) {
  const Readings plain = readings(1, 8, 1, 0, 0, 0.02);
  const Hysteresis h = hysteresis_of(points_of(plain.known, plain.output), NAN);
  EXPECT_NEAR(h.largest, 0.02, 1e-12);

  // Noise alone stays below its stated limit in about 99 of 100 trials.
  int within = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Readings r = readings(seed, 5, 10, 0.01, 0);
    const std::vector<Point> points = points_of(r.known, r.output);
    const Hysteresis n = hysteresis_of(points, noise_of(points, r.output, 0));
    within += n.largest <= n.by_noise;
  }
  EXPECT_GE(within, 190);

  const Readings one_way{{0, 1, 2, 3}, {0, 1, 2, 3}};
  EXPECT_TRUE(std::isnan(hysteresis_of(points_of(one_way.known, one_way.output), 0).largest));
}

TEST(SensorPoints, AnEndIsWhereReadingsStayAlthoughTheyShouldDiffer) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Readings whole = readings(seed, 20, 5, 0.005, 5.0 / 4096);
    const Ends none = ends_of(points_of(whole.known, whole.output), whole.output, 5.0 / 4096, 5.0);
    EXPECT_TRUE(none.at_top.empty() && none.at_bottom.empty());

    // An amplifier is limited to 2.5 V, below the converter's range: from 12.9 on.
    const Readings cut = readings(seed, 20, 5, 0.005, 0, 0, 2.5);
    const Ends ends = ends_of(points_of(cut.known, cut.output), cut.output, NAN, 5.0);
    EXPECT_EQ(ends.top, 2.5);
    EXPECT_EQ(static_cast<long>(ends.at_top.size()), std::ranges::count(cut.output, 2.5));
    EXPECT_TRUE(ends.at_bottom.empty());
  }
  // Steps coarser than the levels are not a limit.
  const Readings coarse = readings(1, 20, 1, 0, 0.5);
  const Ends steps = ends_of(points_of(coarse.known, coarse.output), coarse.output, 0.5, 5.0);
  EXPECT_TRUE(steps.at_top.empty() && steps.at_bottom.empty());
}

TEST(SensorPoints, ZeroIsAnEndOnlyWhereTheOthersLeadBelowIt) {
  std::vector<double> known, through, cut;
  for (int i = 0; i < 10; ++i) {
    known.push_back(i);
    through.push_back(0.2 * i);
    cut.push_back(std::max(0.0, 0.2 * i - 0.1));
  }
  EXPECT_TRUE(ends_of(points_of(known, through), through, NAN, 5.0).at_bottom.empty());
  EXPECT_EQ(ends_of(points_of(known, cut), cut, NAN, 5.0).at_bottom, (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace sinew::identify::points_test
