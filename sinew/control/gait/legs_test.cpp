// Tests legs that share a plan, each with its own controller.
#include "sinew/control/gait/legs.h"

#include <gtest/gtest.h>

#include <random>

#include "sinew/control/gait/test_walk.h"

namespace sinew::gait::legs_test {
namespace {

robot::Robot antiphase() {
  robot::Robot robot = robot::test::two_legs();
  robot.legs[1].offset = 0.5;
  return robot;
}

MachineMeasured at_rest(const robot::Robot& robot) {
  MachineMeasured out;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) out.angle[j] = robot.joints[j].rest_angle;
  return out;
}

std::string phase_of(const Legs& legs, std::size_t leg) {
  const int phase = legs.desired(leg).phase;
  return phase < 0 ? "" : legs.controller(leg).plan().phases[static_cast<std::size_t>(phase)].name;
}

// One leg alone has the setpoints of its controller, for all measurements.
TEST(Legs, OneLegIsItsBrain) {
  const robot::Robot robot = robot::test::leg();
  const Plan plan = test::walk(robot);
  Legs legs(robot, plan);
  GaitController controller(robot, plan);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 6);
  ASSERT_EQ(legs.count(), 1u);
  for (std::int64_t k = 0; k <= periods(plan) + 2; ++k) {
    Measured m;
    MachineMeasured machine;
    for (std::size_t j = 0; j < 2; ++j) m.angle[j] = machine.angle[j] = any(random);
    for (std::size_t i = 0; i < 4; ++i) m.tension[i] = machine.tension[i] = 20 * any(random);
    legs.update(machine, k);
    const Desired& want = controller.update(m, k);
    for (std::size_t j = 0; j < 2; ++j)
      ASSERT_EQ(legs.desired(0).joint[j].angle, want.joint[j].angle);
    ASSERT_EQ(legs.desired(0).phase, want.phase);
    ASSERT_EQ(legs.finished(), controller.finished());
  }
}

// The first leg has the setpoints of the second one half a step later; both end together.
TEST(Legs, AntiphaseIsHalfAStepAhead) {
  const robot::Robot robot = antiphase();
  const Plan plan = test::walk(robot);
  Legs legs(robot, plan);
  const int step = periods_per_step(plan), half = (step + 1) / 2;
  const MachineMeasured still = at_rest(robot);
  std::vector<double> left, right;
  std::int64_t k = 0;
  for (; !legs.finished(); ++k) {
    legs.update(still, k);
    if (legs.finished()) break;
    EXPECT_EQ(legs.desired(0).stage, legs.desired(1).stage);
    left.push_back(legs.desired(0).joint[0].angle);
    right.push_back(legs.desired(1).joint[0].angle);
  }
  EXPECT_EQ(k, plan.repeat * step);
  EXPECT_EQ(k, periods(robot, plan));
  for (std::size_t i = 0; i + static_cast<std::size_t>(half) < left.size(); ++i)
    ASSERT_EQ(right[i], left[i + static_cast<std::size_t>(half)]) << i;
  for (std::size_t leg = 0; leg < 2; ++leg) EXPECT_TRUE(legs.desired(leg).vent);
}

// A measure of one leg ends only that leg's phase; it then waits at the start of the next one until
// the other leg has reached it, and the offset is kept.
TEST(Legs, WhoIsEarlyWaitsForTheOthers) {
  const robot::Robot robot = antiphase();
  Plan plan = test::walk(robot);
  plan.phases[0].until = {.measure = "joint.knee.angle", .is = Until::Is::above, .level = 6};
  Legs legs(robot, plan);
  const int step = periods_per_step(plan);
  MachineMeasured m = at_rest(robot);
  for (std::int64_t k = 0; k < 100; ++k) legs.update(m, k);
  EXPECT_EQ(phase_of(legs, 0), "swing");
  EXPECT_EQ(phase_of(legs, 1), "propulsion");

  m.angle[1] = 6.1;  // the left knee
  legs.update(m, 100);
  m = at_rest(robot);
  EXPECT_EQ(phase_of(legs, 0), "foot_plant");
  EXPECT_EQ(phase_of(legs, 1), "propulsion");
  std::int64_t k = 101;
  for (; phase_of(legs, 0) == "foot_plant"; ++k) {
    legs.update(m, k);
    ASSERT_LT(k, step);
  }
  EXPECT_EQ(k - 1, 150 + 3);  // as if the swing had taken its full time
  EXPECT_EQ(legs.controller(0).planned_periods(), legs.controller(1).planned_periods());

  // The right knee's angle is the right leg's measure.
  Legs others(robot, plan);
  for (std::int64_t i = 0; i < 200; ++i) others.update(m, i);
  EXPECT_EQ(phase_of(others, 1), "swing");
  m.angle[3] = 6.1;
  others.update(m, 200);
  EXPECT_EQ(phase_of(others, 0), "propulsion");
  EXPECT_EQ(phase_of(others, 1), "foot_plant");
}

// [75] uses each leg's own tensions.
TEST(Legs, GroundReactionOfEachLeg) {
  const robot::Robot robot = antiphase(), one = robot::test::leg();
  Legs legs(robot, test::walk(robot));
  const GaitController controller(one, test::walk(one));
  MachineMeasured m;
  Measured left, right;
  m.angle = {5.2, 5.0, 4.9, 5.3};
  m.tension = {10, 60, 20, 40, 15, 90, 30, 35};
  left.angle = {5.2, 5.0}, right.angle = {4.9, 5.3};
  left.tension = {10, 60, 20, 40}, right.tension = {15, 90, 30, 35};
  const auto reaction = [&](std::size_t leg) {
    return legs.controller(leg).ground_reaction(leg == 0 ? left : right);
  };
  EXPECT_EQ(reaction(0).y, controller.ground_reaction(left).y);
  EXPECT_EQ(reaction(1).x, controller.ground_reaction(right).x);
  EXPECT_NE(reaction(0).y, reaction(1).y);
}

// A leg may have its own order of phases.
TEST(Legs, APlanOfItsOwn) {
  robot::Robot robot = robot::test::two_legs();
  robot.legs[1].plan = "late";
  Plan plan = test::walk(robot);
  plan.others = {{"late", {"propulsion", "swing", "foot_plant"}}};
  EXPECT_TRUE(contradictions(robot, plan).empty());
  Legs legs(robot, plan);
  legs.update(at_rest(robot), 0);
  EXPECT_EQ(phase_of(legs, 0), "swing");
  EXPECT_EQ(phase_of(legs, 1), "propulsion");

  robot.legs[1].plan = "later";
  plan.others[0].phases[0] = "push";
  const auto wrong = contradictions(robot, plan);
  ASSERT_EQ(wrong.size(), 2u);
  EXPECT_EQ(wrong[0].key + wrong[0].found, "plan.late.phases\"push\"");
  EXPECT_EQ(wrong[1].key + wrong[1].found, "leg.right.plan\"later\"");
}

// A mistake in several legs is reported once.
TEST(Legs, ContradictionsAreReportedOnce) {
  const robot::Robot robot = antiphase();
  Plan plan = test::walk(robot);
  plan.phases[0].until.measure = "joint.ankle.angle";
  EXPECT_EQ(contradictions(robot, plan).size(), 1u);
  plan = test::walk(robot);
  plan.phases[2].x.to = -20 * test::inch;
  EXPECT_EQ(unreachable(robot, plan).size(), 1u);
}

}  // namespace
}  // namespace sinew::gait::legs_test
