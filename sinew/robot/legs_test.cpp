#include "sinew/robot/legs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "sinew/robot/kinematics.h"
#include "sinew/robot/test_leg.h"

namespace sinew::robot::legs_test {
namespace {

using test::inch;

template <class Parts>
std::vector<std::string> names_of(const Parts& parts) {
  std::vector<std::string> out;
  for (const auto& part : parts) out.push_back(part.name);
  return out;
}

// Returns the contradictions, "key: found", after `damage` is done to two valid legs.
std::string first_after(const std::function<void(Robot&)>& damage) {
  Robot robot = test::two_legs();
  damage(robot);
  const auto all = contradictions(robot);
  return all.empty() ? "" : all[0].key + ": " + all[0].found;
}

TEST(Legs, ARobotWithoutLegsIsOne) {
  const Robot robot = test::leg();
  const auto legs = legs_of(robot);
  ASSERT_EQ(legs.size(), 1u);
  EXPECT_EQ(legs[0].name, "");
  EXPECT_EQ(legs[0].joints, (std::vector<int>{0, 1}));
  EXPECT_EQ(legs[0].muscles, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(names_of(only_leg(robot, 0).joints), names_of(robot.joints));
  EXPECT_EQ(topic_of_joint(robot, 1), "/joint/knee");
  EXPECT_EQ(topic_of_valves(robot, 2), "/valve/knee_flexor");
  EXPECT_EQ(foot_link(robot, 0), 1);
}

// Each single leg equals the leg that it was made from.
TEST(Legs, EachAloneIsTheLeg) {
  const Robot one = test::leg(), two = test::two_legs();
  ASSERT_TRUE(contradictions(two).empty());
  for (std::size_t l = 0; l < 2; ++l) {
    const Robot alone = only_leg(two, l);
    EXPECT_EQ(names_of(alone.links), names_of(one.links));
    EXPECT_EQ(names_of(alone.joints), names_of(one.joints));
    EXPECT_EQ(names_of(alone.muscles), names_of(one.muscles));
    ASSERT_EQ(alone.sensors.size(), one.sensors.size());
    for (std::size_t s = 0; s < one.sensors.size(); ++s)
      EXPECT_EQ(alone.sensors[s].of, one.sensors[s].of);
    EXPECT_TRUE(is_leg(alone));
    EXPECT_EQ(two_links(alone).l1, one.links[0].length);
    EXPECT_EQ(foot_link(two, l), static_cast<int>(2 * l + 1));
  }
  EXPECT_FALSE(is_leg(two));
  EXPECT_FALSE(is_chain(two));
  EXPECT_NEAR(leg_mass(two), 2 * leg_mass(one), 1e-15);
  EXPECT_NEAR(trolley_own_mass(two), trolley_own_mass(one), 1e-12);
}

TEST(Legs, TopicsOfALegAndBack) {
  const Robot two = test::two_legs();
  EXPECT_EQ(topic_of_joint(two, 3), "/leg/right/joint/knee");
  EXPECT_EQ(topic_of_muscle(two, 0), "/leg/left/muscle/hip_flexor");
  EXPECT_EQ(logged_topic(two, "/desired/joint/left_hip/angle"),
            "/desired/leg/left/joint/hip/angle");
  EXPECT_EQ(logged_topic(two, "/valve/right_knee_flexor/inlet/open"),
            "/leg/right/valve/knee_flexor/inlet/open");
  EXPECT_EQ(logged_topic(two, "/valve/cylinder_up/inlet/open"), "/valve/cylinder_up/inlet/open");
  EXPECT_EQ(logged_topic(test::leg(), "/joint/hip/angle"), "/joint/hip/angle");
  EXPECT_EQ(topic_of_leg("left", "/true/foot/force"), "/true/leg/left/foot/force");
  EXPECT_EQ(topic_of_leg("left", "/trueish/foot"), "/leg/left/trueish/foot");
  for (const std::string topic : {"/joint/hip/angle", "/true/foot/force", "/desired/foot/position"})
    EXPECT_EQ(topic_in_leg("left", topic_of_leg("left", topic)), topic);
  EXPECT_EQ(topic_in_leg("left", "/leg/right/joint/hip/angle"), "");
  EXPECT_EQ(topic_in_leg("left", "/leg/lefty/joint/hip/angle"), "");
  EXPECT_EQ(topic_in_leg("left", "/sensor/left_hip_angle/count"), "/sensor/left_hip_angle/count");
}

TEST(Legs, WhatCannotBe) {
  EXPECT_EQ(first_after([](Robot&) {}), "");
  EXPECT_EQ(first_after([](Robot& r) { r.links[2].parent = "right_tibia"; }),
            "link.right_femur.parent: \"right_tibia\"");
  EXPECT_EQ(first_after([](Robot& r) { r.links[2].parent = "left_tibia"; }),
            "link.right_femur.parent: \"left_tibia\"");
  EXPECT_EQ(first_after([](Robot& r) { r.legs[1].joints.pop_back(); }),
            "joint.right_knee: in no leg");
  EXPECT_EQ(first_after([](Robot& r) { r.legs[1].joints = r.legs[0].joints; }),
            "leg.right.joints: \"left_hip\"");
  EXPECT_EQ(first_after([](Robot& r) { r.legs[0].joints[1] = "ankle"; }),
            "leg.left.joints: \"ankle\"");
  EXPECT_EQ(first_after([](Robot& r) { r.muscles[0].name = "hip_flexor"; }).substr(0, 30),
            "muscle.hip_flexor: \"hip_flexor");
  EXPECT_EQ(first_after([](Robot& r) { r.joints[3].gains.angle *= 2; }),
            "joint.right_knee: another kind, switch or gain");
  EXPECT_EQ(first_after([](Robot& r) { r.foot.points.resize(5); }).substr(0, 10), "foot.point");
}

// A passive trunk belongs to no leg; the legs may hang on it, and their parts are as before.
TEST(Legs, MayHangOnATrunk) {
  Robot robot = test::two_legs();
  Link trunk = robot.links[0];
  trunk.name = "trunk";
  robot.links.insert(robot.links.begin(), trunk);
  Joint joint;
  joint.name = "trunk";
  joint.kind = Joint::Kind::passive;
  robot.joints.insert(robot.joints.begin(), joint);
  robot.links[1].parent = robot.links[3].parent = "trunk";
  EXPECT_TRUE(contradictions(robot).empty());
  EXPECT_EQ(leg_of_joint(robot, 0), -1);
  EXPECT_EQ(topic_of_joint(robot, 0), "/joint/trunk");
  EXPECT_EQ(legs_of(robot)[1].joints, (std::vector<int>{3, 4}));
  EXPECT_EQ(names_of(only_leg(robot, 1).joints), names_of(test::leg().joints));
  robot.joints[0].kind = Joint::Kind::driven;
  EXPECT_FALSE(contradictions(robot).empty());
}

// A chain of twelve joints is not a set of legs, which would be rejected, too; a tree of twelve is.
TEST(Legs, AdviceForALargeLegFitsItsShape) {
  Robot robot = test::leg();
  robot.muscles.clear();
  robot.sensors.clear();
  while (robot.links.size() < 12) {
    robot.links.push_back(robot.links[1]);
    robot.joints.push_back(robot.joints[1]);
    robot.links.back().name = robot.joints.back().name =
        "more" + std::to_string(robot.links.size());
  }
  const auto advice = [&] {
    for (const Contradiction& c : contradictions(robot))
      if (c.found == "12 joints in one leg") return c.try_this;
    return std::string();
  };
  EXPECT_EQ(advice(), "fewer of them: links that hardly move as one link");
  robot.links[6].parent = "body";
  EXPECT_EQ(advice(), "several legs, [leg.<name>] with joints = [...]");
}

// Positions by parents equal those of the chain for a serial robot, and those of each leg for a
// tree.
TEST(Kinematics, PlacesOfATreeAreThoseOfItsLegs) {
  Robot two = test::two_legs();
  two.links[2].at = 4 * inch;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int trial = 0; trial < 50; ++trial) {
    const std::array<double, 4> angles{any(random), any(random), any(random), any(random)};
    const auto all = places(two, angles);
    ASSERT_EQ(all.size(), 4u);
    for (std::size_t l = 0; l < 2; ++l) {
      const Pose pose = forward(only_leg(two, l), std::span(angles).subspan(2 * l, 2));
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(all[2 * l + k].joint.x, pose.joint[k].x + (l == 1 ? 4 * inch : 0), 1e-15);
        EXPECT_NEAR(all[2 * l + k].joint.y, pose.joint[k].y, 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace sinew::robot::legs_test
