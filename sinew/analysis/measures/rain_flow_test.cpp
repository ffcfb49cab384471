// Rain flow: sequences counted by hand, and laws of the count.

#include "sinew/analysis/measures/rain_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace sinew::analysis::rain_flow_test {
namespace {

using signals::Column;
using Counts = std::map<double, double>;  // cycles by range

Counts counts(const std::vector<Cycle>& cycles) {
  Counts out;
  for (const Cycle& c : cycles) out[c.range] += c.count;
  return out;
}

// A walk of whole numbers, so that sums and differences are exact.
std::vector<double> random_walk(unsigned seed, int steps) {
  std::mt19937 engine(seed);
  std::vector<double> out{0};
  for (int i = 0; i < steps; ++i)
    out.push_back(out.back() + static_cast<double>(engine() % 21) - 10.0);
  return out;
}

// The standard's example, its figure 6.
TEST(RainFlow, CountsTheExampleOfTheStandard) {
  EXPECT_EQ(counts(rain_flow(Column{-2, 1, -3, 5, -1, 3, -4, 4, -2})),
            (Counts{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}}));
}

TEST(RainFlow, CountsASmallCycleWithinALargeOne) {
  const std::vector<Cycle> cycles = rain_flow(Column{0, 6, 4, 10, 0});
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_EQ(cycles[0].range, 2);
  EXPECT_EQ(cycles[0].mean, 5);
  EXPECT_EQ(cycles[0].count, 1);
  EXPECT_EQ(counts(cycles), (Counts{{2, 1}, {10, 1}}));
}

TEST(RainFlow, AMonotonicSeriesIsHalfACycle) {
  EXPECT_EQ(counts(rain_flow(Column{1, 2, 4, 8, 8, 9})), (Counts{{8, 0.5}}));
  EXPECT_EQ(counts(rain_flow(Column{3, 1, -2})), (Counts{{5, 0.5}}));
  EXPECT_TRUE(rain_flow(Column{3, 3, 3}).empty());
  EXPECT_TRUE(rain_flow(Column{}).empty());
}

TEST(RainFlow, PeriodsAreCycles) {
  for (const int periods : {1, 2, 7}) {
    Column wave;
    for (int i = 0; i <= 40 * periods; ++i) wave.push_back(3 * std::cos(i * std::numbers::pi / 20));
    const std::vector<Cycle> cycles = rain_flow(wave, 1);
    EXPECT_EQ(cycles_in(cycles), periods);
    EXPECT_NEAR(largest_range(cycles), 6, 1e-12);
  }
}

TEST(RainFlow, PointsOnAMonotonicStretchChangeNothing) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::vector<double> walk = random_walk(seed, 60);
    Column more;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      if (i > 0) more.push_back(0.5 * (walk[i - 1] + walk[i]));
      more.push_back(walk[i]);
      more.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    EXPECT_EQ(counts(rain_flow(more)), counts(rain_flow(walk))) << seed;
  }
}

TEST(RainFlow, FollowsOffsetScaleAndSign) {
  const std::vector<double> walk = random_walk(5, 200);
  Column other;
  for (const double x : walk) other.push_back(7 - 2 * x);
  Counts twice;
  for (const auto& [range, count] : counts(rain_flow(walk))) twice[2 * range] = count;
  EXPECT_EQ(counts(rain_flow(other)), twice);
}

// A series that begins and ends at its highest value is counted as whole cycles; two of them in a
// row have twice the cycles, and it may begin at any of its points.
TEST(RainFlow, AClosedSeriesRepeats) {
  std::vector<double> walk = random_walk(9, 100);
  walk.push_back(walk.front());
  const auto top = std::ranges::max_element(walk);
  std::vector<double> closed(top, walk.end() - 1);
  closed.insert(closed.end(), walk.begin(), top + 1);
  std::vector<double> again = closed;
  again.insert(again.end(), closed.begin() + 1, closed.end());
  Counts twice;
  for (const auto& [range, count] : counts(rain_flow(closed))) {
    EXPECT_EQ(count, std::floor(count)) << range;
    twice[range] = 2 * count;
  }
  EXPECT_EQ(counts(rain_flow(again)), twice);
}

TEST(RainFlow, EachTurningPointIsCounted) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::vector<double> walk = random_walk(seed, 80);
    double reversals = 0, direction = 0;
    for (std::size_t i = 1; i < walk.size(); ++i) {
      const double step = walk[i] - walk[i - 1];
      if (step == 0) continue;
      if (step * direction < 0) ++reversals;
      direction = step;
    }
    EXPECT_EQ(1 + 2 * cycles_in(rain_flow(walk)), reversals + 2) << seed;
  }
}

TEST(RainFlow, LeavesOutNoise) {
  Column noisy;
  for (int i = 0; i <= 400; ++i)
    noisy.push_back(50 * std::cos(i * std::numbers::pi / 100) + (i % 2 == 0 ? 0.5 : -0.5));
  EXPECT_GT(cycles_in(rain_flow(noisy)), 50);
  EXPECT_EQ(cycles_in(rain_flow(noisy, 20)), 2);
}

}  // namespace
}  // namespace sinew::analysis::rain_flow_test
