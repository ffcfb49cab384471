#include "sinew/robot/sensing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::robot::sensing_test {
namespace {

TEST(Noise, IsUnitAndWhiteOverTicksAndSensors) {
  double sum = 0, square = 0, neighbours = 0, previous = 0, across = 0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double v = noise(42, 3, i);
    sum += v;
    square += v * v;
    neighbours += v * previous;
    across += v * noise(42, 4, i);
    previous = v;
  }
  const double limit = 4 / std::sqrt(n);  // four standard errors
  EXPECT_NEAR(sum / n, 0.0, limit);
  EXPECT_NEAR(square / n, 1.0, 2 * limit);
  EXPECT_NEAR(neighbours / n, 0.0, limit);
  EXPECT_NEAR(across / n, 0.0, limit);
  EXPECT_EQ(noise(42, 3, 17), noise(42, 3, 17));
  EXPECT_NE(noise(42, 3, 17), noise(43, 3, 17));
}

TEST(Counts, TensionClipsAtTheTopOfTheConverter) {
  // 4.4: 0.17 V/lb x 30 lb = 5.1 V is beyond 5 V; the reading ends at 29.4 lb.
  constexpr double pound_force = 4.4482216152605;
  const Sensor s{.kind = robot::Sensor::Kind::tension, .scale = 0.17 / pound_force};
  const Converter converter;
  EXPECT_EQ(counts(s, converter, 10 * pound_force, 0), 1393);  // 139.264 counts/lb
  EXPECT_EQ(counts(s, converter, 30 * pound_force, 0), 4095);
  EXPECT_NEAR(4095 / 139.264, 29.4, 0.01);
  EXPECT_EQ(counts(s, converter, -1.0, 0), 0);
}

TEST(Counts, APotentiometerCountsFromItsRestAngle) {
  // 4.5: 1.147 rad/V is 714 counts/rad.
  const Sensor s{.kind = Sensor::Kind::angle, .scale = 1.147, .at_rest = 1895, .noise = 0.5};
  const Converter converter;
  EXPECT_EQ(counts(s, converter, 0, 0), 1895);
  EXPECT_EQ(counts(s, converter, 1.0, 0), 1895 + 714);
  EXPECT_EQ(counts(s, converter, 0, 2.0), 1896);
}

}  // namespace
}  // namespace sinew::robot::sensing_test
