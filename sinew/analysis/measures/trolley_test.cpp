#include "sinew/analysis/measures/trolley.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::analysis::trolley_test {
namespace {

constexpr double mass = 10.8, drag = 4.5, dt = 0.01;

TrolleyMotion under(double push, int rows, std::size_t start = 0) {
  const std::vector<double> force(static_cast<std::size_t>(rows), push);
  return integrate(force, std::vector<double>(force.size(), dt), drag, mass, start);
}

TEST(Trolley, ConstantForceIsAParabola) {
  const double push = 12, a = (push - drag) / mass;
  const TrolleyMotion m = under(push, 201);
  for (std::size_t i = 0; i < 201; ++i) {
    const double t = dt * static_cast<double>(i);
    EXPECT_NEAR(m.velocity[i], a * t, 1e-13);
    EXPECT_NEAR(m.position[i], 0.5 * a * t * t, 1e-13);
  }
}

TEST(Trolley, LessThanTheDragDoesNotMoveIt) {
  for (const double push : {-4.4, 0.0, 4.4}) {
    const TrolleyMotion m = under(push, 100);
    EXPECT_EQ(m.position.back(), 0) << push;
    EXPECT_EQ(m.velocity.back(), 0) << push;
  }
}

TEST(Trolley, IsPushedBackAgainstTheDragToo) {
  const double a = (-12 + drag) / mass;
  EXPECT_NEAR(under(-12, 101).velocity.back(), a, 1e-13);
}

// After 1 s of push the trolley coasts by v^2/(2 D/M) and then rests.
TEST(Trolley, CoastsToRestAndStays) {
  std::vector<double> push(600, 0.0);
  for (std::size_t i = 0; i < 100; ++i) push[i] = 15;
  push[100] = 15;  // falls linearly to zero over one sample afterwards
  const std::vector<double> seconds(push.size(), dt);
  const TrolleyMotion m = integrate(push, seconds, drag, mass, 0);

  const double v = m.velocity[101];
  EXPECT_NEAR(m.velocity[100], (15 - drag) / mass, 1e-12);
  // The step in which it stops is integrated as a trapezoid, with an error of at most v dt.
  EXPECT_NEAR(m.position.back() - m.position[101], 0.5 * v * v * mass / drag,
              0.5 * drag / mass * dt * dt);
  EXPECT_EQ(m.velocity.back(), 0);
  for (const double x : m.velocity) EXPECT_GE(x, 0);
}

TEST(Trolley, RestsUntilItsStart) {
  const TrolleyMotion m = under(12, 101, 50);
  EXPECT_EQ(m.position[50], 0);
  EXPECT_NEAR(m.velocity[100], (12 - drag) / mass * 0.5, 1e-13);
}

TEST(Trolley, APushThatIsNoNumberIsNone) {
  std::vector<double> push(100, std::nan(""));
  const TrolleyMotion m = integrate(push, std::vector<double>(100, dt), drag, mass, 0);
  EXPECT_EQ(m.position.back(), 0);
}

}  // namespace
}  // namespace sinew::analysis::trolley_test
