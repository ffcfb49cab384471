#include "sinew/control/gait/gait_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sinew/control/gait/path.h"
#include "sinew/control/gait/test_walk.h"
#include "tests/counted_heap.h"

namespace sinew::gait::gait_controller_test {
namespace {

using test::degree;
using test::inch;

const robot::TwoLinks links{8.875 * inch, 6.25 * inch};

// Returns the periods spent in each phase, by name, until the controller has finished.
std::map<std::string, int> spent(GaitController& controller, const Measured& measured = {}) {
  std::map<std::string, int> count;
  for (std::int64_t p = 0; p < 100000; ++p) {
    const Desired& want = controller.update(measured, p);
    if (want.stage == Stage::finished) break;
    const auto& phases = controller.plan().phases;
    ++count[want.phase < 0 ? "settling" : phases[static_cast<std::size_t>(want.phase)].name];
  }
  return count;
}

TEST(GaitController, FourStepsOfTheText) {
  const robot::Robot robot = robot::test::leg();
  GaitController controller(robot, test::walk(robot));
  const auto count = spent(controller);
  EXPECT_EQ(count.at("swing"), 4 * 150);
  EXPECT_EQ(count.at("foot_plant"), 4 * 3);
  EXPECT_EQ(count.at("propulsion"), 4 * 150);
  EXPECT_EQ(controller.desired().step, 3);
  EXPECT_TRUE(controller.desired().vent);
  EXPECT_FALSE(controller.desired().joint[0].enabled);
  EXPECT_EQ(controller.unreachable_periods(), 0);
}

// B.1: p[0] = -6.5 + timer * 0.01 * 9.5/1.5 for timer = 0 ... 150, and so on.
TEST(GaitController, LoopsOfTheCode) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.thesis_timing = true;
  plan.repeat = 1;
  GaitController controller(robot, plan);

  std::int64_t p = 0;
  const auto expect_x = [&](double inches) {
    EXPECT_NEAR(controller.update({}, p++).foot.x, inches * inch, 1e-15);
  };
  for (int timer = 0; timer <= 150; ++timer) expect_x(-6.5 + timer * 0.01 * 9.5 / 1.5);
  for (int timer = 0; timer <= 1; ++timer) expect_x(3 - timer * 0.01 * 1.0 / 0.01);
  for (int timer = 0; timer <= 150; ++timer) expect_x(2.0 - (timer * 0.01) * 8.5 / 1.5);
  EXPECT_EQ(controller.update({}, p).stage, Stage::finished);
}

TEST(GaitController, AnglesPutTheFootOnThePathWithTheThesissKnee) {
  const robot::Robot robot = robot::test::leg();
  GaitController controller(robot, test::walk(robot));
  for (std::int64_t p = 0; p < 303; ++p) {
    const Desired& want = controller.update({}, p);
    const robot::Point foot = robot::foot_position(links, want.joint[0].angle, want.joint[1].angle);
    ASSERT_NEAR(foot.x, want.foot.x, 2e-15);
    ASSERT_NEAR(foot.y, want.foot.y, 2e-15);
    ASSERT_GT(want.joint[1].angle, 180 * degree);
    ASSERT_FALSE(want.unreachable);
  }
}

TEST(GaitController, TheSamePeriodAgainGivesTheSame) {
  const robot::Robot robot = robot::test::leg();
  GaitController once(robot, test::walk(robot)), thrice(robot, test::walk(robot));
  for (std::int64_t p = 0; p < 400; ++p) {
    for (int i = 0; i < 3; ++i) thrice.update({}, p);
    EXPECT_EQ(once.update({}, p).joint[0].angle, thrice.desired().joint[0].angle);
  }
  // Skipped periods have passed all the same.
  GaitController jumps(robot, test::walk(robot));
  EXPECT_EQ(jumps.update({}, 399).joint[1].angle, once.desired().joint[1].angle);
}

TEST(GaitController, SettlesWithItsJointsLeftAlone) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.settle = 0.6;
  GaitController controller(robot, plan);
  for (std::int64_t p = 0; p < 60; ++p) {
    const Desired& want = controller.update({}, p);
    ASSERT_EQ(want.stage, Stage::settling);
    ASSERT_FALSE(want.joint[0].enabled);
    ASSERT_EQ(want.joint[0].angle, robot.joints[0].rest_angle);
    ASSERT_EQ(want.phase, -1);
  }
  EXPECT_EQ(controller.update({}, 60).progress, 0);
  EXPECT_TRUE(controller.desired().joint[0].enabled);
}

