#include "sinew/robot/boards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "sinew/robot/test_leg.h"

namespace sinew::robot::boards_test {
namespace {

// Joints in a row, each with a pair, its angle and two tensions; ticks and channels of the board
// are not tested here.
Robot machine(std::size_t joints) {
  Robot robot;
  for (std::size_t j = 0; j < joints; ++j)
    test::add_joint(robot, "joint" + std::to_string(j), 1, Joint::Flexion::raises_angle);
  for (const Joint& joint : robot.joints) test::add_sensor(robot, Sensor::Kind::angle, joint.name);
  for (const Muscle& m : robot.muscles) test::add_sensor(robot, Sensor::Kind::tension, m.name);
  return robot;
}

// Ties two joints by a muscle over both.
void tie(Robot& robot, std::size_t a, std::size_t b) {
  Muscle m = robot.muscles[2 * a];
  m.name = "over" + std::to_string(a) + "and" + std::to_string(b);
  m.joint = robot.joints[a].name;
  m.second.joint = robot.joints[b].name;
  robot.muscles.push_back(m);
}

std::vector<Contradiction> wrong_with(const Robot& robot) {
  std::vector<Contradiction> out;
  check_boards(robot, out);
  return out;
}

std::string first_wrong(const Robot& robot) {
  const auto all = wrong_with(robot);
  return all.empty() ? "" : all[0].key + ": " + all[0].found + "; " + all[0].expected;
}

TEST(Boards, TheLegIsOnOneAndIsItself) {
  const Robot leg = test::leg();
  const auto boards = boards_of(leg);
  ASSERT_EQ(boards.size(), 1u);
  EXPECT_EQ(boards[0].joints, (std::vector<int>{0, 1}));
  EXPECT_EQ(boards[0].muscles, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(boards[0].sensors, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(only_board(leg, boards, 0).links.size(), leg.links.size());
  EXPECT_TRUE(wrong_with(leg).empty());
}

// With any named boards and ties, every part is on one board, together with its sensors; and if no
// joint names a board, no board is too full or left out.
TEST(Boards, EveryPartIsOnOneWithWhatBelongsToIt) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    Robot robot = machine(1 + random() % 24);
    const std::size_t n = robot.joints.size();
    for (std::size_t j = 1; j < n; ++j)
      if (random() % 4 == 0) tie(robot, j - 1, j), ++j;
    const bool named = trial % 2 == 1;
    for (Joint& joint : robot.joints)
      if (named && random() % 3 == 0) joint.board = 1 + static_cast<int>(random() % 4);
    for (std::size_t k = 0; k < random() % 3; ++k) {
      Sensor fixed;
      fixed.name = "battery" + std::to_string(k);
      fixed.kind = Sensor::Kind::fixed;
      robot.sensors.push_back(fixed);
    }

    const auto boards = boards_of(robot);
    std::size_t joints = 0, muscles = 0, sensors = 0;
    for (std::size_t b = 0; b < boards.size(); ++b) {
      joints += boards[b].joints.size();
      muscles += boards[b].muscles.size();
      sensors += boards[b].sensors.size();
      const Robot part = only_board(robot, boards, b);
      for (const Muscle& m : part.muscles) EXPECT_GE(find_joint(part, m.joint), 0);
      for (const Sensor& s : part.sensors)
        EXPECT_TRUE(s.of.empty() || find_joint(part, s.of) >= 0 || find_muscle(part, s.of) >= 0);
      for (const int j : boards[b].joints)
        EXPECT_EQ(board_of_joint(boards, j), static_cast<int>(b) + 1);
    }
    EXPECT_EQ(joints, n);
    EXPECT_EQ(muscles, robot.muscles.size());
    EXPECT_EQ(sensors, robot.sensors.size());
    for (std::size_t j = 0; j < n; ++j) {
      const int asked = robot.joints[j].board;
      EXPECT_TRUE(asked == 0 || board_of_joint(boards, static_cast<int>(j)) == asked);
    }
    EXPECT_TRUE(named || first_wrong(robot).empty());
  }
}

// 24 joints with a pair each fill three boards in the order of the file.
TEST(Boards, FillInTheOrderOfTheFile) {
  const Robot robot = machine(24);
  const auto boards = boards_of(robot);
  ASSERT_EQ(boards.size(), 3u);
  for (std::size_t b = 0; b < 3; ++b) {
    ASSERT_EQ(boards[b].joints.size(), 8u);
    EXPECT_EQ(boards[b].joints.front(), static_cast<int>(8 * b));
    EXPECT_EQ(boards[b].muscles.size(), 16u);
    EXPECT_EQ(boards[b].sensors.size(), 24u);
  }
  EXPECT_EQ(first_wrong(robot), "");
}

// A converter of 32 channels has room for six such joints with pressures in addition to tensions.
TEST(Boards, AConverterIsFullBeforeTheJointsAre) {
  Robot robot = machine(8);
  for (const Muscle& m : robot.muscles) {
    test::add_sensor(robot, Sensor::Kind::pressure, m.name);
    robot.sensors.back().name += "_pressure";
  }
  const auto boards = boards_of(robot);
  ASSERT_EQ(boards.size(), 2u);
  EXPECT_EQ(boards[0].joints.size(), 6u);
  EXPECT_EQ(boards[0].sensors.size(), 30u);
  EXPECT_EQ(first_wrong(robot), "");
}

// The cylinder's loop counts as one more joint, after the robot's; only one board has its bits.
TEST(Boards, TheCylinderIsOneJointMore) {
  Robot robot = machine(8);
  robot.cylinder = {.present = true, .mode = Cylinder::Mode::valves};
  test::add_sensor(robot, Sensor::Kind::cylinder, "");
  auto boards = boards_of(robot);
  ASSERT_EQ(boards.size(), 2u);
  EXPECT_FALSE(boards[0].cylinder);
  EXPECT_TRUE(boards[1].cylinder);
  EXPECT_EQ(boards[1].sensors, (std::vector<int>{24}));
  EXPECT_FALSE(has_cylinder_joint(only_board(robot, boards, 0)));
  EXPECT_TRUE(has_cylinder_joint(only_board(robot, boards, 1)));

  robot.cylinder.board = 1;
  EXPECT_EQ(
      first_wrong(robot),
      "cylinder.board: 9 joints on board 1, the cylinder's loop included; at most 8 joints on "
      "a board");
}

TEST(Boards, SayWhatCannotBe) {
  Robot full = machine(10);
  for (Joint& joint : full.joints) joint.board = 2;
  full.joints[0].board = 1;
  EXPECT_EQ(first_wrong(full),
            "joint.joint9.board: 9 joints on board 2; at most 8 joints on a board");

  Robot torn = machine(2);
  tie(torn, 0, 1);
  torn.joints[0].board = 1, torn.joints[1].board = 2;
  EXPECT_EQ(first_wrong(torn),
            "muscle.over0and1.second.joint: joint joint0 on board 1, joint joint1 on board 2; both "
            "joints of a muscle on one board, where their laws share its duties");

  Robot gap = machine(2);
  gap.joints[1].board = 3;
  EXPECT_EQ(first_wrong(gap),
            "joint.joint1.board: a board 3 and no board 2; numbers from 1 on with none left out");

  Robot crowded = machine(8);
  for (int k = 0; k < 9; ++k) {
    Sensor fixed;
    fixed.name = "fixed" + std::to_string(k);
    fixed.kind = Sensor::Kind::fixed;
    fixed.board = 1;
    crowded.sensors.push_back(fixed);
  }
  EXPECT_EQ(first_wrong(crowded),
            "sensor.fixed8: 33 sensors on board 1; at most 32 channels on a board");
}

// Bits, channels and ticks belong to a board: equal numbers are valid on two boards, not on one.
TEST(Boards, EachHasItsOwnBitsChannelsAndTicks) {
  const auto count = [](const Robot& robot, const std::string& tail) {
    return std::ranges::count_if(contradictions(robot),
                                 [&](const Contradiction& c) { return c.key.ends_with(tail); });
  };
  Robot robot = test::two_legs();
  for (std::size_t m = 4; m < 8; ++m) {
    robot.muscles[m].inlet_bit = robot.muscles[m - 4].inlet_bit;
    robot.muscles[m].exhaust_bit = robot.muscles[m - 4].exhaust_bit;
  }
  for (std::size_t s = 6; s < 12; ++s) {
    robot.sensors[s].channel = robot.sensors[s - 6].channel;
    robot.sensors[s].tick = robot.sensors[s - 6].tick;
  }
  EXPECT_EQ(count(robot, ".bit"), 8);
  EXPECT_EQ(count(robot, ".channel"), 6);
  EXPECT_EQ(count(robot, ".tick"), 6 - 5);  // the rest ascend among themselves
  robot.joints[2].board = robot.joints[3].board = 2;
  EXPECT_EQ(contradictions(robot).size(), 0u);
}

}  // namespace
}  // namespace sinew::robot::boards_test
