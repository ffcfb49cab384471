// Tests values that override the plan's, and lists that are refused.
#include "sinew/control/gait/change.h"

#include <gtest/gtest.h>

#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/test_walk.h"

namespace sinew::gait::change_test {
namespace {

robot::Robot leg() { return robot::test::leg(); }

TEST(Setting, ThereAreFiveForEachDrivenJoint) {
  robot::Robot robot = leg();
  EXPECT_EQ(settings(plan_for(robot)).size(), 10u);
  robot.joints[1].kind = robot::Joint::Kind::passive;
  EXPECT_EQ(settings(plan_for(robot)).size(), 5u);
}

TEST(Setting, ItsKeyFindsItAndGivesItsUnit) {
  const std::vector<Setting> all = settings(plan_for(leg()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(find_setting(all, all[i].key), static_cast<int>(i));
    EXPECT_EQ(unit_of_setting(all[i].key), all[i].unit);
    EXPECT_FALSE(all[i].unit.empty());
  }
  EXPECT_EQ(find_setting(all, "control.gains.elbow.angle"), -1);
  for (const char* key : {"", "control.gains.", "control.gains..angle", "control.gains.hip",
                          "control.stiffness.", "control.angle.", "gains.hip.angle"})
    EXPECT_EQ(unit_of_setting(key), "") << key;
}

TEST(Setting, EachIsAnotherPlaceOfWhatIsDesired) {
  const std::vector<Setting> all = settings(plan_for(leg()));
  Desired desired;
  for (std::size_t i = 0; i < all.size(); ++i) value_of(all[i], desired) = 1.0 + double(i);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(value_of(all[i], static_cast<const Desired&>(desired)), 1.0 + double(i));
}

TEST(Overrides, AValueHoldsUntilItsReleaseWhateverThePlanHas) {
  Overrides overrides(plan_for(leg()));
  const auto hip =
      static_cast<std::size_t>(find_setting(overrides.settings(), "control.gains.hip.angle"));
  Desired desired;
  const auto now = [&](double plan) {
    desired.joint[0].gains.angle = plan;
    desired.joint[0].gains.velocity = plan;
    overrides.apply(desired);
    EXPECT_EQ(desired.joint[0].gains.velocity, plan) << "of which nobody spoke";
    return desired.joint[0].gains.angle;
  };
  EXPECT_EQ(now(0.3), 0.3);
  overrides.set(hip, 0.7);
  EXPECT_EQ(now(0.3), 0.7);
  EXPECT_EQ(now(0.4), 0.7);
  overrides.set(hip, 0);
  EXPECT_EQ(now(0.4), 0);
  overrides.release(hip);
  EXPECT_EQ(now(0.5), 0.5);
}

std::string complaint(Change change) {
  const robot::Robot robot = leg();
  Plan plan = test::walk(robot);
  plan.changes = {std::move(change)};
  const auto wrong = contradictions(robot, plan);
  return wrong.empty() ? "" : wrong[0].key + ": " + wrong[0].found + "; " + wrong[0].expected;
}

TEST(Changes, AreOfADrivenJointWithAValueOrARelease) {
  const std::string key = "control.stiffness.knee";
  EXPECT_EQ(complaint({.time = 1, .key = key, .value = 2}), "");
  EXPECT_EQ(complaint({.time = 1, .key = key, .release = true}), "");
  EXPECT_EQ(complaint({.time = 1, .key = key}), "change[0]: no value; value, or release = true");
  EXPECT_EQ(complaint({.time = 1, .key = key, .value = 2, .release = true}),
            "change[0]: a value and a release; one of them");
  EXPECT_EQ(complaint({.time = 1, .key = "control.stiffness.elbow", .value = 2}),
            "change[0].key: \"control.stiffness.elbow\"; the key of a driven joint");
  EXPECT_EQ(complaint({.time = 1, .key = key, .value = 2, .leg = "left"}),
            "change[0].leg: \"left\"; no leg, as the robot has one alone");
}

}  // namespace
}  // namespace sinew::gait::change_test
