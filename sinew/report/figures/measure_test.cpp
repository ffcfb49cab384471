// Measurements of curves give the parameters of the curves.
#include "sinew/report/figures/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sinew::report::measure_test {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

struct Curve {
  std::vector<double> x, y;
  Trace trace() const { return {x, y}; }
};

template <class F>
Curve drawn(double from, double to, int steps, F f) {
  Curve out;
  for (int i = 0; i <= steps; ++i) {
    out.x.push_back(from + (to - from) * i / steps);
    out.y.push_back(f(out.x.back()));
  }
  return out;
}

TEST(Measure, ReadsBetweenSamplesAndNothingOutside) {
  const Curve c{{0, 1, 2, 3}, {0, gap, 4, 4}};
  EXPECT_DOUBLE_EQ(value_at(c.trace(), 0.5), 1);  // over the gap
  EXPECT_DOUBLE_EQ(value_at(c.trace(), 3), 4);
  EXPECT_TRUE(std::isnan(value_at(c.trace(), 3.1)));
  EXPECT_TRUE(std::isnan(value_at(c.trace(), -0.1)));
}

TEST(Measure, FindsTheFirstCrossing) {
  const Curve c = drawn(0, 2 * std::numbers::pi, 4000, [](double x) { return std::sin(x); });
  EXPECT_NEAR(first_at_least(c.trace(), 0.5), std::numbers::pi / 6, 1e-6);
  EXPECT_NEAR(first_at_most(c.trace(), 0.5, 1.0), 5 * std::numbers::pi / 6, 1e-6);
  EXPECT_TRUE(std::isnan(first_at_least(c.trace(), 2)));
}

// A parabola over [0, 1] has a range of 1 and differs by at most 1/6 from its line of least
// squares.
TEST(Measure, ALineDoesNotBendAndAParabolaDoes) {
  const Curve line = drawn(-3, 5, 100, [](double x) { return 2 - 7 * x; });
  EXPECT_NEAR(bend(line.trace()), 0, 1e-12);
  EXPECT_NEAR(line_of(line.trace()).slope, -7, 1e-12);
  EXPECT_NEAR(line_of(line.trace()).offset, 2, 1e-12);
  const Curve parabola = drawn(0, 1, 10'000, [](double x) { return x * x; });
  EXPECT_NEAR(bend(parabola.trace()), 1.0 / 6, 1e-3);
}

TEST(Measure, FallsAreFromAnEarlierHeight) {
  const Curve c{{0, 1, 2, 3, 4}, {0, 3, 2, gap, 1}};
  EXPECT_DOUBLE_EQ(largest_fall(c.trace()), 2);
  EXPECT_DOUBLE_EQ(largest_fall(Curve{{0, 1}, {1, 2}}.trace()), 0);
}

TEST(Measure, DipsAreTurns) {
  const Curve c{{0, 1, 2, 3, 4, 5}, {0, 2, 1, 1, 3, 0}};
  EXPECT_DOUBLE_EQ(first_dip(c.trace()), 2);
  EXPECT_TRUE(std::isnan(first_dip(c.trace(), 2.5)));
  EXPECT_TRUE(std::isnan(first_dip(drawn(0, 1, 9, [](double x) { return -x; }).trace())));
}

// The result for a fast sine on a slow ramp is the amplitude of the sine.
TEST(Measure, AmplitudeIsOfWhatIsFast) {
  const Curve c = drawn(0, 10, 10'000,
                        [](double x) { return 5 * x + 0.3 * std::sin(2 * std::numbers::pi * x); });
  EXPECT_NEAR(amplitude(c.trace(), 1.0), 0.3, 0.002);
  EXPECT_NEAR(amplitude(part(c.trace(), 2, 8), 1.0), 0.3, 0.002);
}

TEST(Measure, PartsKeepTheirEnds) {
  const Curve c = drawn(0, 10, 10, [](double x) { return x; });
  const Trace middle = part(c.trace(), 2, 4);
  EXPECT_EQ(middle.x.size(), 3u);
  EXPECT_DOUBLE_EQ(mean(middle), 3);
  EXPECT_DOUBLE_EQ(least(middle), 2);
  EXPECT_DOUBLE_EQ(greatest(middle), 4);
  EXPECT_TRUE(part(c.trace(), 11, 12).x.empty());
}

}  // namespace
}  // namespace sinew::report::measure_test
