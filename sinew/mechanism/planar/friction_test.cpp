// Dry friction: sticks, slides, and shares loads that rigid bodies do not determine.
#include "sinew/mechanism/friction/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/mechanism/planar/test_setups.h"
#include "sinew/world/machine.h"

namespace sinew::plant::friction_test {
namespace {

// A random well-posed problem: W = A A^T + 0.1 I.
template <int C>
FrictionProblem<C> random_problem(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> bounds(0.05, 2.0);
  FrictionProblem<C> p{};
  double a[C][C];
  for (auto& row : a)
    for (double& v : row) v = normal(random);
  for (int i = 0; i < C; ++i) {
    p.slip[i] = normal(random);
    p.bound[i] = bounds(random);
    for (int j = 0; j < C; ++j) {
      p.response[i][j] = i == j ? 0.1 : 0.0;
      for (int k = 0; k < C; ++k) p.response[i][j] += a[i][k] * a[j][k];
    }
  }
  return p;
}

// The law itself: |f| <= bound, and either no slip or the full force against it.
TEST(Friction, StickOrSlideIsSolvedExactly) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 5000; ++trial) {
    const FrictionProblem<4> p = random_problem<4>(random);
    std::array<double, 4> last{};
    if (trial % 2) last = {0.3, -0.2, 1.5, -2.0};  // a history that may be wrong
    const std::array<double, 4> f = solve_friction<4>(p, last);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LE(std::abs(f[i]), p.bound[i] * (1 + 1e-12));
      double s = p.slip[i];
      for (int j = 0; j < 4; ++j) s += p.response[i][j] * f[j];
      const bool slides = std::abs(f[i]) > p.bound[i] * (1 - 1e-12);
      EXPECT_LE(slides ? s * f[i] : std::abs(s), 1e-6) << trial;
    }
  }
}

TEST(Friction, ItNeverAddsEnergy) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const FrictionProblem<4> p = random_problem<4>(random);
    const std::array<double, 4> f = solve_friction<4>(p, {});
    // Work per step against the mean of the slips before and after.
    double work = 0;
    for (int i = 0; i < 4; ++i) {
      double s = p.slip[i];
      for (int j = 0; j < 4; ++j) s += 0.5 * p.response[i][j] * f[j];
      work += s * f[i];
    }
    EXPECT_LE(work, 1e-9);
  }
}

// Two contacts in series with one degree of freedom: each alone could hold; the load keeps its
// shares.
TEST(Friction, SharesOfAnUndeterminedLoadAreRemembered) {
  FrictionProblem<2> p{};
  p.response = {{{1.0, 1.0}, {1.0, 1.0}}};
  p.bound = {5.0, 5.0};
  p.slip = {-3.0, -3.0};  // needs f0 + f1 = 3
  const std::array<double, 2> f = solve_friction<2>(p, {2.5, 0.5});
  EXPECT_NEAR(f[0], 2.5, 1e-6);
  EXPECT_NEAR(f[1], 0.5, 1e-6);
  p.slip = {-4.0, -4.0};  // one more: shared equally
  const std::array<double, 2> g = solve_friction<2>(p, f);
  EXPECT_NEAR(g[0], 3.0, 1e-6);
  EXPECT_NEAR(g[1], 1.0, 1e-6);
}

// A trolley pushed by less than its drag does not creep; pushed by more it accelerates by the
// difference.
TEST(Friction, ATrolleySticksUnderLoad) {
  for (const double push : {3.0, 6.0}) {
    plant::Setup setup = leg_without_muscles(4.712, 0.0);
    setup.robot.trolley.drag = 4.0;
    setup.robot.gravity = 0;
    // The stop of the track is a spring that pushes: 1 m beyond it at the start, without damping.
    setup.robot.trolley.track_length = -1.0;
    setup.robot.trolley.stop_stiffness = push;
    setup.robot.trolley.stop_damping = 0;
    ChainWorld<2> world(setup);
    world.set_rates({0, 0}, 0);
    world.advance(0.1);
    const double moved = -world.motion().x;
    // The hanging leg lags behind, so the trolley starts a little faster than with all of its mass.
    const double expected = push > 4.0 ? 0.5 * (push - 4.0) / (23.8 * pound) * 0.01 : 0.0;
    EXPECT_NEAR(moved, expected, push > 4.0 ? 2e-4 : 1e-15);
    EXPECT_GE(moved, 0.9 * expected);
  }
}

// A blocked joint keeps its angle under any load: here gravity, for ten seconds.
TEST(Friction, ABlockedJointDoesNotMove) {
  plant::Setup setup = leg_without_muscles(0.0, 0.3);
  setup.start.blocked = {true, true};
  ChainWorld<2> world(setup);
  world.advance(10.0);
  EXPECT_NEAR(world.motion().angle[0], 0.0, 1e-6);
  EXPECT_NEAR(world.motion().angle[1], 0.3, 1e-6);
}

// A standing foot that must not slide: the friction that it needs is inside the cone.
TEST(Friction, TheFootKeepsItsCone) {
  plant::Setup setup = leg_without_muscles(5.1, 5.0);
  setup.robot.ground.present = true;
  setup.robot.foot.friction = 0.3;
  setup.robot.joints[0].dry_friction = 0.3;
  setup.robot.joints[1].dry_friction = 0.05;
  ChainWorld<2> world(setup);
  bool touched = false;
  for (int k = 1; k < 1000; ++k) {
    const Truth now = world.truth(k * 1e-3);
    touched = touched || now.foot[0].force_y > 0.5;
    EXPECT_LE(std::abs(now.foot[0].force_x), 0.3 * now.foot[0].force_y * 1.2 + 0.1)
        << k;  // held over a step
  }
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace sinew::plant::friction_test
