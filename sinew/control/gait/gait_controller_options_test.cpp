// Tests ranges, the force that sets the height, the cylinder, and machines other than the leg.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/path.h"
#include "sinew/control/gait/test_walk.h"

namespace sinew::gait::gait_controller_options_test {
namespace {

using test::degree;
using test::inch;

constexpr double turn = 2 * std::numbers::pi;
const robot::TwoLinks links{8.875 * inch, 6.25 * inch};

// Returns the angle from the range's first end in increasing direction [rad].
double up_from(double first, double angle) { return robot::normalised(angle - first); }

TEST(Within, AnAngleInsideStaysAndOneOutsideGoesToTheNearerEnd) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, turn), width(0.1, 5);
  for (int i = 0; i < 2000; ++i) {
    const double first = any(random), last = first + width(random), angle = any(random);
    const double kept = within({first, last}, angle);
    if (up_from(first, angle) <= last - first) {
      ASSERT_EQ(kept, angle);
      continue;
    }
    // Distance on the circle in the shorter direction.
    const auto apart = [&](double a) { return std::abs(std::remainder(angle - a, turn)); };
    ASSERT_NEAR(apart(kept), std::min(apart(first), apart(last)), 1e-12);
    ASSERT_LE(std::min(up_from(first, kept), turn - up_from(first, kept)), last - first + 1e-12);
  }
  EXPECT_EQ(within({}, 4), 4);
}

TEST(GaitController, DesiredAnglesKeepToTheirRange) {
  const robot::Robot robot = robot::test::leg();
  Plan free = test::walk(robot), kept = free;
  kept.joints[0].range = {260 * degree, 290 * degree};
  kept.joints[1].range = {300 * degree, 330 * degree};
  GaitController any(robot, free), controller(robot, kept);
  bool lower = false, inside = false;
  for (std::int64_t p = 0; p < 303; ++p) {
    any.update({}, p);
    controller.update({}, p);
    for (std::size_t j = 0; j < 2; ++j) {
      const double range[] = {kept.joints[j].range[0], kept.joints[j].range[1]};
      const double asked = any.desired().joint[j].angle, got = controller.desired().joint[j].angle;
      ASSERT_NEAR(got, std::clamp(asked, range[0], range[1]), 1e-15);
      lower = lower || got < asked - degree || got > asked + degree;
      inside = inside || got == asked;
    }
  }
  EXPECT_TRUE(lower);
  EXPECT_TRUE(inside);
}

TEST(GroundForce, IsProportionalAndBounded) {
  const GroundForce g{.desired = 20, .gain = 1e-3, .limit = 0.01};
  EXPECT_EQ(correction(g, 20), 0);
  EXPECT_DOUBLE_EQ(correction(g, 24), 0.004);   // too much load lifts the path
  EXPECT_DOUBLE_EQ(correction(g, 15), -0.005);  // too little lowers it
  EXPECT_DOUBLE_EQ(correction(g, 1000), 0.01);  // bounded
  EXPECT_DOUBLE_EQ(correction(g, -1000), -0.01);
  EXPECT_EQ(correction(g, std::nan("")), 0);  // no reading, no correction
}

// Returns tensions for which [75] gives that normal force, for a standing leg.
Measured standing(const robot::Robot& robot, double normal) {
  Measured m;
  const robot::Inverse inv = robot::inverse(links, {1 * inch, -13 * inch});
  const robot::Jacobian j = robot::jacobian(links, inv.angle[0], inv.angle[1]);
  const std::array torque{-j.y1 * normal, -j.y2 * normal};
  for (std::size_t i = 0; i < 2; ++i) {
    m.angle[i] = inv.angle[i];
    m.tension[2 * i] = 100 + torque[i] / (robot.joints[i].sign() * robot.joints[i].moment_arm);
    m.tension[2 * i + 1] = 100;
  }
  return m;
}

TEST(GaitController, TheMeasuredForceMovesThePathOfItsPhaseAlone) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[2].ground_force = {.desired = 20, .gain = 1e-3, .limit = 0.02};
  GaitController controller(robot, plan);
  const Measured light = standing(robot, 12);
  controller.update(light, 100);
  EXPECT_DOUBLE_EQ(controller.desired().foot.y, foot_at(plan.phases[0], 100.0 / 150).y);
  controller.update(light, 200);
  EXPECT_NEAR(controller.desired().foot.y, -13.5 * inch - 0.008, 1e-12);
  const robot::Point aim = robot::foot_position(links, controller.desired().joint[0].angle,
                                                controller.desired().joint[1].angle);
  EXPECT_NEAR(aim.y, controller.desired().foot.y, 1e-12);
}

// In comments of B.1: thetades[0] = 400 + 800 (y + 13.5), in counts and inches.
TEST(GaitController, TheCylinderFollowsTheFootsHeight) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[0].cylinder = {
      .position = {}, .polynomial = {13.5 * inch, 1}, .of = CylinderPhase::Of::foot_y};
  GaitController controller(robot, plan);
  for (std::int64_t p = 0; p < 150; ++p) {
    controller.update({}, p);
    ASSERT_TRUE(controller.desired().cylinder.given);
    const double counts = 400 + 800 * (controller.desired().foot.y / inch + 13.5);
    ASSERT_NEAR(400 + 800 * controller.desired().cylinder.position / inch, counts, 1e-9);
  }
  // The next phases have no position: it stays at that of s = 1, y = -13.2503 in.
  const double left = foot_at(plan.phases[0], 1).y + 13.5 * inch;
  controller.update({}, 200);
  EXPECT_NEAR(controller.desired().cylinder.position, left, 1e-15);
}