TEST(GaitController, HoldsAtTheEndIfRequested) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.finish = Plan::Finish::hold;
  GaitController controller(robot, plan);
  controller.update({}, 5000);
  EXPECT_TRUE(controller.finished());
  EXPECT_FALSE(controller.desired().vent);
  EXPECT_TRUE(controller.desired().joint[0].enabled);
  EXPECT_NEAR(controller.desired().foot.x, -6.5 * inch, 1e-15);
}

// Returns measurements of a standing foot: tensions for which [75] gives 5 N upwards.
Measured standing(const robot::Robot& robot, robot::Point force) {
  Measured m;
  const robot::Inverse inv = robot::inverse(links, {2.5 * inch, -13 * inch});
  const robot::Jacobian j = robot::jacobian(links, inv.angle[0], inv.angle[1]);
  const std::array torque{-(j.x1 * force.x + j.y1 * force.y), -(j.x2 * force.x + j.y2 * force.y)};
  for (std::size_t i = 0; i < 2; ++i) {
    m.angle[i] = inv.angle[i];
    const double pull = torque[i] / (robot.joints[i].sign() * robot.joints[i].moment_arm);
    m.tension[2 * i] = 100 + pull;
    m.tension[2 * i + 1] = 100;
  }
  return m;
}

TEST(GaitController, GroundReactionFromTensions) {
  const robot::Robot robot = robot::test::leg();
  const GaitController controller(robot, test::walk(robot));
  const robot::Point force = controller.ground_reaction(standing(robot, {1.5, 5}));
  EXPECT_NEAR(force.x, 1.5, 1e-12);
  EXPECT_NEAR(force.y, 5, 1e-12);
}

TEST(GaitController, APhaseEndsWhereTheFootStands) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[1].duration = 0.3;
  plan.phases[1].until = {.measure = "foot.normal_force", .is = Until::Is::above, .level = 4};
  plan.repeat = 1;

  GaitController never(robot, plan);
  EXPECT_EQ(spent(never, standing(robot, {0, 3})).at("foot_plant"), 30);  // latest end

  GaitController controller(robot, plan);
  std::int64_t p = 0;
  for (; p < 150 + 7; ++p) controller.update(standing(robot, {0, 0}), p);
  EXPECT_EQ(controller.desired().phase, 1);
  controller.update(standing(robot, {0, 5}), p++);
  EXPECT_EQ(controller.desired().phase, 2);
  EXPECT_EQ(controller.desired().progress, 0);
}

TEST(GaitController, APhaseLastsAtLeastOnePeriod) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  for (Phase& phase : plan.phases)
    phase.until = {.measure = "joint.hip.angle", .is = Until::Is::below, .level = 1};
  GaitController controller(robot, plan);
  const auto count = spent(controller);  // measured: 0 rad
  EXPECT_EQ(count.at("swing"), 4);
  EXPECT_EQ(count.at("foot_plant"), 4);
}

