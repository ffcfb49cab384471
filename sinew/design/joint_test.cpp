#include "sinew/design/joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/tension.h"
#include "sinew/config/diagnostics.h"
#include "sinew/design/methods.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/units/constants.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::design {
namespace {

const std::string leg_file = test::source_dir() + "/robots/leg/actuator.toml";

actuator::Actuator leg_actuator() {
  return experiment::load_machine_file(leg_file).experiment.actuators.at(0);
}
constexpr double room = units::atmosphere, line = 100 * units::psi;

JointTask task_of(double torque, double angles, double motion, double pressure) {
  return {.torque = torque, .angles = angles, .motion = motion, .pressure = pressure};
}

// --- the thesis, 4.2 ---

TEST(DesignJoint, TheThesissStrokeAndArmGiveItsRangeOfMotion) {
  JointDesign joint{leg_actuator(), 2, 1 * units::inch, 3.15 * units::inch};
  const Stroke stroke = stroke_of(joint.actuator, line, room);
  // The text has "about 1.4 in" and "optimum length 3.15 in, half the range".
  EXPECT_NEAR((stroke.longest - stroke.shortest) / units::inch, 1.4, 0.1);
  EXPECT_NEAR(0.5 * (stroke.longest + stroke.shortest) / units::inch, 3.15, 0.05);
  EXPECT_NEAR(motion_of(joint, Arm::cam, stroke) / units::degree, 80, 5);
  // This is true by construction: 1.4 in at an arm of 1 in.
  EXPECT_NEAR(1.4 / 1 / units::degree, 80, 0.5);
}

TEST(DesignJoint, AnotherMountLengthGivesLessMotion) {
  JointDesign joint{leg_actuator(), 1, 1 * units::inch, 0};
  const Stroke stroke = stroke_of(joint.actuator, line, room);
  joint.mount_length = 0.5 * (stroke.longest + stroke.shortest);
  const double most = motion_of(joint, Arm::cam, stroke);
  for (const double off : {-0.3, -0.1, 0.1, 0.3}) {
    JointDesign other = joint;
    other.mount_length += off * units::inch;
    EXPECT_NEAR(motion_of(other, Arm::cam, stroke), most - 2 * std::abs(off), 1e-12);
  }
}

// --- laws ---

TEST(DesignJoint, TorqueIsThatOfTheForcesAtBothMuscles) {
  const JointDesign joint{leg_actuator(), 3, 0.02, 3.2 * units::inch};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-0.4, 0.4), gauge(0, 6e5);
  for (int i = 0; i < 100; ++i) {
    const double a = angle(random), p = gauge(random), q = gauge(random);
    const JointTask task = task_of(1, 0.5, 0.5, p);
    // Virtual work: without friction the torque is -dW/da of the lengths; the mean of
    // both directions has no friction while both muscles pull.
    const double up = torque_at(joint, task, a, p, q, room).value;
    const double down = torque_at(joint, task, -a, q, p, room).value;
    const auto force = [&](double length, double pressure) {
      return actuator::tension(joint.actuator, length, 0, pressure, room);
    };
    const double frictionless =
        3 * 0.02 *
        (force(joint.mount_length - 0.02 * a, p) - force(joint.mount_length + 0.02 * a, q));
    EXPECT_NEAR(0.5 * (up - down), frictionless, 0.02 * std::abs(frictionless) + 1e-3);
    EXPECT_LE(up, frictionless + 1e-9) << "friction only takes";
  }
}

TEST(DesignJoint, ALeverIsACamForSmallAngles) {
  const JointDesign joint{leg_actuator(), 1, 0.02, 3.2 * units::inch};
  JointTask cam = task_of(1, 0.5, 0.5, 5e5), lever = cam;
  lever.arm = Arm::lever;
  for (const double a : {1e-3, 1e-2, 0.1}) {
    const double one = torque_at(joint, cam, a, 5e5, 0, room).value;
    const double other = torque_at(joint, lever, a, 5e5, 0, room).value;
    EXPECT_NEAR(other, one, a * a * one);
  }
}