TEST(GaitController, TheCylinderGoesThroughAProfile) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[2].cylinder.position = {0, 0.05};
  GaitController controller(robot, plan);
  EXPECT_FALSE(controller.update({}, 100).cylinder.given);
  EXPECT_NEAR(controller.update({}, 153 + 75).cylinder.position, 0.025, 1e-15);
}

// Open loop lasts as long as its phase; inlet and exhaust of a chamber may be open together.
TEST(GaitController, TheCylinderOpenLoop) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  plan.phases[0].cylinder.feedforward = {.flexor_inlet = {0.2, 0.6}, .flexor_exhaust = {0.5}};
  GaitController controller(robot, plan);
  const DesiredCylinder& c = controller.update({}, 75).cylinder;
  EXPECT_TRUE(c.open_loop);
  EXPECT_FALSE(c.given);
  EXPECT_NEAR(c.up_inlet, 0.4, 1e-15);
  EXPECT_EQ(c.up_exhaust, 0.5);
  EXPECT_EQ(c.down_inlet + c.down_exhaust, 0);
  EXPECT_FALSE(controller.update({}, 150).cylinder.open_loop);
}

// An ankle without muscles after the knee, a muscle over hip and knee, a knee without extensor.
robot::Robot odd_machine() {
  robot::Robot robot = robot::test::leg();
  robot.links.push_back({"sole", 2 * inch, 0.05, 1 * inch, 1e-5});
  robot::Joint ankle;
  ankle.name = "ankle";
  ankle.kind = robot::Joint::Kind::passive;
  ankle.rest_angle = 90 * degree;
  robot.joints.push_back(ankle);
  robot.muscles.pop_back();
  robot.muscles[0].second = {.joint = "knee", .role = robot::Muscle::Role::extensor, .cam = {}};
  robot.muscles[0].second.cam.radius = 0.5 * inch;
  return robot;
}

TEST(GaitController, APassiveJointIsLeftAlone) {
  const robot::Robot robot = odd_machine();
  Plan plan = test::walk(robot);
  for (Phase& phase : plan.phases) phase.joints.clear();
  ASSERT_TRUE(contradictions(robot, plan).empty());
  GaitController controller(robot, plan), leg(robot::test::leg(), test::walk(robot::test::leg()));
  for (std::int64_t p = 0; p < 303; ++p) {
    const Desired& want = controller.update({}, p);
    leg.update({}, p);
    for (std::size_t j = 0; j < 2; ++j)
      ASSERT_EQ(want.joint[j].angle, leg.desired().joint[j].angle);
    ASSERT_TRUE(want.joint[0].enabled);
    ASSERT_FALSE(want.joint[2].enabled);
    ASSERT_EQ(want.joint[2].angle, 90 * degree);
  }
}

// Virtual work: the work of the tensions over a small turn equals that of the force on the foot.
TEST(GaitController, GroundReactionOfAnyMuscles) {
  const robot::Robot robot = odd_machine();
  const GaitController controller(robot, test::walk(robot));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> pull(0, 150), bend(0.3, 2.5), any(0, turn);
  for (int i = 0; i < 200; ++i) {
    Measured m;
    m.angle = {any(random), turn - bend(random), 0};
    for (double& t : m.tension) t = pull(random);
    const robot::Point force = controller.ground_reaction(m);
    const double arm = inch;
    const std::array torque{arm * (m.tension[0] - m.tension[1]),
                            -arm * m.tension[2] + 0.5 * inch * m.tension[0]};
    const robot::Jacobian j = robot::jacobian(links, m.angle[0], m.angle[1]);
    ASSERT_NEAR(torque[0] + j.x1 * force.x + j.y1 * force.y, 0, 1e-10);
    ASSERT_NEAR(torque[1] + j.x2 * force.x + j.y2 * force.y, 0, 1e-10);
  }
}

std::vector<std::string> keys_of(const robot::Robot& robot, const Plan& plan) {
  std::vector<std::string> keys;
  for (const auto& c : contradictions(robot, plan)) keys.push_back(c.key);
  return keys;
}

TEST(Contradictions, OfTheNewOptions) {
  using Keys = std::vector<std::string>;
  robot::Robot robot = robot::test::leg();
  const auto after = [&](const std::function<void(Plan&)>& damage) {
    Plan plan = test::walk(robot);
    damage(plan);
    return keys_of(robot, plan);
  };
  EXPECT_EQ(after([](Plan& p) { p.joints[1].range = {5}; }), Keys{"control.joint_range.knee"});
  EXPECT_EQ(after([](Plan& p) { p.joints[1].range = {5, 4}; }), Keys{"control.joint_range.knee"});
  EXPECT_EQ(after([](Plan& p) { p.phases[2].ground_force.gain = 1; }),
            Keys{"phase.propulsion.ground_force.limit"});

  const auto follow = [](Plan& p) { p.phases[0].cylinder.position = {0.01}; };
  EXPECT_EQ(after(follow), Keys{"phase.swing.cylinder"});  // a locked body
  robot.cylinder.present = true;
  robot.cylinder.mode = robot::Cylinder::Mode::valves;
  EXPECT_EQ(after(follow), Keys{});
  EXPECT_EQ(after([](Plan& p) {
              p.phases[0].cylinder = {{0.01}, {0.01}, CylinderPhase::Of::s};
            }),
            Keys{"phase.swing.cylinder"});
  EXPECT_EQ(after([](Plan& p) {
              p.phases[0].cylinder.position = {0.01};
              p.phases[0].cylinder.feedforward.flexor_inlet = {0.5};
            }),
            Keys{"phase.swing.cylinder"});
}

}  // namespace
}  // namespace sinew::gait::gait_controller_options_test