TEST(GaitController, OutOfReachItAimsAtTheNearestPointAndCounts) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[2].x.to = -9 * inch;
  plan.repeat = 2;
  GaitController controller(robot, plan);
  std::int64_t flagged = 0;
  for (std::int64_t p = 0; p < 606; ++p) {
    const Desired& want = controller.update({}, p);
    flagged += want.unreachable;
    const robot::Point aim = robot::foot_position(links, want.joint[0].angle, want.joint[1].angle);
    const robot::Inverse inv = robot::inverse(links, want.foot);
    ASSERT_NEAR(aim.x, inv.nearest.x, 1e-9);
    ASSERT_NEAR(aim.y, inv.nearest.y, 1e-9);
  }
  EXPECT_GT(flagged, 0);
  EXPECT_EQ(controller.unreachable_periods(), flagged);
}

TEST(GaitController, WhatAPhaseChangesHoldsFromThenOn) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[0].joints[0].stiffness = {4, 2};     // a ramp
  plan.phases[1].joints[1].gains.angle = {0.002};  // from the plant on
  plan.phases[2].joints[1].gains.angle = {0.0015};
  GaitController controller(robot, plan);
  EXPECT_EQ(controller.update({}, 0).joint[1].gains.angle, robot.joints[1].gains.angle);
  EXPECT_DOUBLE_EQ(controller.update({}, 75).joint[0].stiffness, 3);
  EXPECT_DOUBLE_EQ(controller.update({}, 150).joint[0].stiffness, 2);  // s = 1 was reached
  EXPECT_EQ(controller.desired().joint[1].gains.angle, 0.002);
  EXPECT_EQ(controller.update({}, 303).joint[1].gains.angle, 0.0015);  // the second swing
  EXPECT_DOUBLE_EQ(controller.desired().joint[0].stiffness, 4);
}

TEST(GaitController, OpenLoopAndDisabledLastAsLongAsTheirPhase) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[0].joints[0].feedforward.flexor_inlet = {1};
  plan.phases[0].disabled = {"knee"};
  GaitController controller(robot, plan);
  controller.update({}, 10);
  EXPECT_TRUE(controller.desired().joint[0].open_loop);
  EXPECT_EQ(controller.desired().joint[0].flexor_inlet, 1);
  EXPECT_EQ(controller.desired().joint[0].extensor_exhaust, 0);
  EXPECT_FALSE(controller.desired().joint[1].enabled);
  controller.update({}, 150);
  EXPECT_FALSE(controller.desired().joint[0].open_loop);
  EXPECT_TRUE(controller.desired().joint[1].enabled);
}

TEST(GaitController, JointAnglesNeedNoFoot) {
  robot::Robot robot = robot::test::leg();
  Plan plan = plan_for(robot);
  Phase turn = test::phase("turn", 1);
  turn.joints[0].angle = {278 * degree, 298 * degree};
  plan.phases = {turn};
  plan.sequence = {"turn"};
  GaitController controller(robot, plan);
  controller.update({}, 50);
  EXPECT_NEAR(controller.desired().joint[0].angle, 288 * degree, 1e-14);
  EXPECT_EQ(controller.desired().joint[1].angle, robot.joints[1].rest_angle);
  EXPECT_FALSE(controller.desired().has_foot);
}

TEST(GaitController, NoHeapInUpdate) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[1].until = {.measure = "foot.normal_force", .is = Until::Is::above, .level = 4};
  plan.phases[0].points = {{0, 0.1, 0.1}, {-0.3, -0.3, -0.32}};
  plan.phases[2].joints[0].stiffness = {4, 2, 4};
  plan.phases[2].ground_force = {.desired = 20, .gain = 1e-3, .limit = 0.01};
  plan.phases[2].cylinder = {{}, {0.3, 1}, CylinderPhase::Of::foot_y};
  plan.joints[1].range = {5, 6};
  GaitController controller(robot, plan);
  const Measured measured = standing(robot, {0, 0});
  sinew::test::allocations = 0;
  sinew::test::counting = true;
  for (std::int64_t p = 0; p < 2000; ++p) controller.update(measured, p);
  sinew::test::counting = false;
  EXPECT_EQ(sinew::test::allocations, 0);
  EXPECT_TRUE(controller.finished());
}

}  // namespace
}  // namespace sinew::gait::gait_controller_test