TEST(DesignJoint, TheCoContractionThatIsLeftUsesUpTheMargin) {
  JointTask task = task_of(0.5, 0.4, 0.8, 6e5);
  JointDesign joint{leg_actuator(), 1, 0.02, 0};
  joint.mount_length = best_mount_length(joint, task, stroke_of(joint.actuator, 6e5, room), room);
  task.torque = 0.6 * weakest_torque(joint, task, 0, room).torque.value;
  const double opposed = co_contraction_left(joint, task, room);
  EXPECT_GT(opposed, 0);
  EXPECT_NEAR(weakest_torque(joint, task, opposed, room).torque.value, task.torque,
              1e-6 * task.torque);
  task.torque *= 2;
  EXPECT_TRUE(std::isnan(co_contraction_left(joint, task, room)));
}

// The result of the leg's muscle; angles in degrees.
Result designed(double torque, double angles, double motion, const std::string& arm = "") {
  JointSettings s{.actuator = leg_file};
  s.torque = std::to_string(torque) + " N m";
  s.angles = std::to_string(angles) + " deg";
  s.motion = std::to_string(motion) + " deg";
  s.pressure = "100 psi gauge", s.moment_arm = arm, s.most = 20;
  return design(s);
}

TEST(DesignJoint, MoreTorqueNeverNeedsFewerMuscles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> torques(0.2, 8), angles(10, 60), more(1, 1.5);
  for (int i = 0; i < 20; ++i) {
    const double torque = torques(random), range = angles(random);
    const Result one = designed(torque, range, range);  // texts of six digits
    const Result other = designed(torque * more(random), range, range);
    if (!one.refused.empty()) {
      EXPECT_FALSE(other.refused.empty());
      continue;
    }
    EXPECT_GE(one.of("torque_Nm").number, torque * (1 - 1e-5));
    EXPECT_GE(one.of("motion_rad").number, range * units::degree * (1 - 1e-5));
    if (!other.refused.empty()) continue;
    EXPECT_GE(other.of("count").number, one.of("count").number);
  }
}

TEST(DesignJoint, EveryFeasibleDesignHasTheTorque) {
  const Result r = designed(2, 40, 60);
  const Table& table = r.tables.at(0);
  ASSERT_GT(table.rows.size(), 20U);
  for (const auto& row : table.rows) EXPECT_GE(std::get<double>(row[4]), -1e-9);
}

// "15 lbf, so they are doubled": a torque above one muscle's and up to that of two.
TEST(DesignJoint, AboveTheTorqueOfOneMuscleTwoAreNeeded) {
  const double one = designed(0.1, 1, 80, "1 in").of("torque_Nm").number;
  EXPECT_EQ(designed(0.99 * one, 1, 80, "1 in").of("count").number, 1);
  EXPECT_EQ(designed(1.01 * one, 1, 80, "1 in").of("count").number, 2);
  EXPECT_EQ(designed(1.99 * one, 1, 80, "1 in").of("count").number, 2);
}

// --- wrong inputs ---

std::string wrong(const std::function<void(JointSettings&)>& change) {
  JointSettings s{
      .actuator = leg_file, .torque = "1 N m", .angles = "40 deg", .pressure = "100 psi gauge"};
  change(s);
  return test::message([&] { (void)design(s); });
}

TEST(DesignJoint, SaysWhatIsWrong) {
  EXPECT_THAT(wrong([](auto& s) { s.torque = "2,5 N m"; }),
              testing::HasSubstr("torque: found \"2,5 N m\""));
  EXPECT_THAT(wrong([](auto& s) { s.torque = ""; }),
              testing::HasSubstr("a torque, or a load at a lever"));
  EXPECT_THAT(wrong([](auto& s) { s.load = "1 kg"; }), testing::HasSubstr("a load with it"));
  EXPECT_THAT(wrong([](auto& s) { s.time = "1 s"; }), testing::HasSubstr("time: found no load"));
  EXPECT_THAT(wrong([](auto& s) { s.rest_length = "90 mm"; }),
              testing::HasSubstr("prediction.rest_length"));
  const Result none = designed(500, 40, 60);
  EXPECT_THAT(none.refused, testing::HasSubstr("20 side by side reach"));
  EXPECT_THAT(designed(1, 40, 350, "1 in").refused,
              testing::HasSubstr("largest range of motion is"));
}

}  // namespace
}  // namespace sinew::design
