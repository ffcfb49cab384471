#include "sinew/robot/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sinew/robot/test_leg.h"

namespace sinew::robot::kinematics_test {
namespace {

using test::degree;
using test::inch;

constexpr double pi = std::numbers::pi;
constexpr TwoLinks leg{8.875 * inch, 6.25 * inch};

// Returns the smallest turn between two angles [rad].
double apart(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

struct Target {
  Point point;
  double theta1, theta2;
};

// A seeded target in reach, and the angles that it was made from.
class Targets {
 public:
  explicit Targets(unsigned seed) : random_(seed) {}

  Target next(double away_from_straight = 0) {
    std::uniform_real_distribution<double> any(0, 2 * pi), part(away_from_straight, 1);
    const double theta1 = any(random_);
    const double bend = part(random_) * (pi - away_from_straight);
    const double theta2 = side_ ? bend : 2 * pi - bend;
    side_ = !side_;
    return {foot_position(leg, theta1, theta2), theta1, theta2};
  }

 private:
  std::mt19937 random_;
  bool side_ = false;
};

TEST(Kinematics, InverseThenForwardIsTheTarget) {
  Targets targets(1);
  for (int i = 0; i < 10000; ++i) {
    const Point p = targets.next().point;
    for (const Knee knee : {Knee::above_pi, Knee::below_pi}) {
      const Inverse inv = inverse(leg, p, knee);
      ASSERT_TRUE(inv.reached());
      const Point back = foot_position(leg, inv.angle[0], inv.angle[1]);
      ASSERT_NEAR(back.x, p.x, 2e-15);
      ASSERT_NEAR(back.y, p.y, 2e-15);
      for (const double angle : inv.angle) {
        ASSERT_GE(angle, 0);
        ASSERT_LT(angle, 2 * pi);
      }
    }
  }
}

TEST(Kinematics, ForwardThenInverseIsThePose) {
  Targets targets(2);
  for (int i = 0; i < 10000; ++i) {
    const Target t = targets.next(0.01);
    const Knee knee = t.theta2 > pi ? Knee::above_pi : Knee::below_pi;
    const Inverse inv = inverse(leg, t.point, knee);
    ASSERT_LT(apart(inv.angle[0], t.theta1), 1e-12);
    ASSERT_LT(apart(inv.angle[1], t.theta2), 1e-12);
  }
}

TEST(Kinematics, BranchesMirrorEachOther) {
  Targets targets(3);
  for (int i = 0; i < 1000; ++i) {
    const Point p = targets.next(0.001).point;
    const Inverse up = inverse(leg, p, Knee::above_pi), down = inverse(leg, p, Knee::below_pi);
    EXPECT_LT(apart(up.angle[1] + down.angle[1], 0), 1e-12);
    EXPECT_LT(apart(up.angle[0] + down.angle[0], 2 * std::atan2(p.y, p.x)), 1e-12);
  }
}

TEST(Kinematics, PrintedFormIsTheBetterForm) {
  Targets targets(4);
  for (int i = 0; i < 10000; ++i) {
    const Point p = targets.next(0.05).point;
    const auto printed = inverse_as_printed(leg, p);
    const Inverse better = inverse(leg, p, Knee::above_pi);
    // acos loses half the digits where its argument nears 1: x near 0.
    ASSERT_LT(apart(printed[0], better.angle[0]), 1e-7);
    ASSERT_LT(apart(printed[1], better.angle[1]), 1e-12);
  }
}

TEST(Kinematics, PrintedFormHasNoAnswerOutOfReach) {
  EXPECT_TRUE(std::isnan(inverse_as_printed(leg, {0, -16 * inch})[1]));
}

TEST(Kinematics, BeyondTheReachIsReportedWithTheNearestPoint) {
  const Inverse far = inverse(leg, {3 * inch, -16 * inch});
  EXPECT_EQ(far.status, Inverse::Status::too_far);
  EXPECT_NEAR(far.longest, 15.125 * inch, 1e-15);
  EXPECT_NEAR(far.distance, std::hypot(3, 16) * inch, 1e-15);
  EXPECT_NEAR(std::hypot(far.nearest.x, far.nearest.y), far.longest, 1e-15);
  EXPECT_NEAR(far.nearest.x / far.nearest.y, 3.0 / -16.0, 1e-15);
  EXPECT_LT(apart(far.angle[1], 0), 1e-7);

  const Inverse near = inverse(leg, {0, -1 * inch});
  EXPECT_EQ(near.status, Inverse::Status::too_near);
  EXPECT_NEAR(near.shortest, 2.625 * inch, 1e-15);
  const Point foot = foot_position(leg, near.angle[0], near.angle[1]);
  EXPECT_NEAR(foot.y, -near.shortest, 1e-15);
}

TEST(Kinematics, NearestPointIsNearerThanAnyOther) {
  const Point target{10 * inch, -20 * inch};
  const Inverse inv = inverse(leg, target);
  const double beyond = std::hypot(target.x - inv.nearest.x, target.y - inv.nearest.y);
  Targets targets(5);
  for (int i = 0; i < 1000; ++i) {
    const Point other = targets.next().point;
    EXPECT_GE(std::hypot(target.x - other.x, target.y - other.y), beyond);
  }
}

TEST(Kinematics, TheHipItselfAndWhatIsNoNumber) {
  const Inverse hip = inverse(leg, {0, 0});
  EXPECT_EQ(hip.status, Inverse::Status::too_near);
  EXPECT_NEAR(hip.nearest.y, -hip.shortest, 1e-15);

  for (const Point bad : {Point{NAN, 0}, Point{0, NAN}, Point{INFINITY, 0}}) {
    const Inverse inv = inverse(leg, bad);
    EXPECT_EQ(inv.status, Inverse::Status::not_a_number);
    EXPECT_TRUE(std::isfinite(inv.angle[0]) && std::isfinite(inv.angle[1]));
  }

  // Equal links fold onto the hip.
  const Inverse folded = inverse({1, 1}, {0, 0});
  EXPECT_TRUE(folded.reached());
  EXPECT_NEAR(folded.angle[1], pi, 1e-15);
}

TEST(Kinematics, EdgesOfTheReachAreInReach) {
  for (int i = 0; i < 360; ++i) {
    const double a = i * degree;
    for (const double d : {leg.l1 + leg.l2, leg.l1 - leg.l2})
      EXPECT_TRUE(inverse(leg, {d * std::cos(a), d * std::sin(a)}).reached());
  }
}

TEST(Kinematics, ChainOfTwoIsTheClosedForm) {
  const std::array lengths{leg.l1, leg.l2};
  Targets targets(6);
  for (int i = 0; i < 100; ++i) {
    const Target t = targets.next();
    const std::array angles{t.theta1, t.theta2};
    const Pose pose = forward(lengths, angles);
    EXPECT_EQ(pose.links, 2);
    EXPECT_NEAR(pose.joint[1].x, leg.l1 * std::cos(t.theta1), 1e-16);
    EXPECT_NEAR(pose.foot().x, t.point.x, 1e-15);
    EXPECT_NEAR(pose.foot().y, t.point.y, 1e-15);
  }
}

TEST(Kinematics, FourLinksRoundASquare) {
  const std::array<double, 4> sides{1, 1, 1, 1};
  const std::array<double, 4> turns{0, pi / 2, pi / 2, pi / 2};
  const Pose pose = forward(sides, turns);
  EXPECT_NEAR(pose.joint[2].x, 1, 1e-15);
  EXPECT_NEAR(pose.joint[2].y, 1, 1e-15);
  EXPECT_NEAR(pose.foot().x, 0, 1e-15);
  EXPECT_NEAR(pose.foot().y, 0, 1e-15);
}

TEST(Jacobian, IsTheDerivativeOfTheFoot) {
  constexpr double h = 1e-6;
  Targets targets(7);
  for (int i = 0; i < 1000; ++i) {
    const Target t = targets.next();
    const Jacobian j = jacobian(leg, t.theta1, t.theta2);
    const Point a = foot_position(leg, t.theta1 + h, t.theta2);
    const Point b = foot_position(leg, t.theta1 - h, t.theta2);
    const Point c = foot_position(leg, t.theta1, t.theta2 + h);
    const Point d = foot_position(leg, t.theta1, t.theta2 - h);
    ASSERT_NEAR(j.x1, (a.x - b.x) / (2 * h), 1e-9);
    ASSERT_NEAR(j.y1, (a.y - b.y) / (2 * h), 1e-9);
    ASSERT_NEAR(j.x2, (c.x - d.x) / (2 * h), 1e-9);
    ASSERT_NEAR(j.y2, (c.y - d.y) / (2 * h), 1e-9);
    ASSERT_NEAR(j.determinant(), leg.l1 * leg.l2 * std::sin(t.theta2), 1e-16);
  }
}

// The leg at rest: the work of the muscles in a small turn equals that of the ground, T dtheta + F
// dx = 0.
TEST(GroundReaction, VirtualWorkVanishes) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> newton_metres(-5, 5);
  Targets targets(9);
  for (int i = 0; i < 1000; ++i) {
    const Target t = targets.next(0.05);
    const std::array torque{newton_metres(random), newton_metres(random)};
    const GroundReaction ground = ground_reaction(leg, t.theta1, t.theta2, torque);
    ASSERT_FALSE(ground.singular);
    const Jacobian j = jacobian(leg, t.theta1, t.theta2);
    ASSERT_NEAR(torque[0] + j.x1 * ground.force.x + j.y1 * ground.force.y, 0, 1e-12);
    ASSERT_NEAR(torque[1] + j.x2 * ground.force.x + j.y2 * ground.force.y, 0, 1e-12);
  }
}

// [71]: T = J^T F, and the ground's reaction to those torques is -F.
TEST(FootForce, TorquesAreTheJacobiansAndTheGroundAnswersThem) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> newtons(-100, 100);
  Targets targets(11);
  for (int i = 0; i < 1000; ++i) {
    const Target t = targets.next(0.05);
    const Point force{newtons(random), newtons(random)};
    const std::array lengths{leg.l1, leg.l2}, angles{t.theta1, t.theta2};
    const auto torque = torques_for(forward(lengths, angles), force);
    const Jacobian j = jacobian(leg, t.theta1, t.theta2);
    ASSERT_NEAR(torque[0], j.x1 * force.x + j.y1 * force.y, 1e-12);
    ASSERT_NEAR(torque[1], j.x2 * force.x + j.y2 * force.y, 1e-12);
    EXPECT_EQ(torque[2], 0);
    const GroundReaction ground = ground_reaction(leg, t.theta1, t.theta2, {torque[0], torque[1]});
    ASSERT_NEAR(ground.force.x, -force.x, 1e-9);
    ASSERT_NEAR(ground.force.y, -force.y, 1e-9);
  }
}

// A chain along x holds a weight at its end by force times distance, joint by joint.
TEST(FootForce, OfAStraightChainIsForceTimesDistance) {
  const std::array lengths{0.4, 0.3, 0.2, 0.1}, angles{0.0, 0.0, 0.0, 0.0};
  const auto torque = torques_for(forward(lengths, angles), {7, -10});
  const std::array expected{-10.0, -6.0, -3.0, -1.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(torque[i], expected[i], 1e-12) << i;
}

// A hip that pulls the leg back pushes the trolley forward: the ground's force points forward.
TEST(GroundReaction, ExtendingHipIsPushedForward) {
  const Inverse inv = inverse(leg, {0, -13 * inch});
  const GroundReaction ground = ground_reaction(leg, inv.angle[0], inv.angle[1], {-2, 0});
  EXPECT_GT(ground.force.x, 0);
  const Joint hip{.name = "hip", .moment_arm = 0.0254};
  EXPECT_LT(torque(hip, 10, 20), 0);
}

TEST(GroundReaction, ReportsWhatIsUnknown) {
  EXPECT_TRUE(ground_reaction(leg, 1, 0, {1, 1}).singular);
  EXPECT_TRUE(ground_reaction(leg, 1, pi, {1, 1}).singular);
  EXPECT_TRUE(ground_reaction(leg, NAN, NAN, {1, 1}).singular);
  EXPECT_EQ(ground_reaction(leg, 1, 0, {1, 1}).force.x, 0);
}

// A pair over round cams: the law for any muscles is the law of the pair, bit for bit.
TEST(Torque, OfAPairIsThatOfAnyMuscles) {
  const Robot robot = test::leg();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> pull(0, 200), any(0, 2 * pi);
  for (int i = 0; i < 200; ++i) {
    std::array<double, 4> tension{};
    for (double& t : tension) t = pull(random);
    for (int j = 0; j < 2; ++j) {
      const auto k = static_cast<std::size_t>(j);
      EXPECT_EQ(torque_of_muscles(robot, j, any(random), tension),
                torque(robot.joints[k], tension[2 * k], tension[2 * k + 1]));
    }
  }
}

TEST(Torque, ACamsLeverIsStraightBetweenItsPoints) {
  Robot robot = test::leg();
  robot.muscles[3].cam = {.radius = not_set, .angle = {4, 5, 6}, .radii = {0.02, 0.04, 0.03}};
  const Joint& knee = robot.joints[1];
  EXPECT_DOUBLE_EQ(cam_radius(robot.muscles[3].cam, knee, 3), 0.02);
  EXPECT_DOUBLE_EQ(cam_radius(robot.muscles[3].cam, knee, 4.25), 0.025);
  EXPECT_DOUBLE_EQ(cam_radius(robot.muscles[3].cam, knee, 5.5), 0.035);
  EXPECT_DOUBLE_EQ(cam_radius(robot.muscles[3].cam, knee, 7), 0.03);
  EXPECT_DOUBLE_EQ(moment_arm_at(robot.muscles[3], knee, 4.25),
                   0.025);  // the knee's extensor raises its angle
  EXPECT_EQ(moment_arm_at(robot.muscles[3], robot.joints[0], 4.25), 0);  // no effect at the hip
  const std::array<double, 4> tension{0, 0, 0, 100};
  EXPECT_DOUBLE_EQ(torque_of_muscles(robot, 1, 4.25, tension), 2.5);
}

TEST(IsLeg, TwoDrivenJointsAndBeyondThemPassiveOnes) {
  Robot robot = test::leg();
  EXPECT_TRUE(is_leg(robot));
  robot.links.push_back(robot.links[1]);
  robot.joints.push_back(robot.joints[1]);
  EXPECT_FALSE(is_leg(robot));
  robot.joints[2].kind = Joint::Kind::passive;
  EXPECT_TRUE(is_leg(robot));
  robot.joints[1].kind = Joint::Kind::passive;
  EXPECT_FALSE(is_leg(robot));
}

TEST(MuscleLength, FlexorShortensWhereTheJointFlexes) {
  const Robot robot = test::leg();
  const double mount = 3.15 * inch, by = 10 * degree;
  for (const Joint& joint : robot.joints) {
    const double flexed = joint.rest_angle + joint.sign() * by;
    EXPECT_NEAR(muscle_length(joint, Muscle::Role::flexor, mount, flexed), mount - inch * by,
                1e-15);
    EXPECT_NEAR(muscle_length(joint, Muscle::Role::extensor, mount, flexed), mount + inch * by,
                1e-15);
  }
}

TEST(MuscleLength, BelievedKneeIsExchangedByTheThesis) {
  Robot robot = test::leg();
  const int flexor = find_muscle(robot, "knee_flexor"),
            extensor = find_muscle(robot, "knee_extensor");
  const double angle = 300 * degree;
  const double right = assumed_muscle_length(robot, flexor, angle);
  robot.thesis.knee_lengths_swapped = true;
  EXPECT_NEAR(assumed_muscle_length(robot, extensor, angle), right, 1e-15);

  // The hip's lengths are correct with either setting.
  const int hip = find_muscle(robot, "hip_flexor");
  EXPECT_LT(assumed_muscle_length(robot, hip, 290 * degree), 3.15 * inch);
}

TEST(Normalised, IsWithinOneTurn) {
  EXPECT_NEAR(normalised(-0.1), 2 * pi - 0.1, 1e-15);
  EXPECT_EQ(normalised(-1e-17), 0);
  EXPECT_EQ(normalised(2 * pi), 0);
  EXPECT_NEAR(normalised(7 * pi), pi, 1e-14);
  EXPECT_TRUE(std::isnan(normalised(NAN)));
}

}  // namespace
}  // namespace sinew::robot::kinematics_test
