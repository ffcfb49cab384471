#include "sinew/control/gait/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sinew/control/gait/test_walk.h"

namespace sinew::gait::path_test {
namespace {

using test::degree;
using test::inch;

const robot::TwoLinks leg{8.875 * inch, 6.25 * inch};

void expect_point(robot::Point p, double x_inches, double y_inches) {
  EXPECT_NEAR(p.x, x_inches * inch, 1e-15);
  EXPECT_NEAR(p.y, y_inches * inch, 1e-15);
}

TEST(Path, CornersOfTheWalk) {
  const Plan plan = test::walk(robot::test::leg());
  const double lift = -0.081 * 6.5 * 6.5 + 0.2571 * 6.5 - 11.75;  // [66] at -6.5 in
  const double front = -0.081 * 9 - 0.2571 * 3 - 11.75;           // [66] at 3 in
  expect_point(foot_at(plan.phases[0], 0), -6.5, lift);
  expect_point(foot_at(plan.phases[0], 1), 3, front);
  expect_point(foot_at(plan.phases[1], 0), 3, -13.25);  // [67], [68]
  expect_point(foot_at(plan.phases[1], 1), 2, -13.5);
  expect_point(foot_at(plan.phases[2], 0), 2, -13.5);  // [69], [70]
  expect_point(foot_at(plan.phases[2], 1), -6.5, -13.5);

  // The three pieces are closed; the printed polynomial misses its neighbours by 2 and 1
  // thousandths.
  EXPECT_NEAR(lift, -13.5, 0.0020);
  EXPECT_NEAR(front, -13.25, 0.0010);
}

TEST(Path, IsContinuousWithinAPhase) {
  const Plan plan = test::walk(robot::test::leg());
  for (const Phase& phase : plan.phases) {
    robot::Point before = foot_at(phase, 0);
    for (int k = 1; k <= 1000; ++k) {
      const robot::Point now = foot_at(phase, k / 1000.0);
      // No coordinate is steeper than 9.5 in per phase, nor y than 0.8 in x.
      EXPECT_LE(std::abs(now.x - before.x), 9.6e-3 * inch);
      EXPECT_LE(std::abs(now.y - before.y), 0.8 * 9.6e-3 * inch);
      before = now;
    }
  }
}

// errata, 6.1: the walk requires angles of the knee beyond its limit of 289 deg (table 6-1).
TEST(Path, DesiredAnglesOfTheThesis) {
  const Plan plan = test::walk(robot::test::leg());
  double least = 360 * degree, beyond = 0;
  for (const Phase& phase : plan.phases)
    for (int k = 0; k < periods(plan, phase); ++k) {
      const double s = static_cast<double>(k) / steps_of_s(plan, phase);
      const double knee = robot::inverse(leg, foot_at(phase, s)).angle[1];
      least = std::min(least, knee);
      if (knee < 289 * degree) beyond += plan.high_level_period;
    }
  EXPECT_NEAR(least / degree, 278.9, 0.05);
  EXPECT_NEAR(beyond, 0.80, 0.011);

  const robot::Inverse end = robot::inverse(leg, foot_at(plan.phases[2], 1));
  EXPECT_NEAR(end.angle[1] / degree, 344.1, 0.05);
  EXPECT_NEAR(end.distance / inch, 14.98, 0.005);
  EXPECT_NEAR(end.longest / inch, 15.125, 1e-12);
}

TEST(Path, PolynomialInTime) {
  Phase phase = test::phase("arc", 1);
  phase.x.polynomial = {1, 2, 3};
  phase.y.polynomial = {4};
  const robot::Point p = foot_at(phase, 0.5);
  EXPECT_DOUBLE_EQ(p.x, 1 + 2 * 0.5 + 3 * 0.25);
  EXPECT_DOUBLE_EQ(p.y, 4);
}

TEST(Path, PolylineAtConstantSpeed) {
  Phase phase = test::phase("corner", 1);
  phase.points = {.x = {0, 3, 3}, .y = {0, 0, 1}};
  const auto at = [&](double s) { return foot_at(phase, s); };
  EXPECT_DOUBLE_EQ(at(0.375).x, 1.5);
  EXPECT_DOUBLE_EQ(at(0.75).x, 3);
  EXPECT_DOUBLE_EQ(at(0.75).y, 0);
  EXPECT_DOUBLE_EQ(at(0.875).y, 0.5);
  EXPECT_DOUBLE_EQ(at(1).y, 1);
  EXPECT_DOUBLE_EQ(at(7).y, 1);
}

TEST(Path, PolylineOfOnePointOrWithAPauseStandsStill) {
  Phase phase = test::phase("point", 1);
  phase.points = {.x = {2}, .y = {1}};
  EXPECT_EQ(foot_at(phase, 0.3).x, 2);
  phase.points = {.x = {0, 0, 1}, .y = {0, 0, 0}};
  EXPECT_DOUBLE_EQ(foot_at(phase, 0.5).x, 0.5);
}

TEST(Profile, NoneOneSeveral) {
  EXPECT_EQ(value_at({}, 0.5, 7), 7);
  EXPECT_EQ(value_at({3}, 0.9, 7), 3);
  const Profile three{0, 10, 0};
  EXPECT_DOUBLE_EQ(value_at(three, 0.25, 7), 5);
  EXPECT_DOUBLE_EQ(value_at(three, 0.5, 7), 10);
  EXPECT_DOUBLE_EQ(value_at(three, 1, 7), 0);
  EXPECT_DOUBLE_EQ(value_at(three, -1, 7), 0);
}

}  // namespace
}  // namespace sinew::gait::path_test
