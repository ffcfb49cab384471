#include "sinew/run/setup/stance.h"
#include "tests/places.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sinew::run::stance_test {
namespace {

const experiment::Experiment leg =
    experiment::load(sinew::test::source_dir() + "/experiments/walk-test-1.toml");

std::vector<double> rest() {
  std::vector<double> out;
  for (const robot::Joint& j : leg.robot.joints) out.push_back(j.rest_angle);
  return out;
}

TEST(Stance, AtRestMusclesAreAsLongAsTheyWereMounted) {
  const Stance s = stance(leg, rest());
  ASSERT_EQ(s.muscles.size(), leg.robot.muscles.size());
  for (std::size_t i = 0; i < s.muscles.size(); ++i)
    EXPECT_NEAR(s.muscles[i].length, leg.robot.muscles[i].mount_length, 1e-12);
}

TEST(Stance, AWholeTurnMakesNoMuscleLonger) {
  std::vector<double> turned = rest();
  turned[0] += 2 * std::numbers::pi;
  turned[1] -= 2 * std::numbers::pi;
  const Stance a = stance(leg, rest()), b = stance(leg, turned);
  for (std::size_t i = 0; i < a.muscles.size(); ++i)
    EXPECT_NEAR(a.muscles[i].length, b.muscles[i].length, 1e-12);
}

// Jacobian of foot and lengths by central differences of 1e-6 rad, whose error is of second order.
TEST(Stance, TheJacobianIsTheFootsSlope) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-0.3, 0.3);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> at = rest();
    for (double& angle : at) angle += turn(random);
    const Stance s = stance(leg, at);
    ASSERT_TRUE(s.jacobian);
    const double slope[2][2] = {{s.jacobian->x1, s.jacobian->x2}, {s.jacobian->y1, s.jacobian->y2}};
    for (std::size_t j = 0; j < 2; ++j) {
      std::vector<double> more = at, less = at;
      more[j] += 1e-6, less[j] -= 1e-6;
      const robot::Point a = stance(leg, less).foot, b = stance(leg, more).foot;
      EXPECT_NEAR(slope[0][j], (b.x - a.x) / 2e-6, 1e-8);
      EXPECT_NEAR(slope[1][j], (b.y - a.y) / 2e-6, 1e-8);
    }
  }
}

TEST(Stance, FarFromRestAMuscleIsBeyondItsLengths) {
  EXPECT_TRUE(stance(leg, rest()).within());
  std::vector<double> far = rest();
  far[0] += 2.5;
  EXPECT_FALSE(stance(leg, far).within());
}

}  // namespace
}  // namespace sinew::run::stance_test
