// gain.dat as B.5 prints it, as keys of a robot, and with faults.
#include "sinew/config/gains.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sinew/config/compose.h"

namespace sinew::config::gains_test {
namespace {

const std::string walking = "0.9, 35.0\n0.035,6.5\n0.12,5.0\n";
const std::string damped = "0.9, 35.0, 0.0\n0.035,6.5,0.02\n0.12,5.0,0.0\n";

std::string message(const std::string& text) {
  try {
    parse_gains(text, "gain.dat");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Gains, AreReadAsTheThesisPrintsThem) {
  const auto rows = parse_gains(walking, "gain.dat");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].angle, 0.9);
  EXPECT_EQ(rows[0].stiffness, 35.0);
  EXPECT_EQ(rows[1].angle, 0.035);
  EXPECT_EQ(rows[2].stiffness, 5.0);
  EXPECT_EQ(rows[2].velocity, 0.0);
  EXPECT_EQ(parse_gains(damped, "gain.dat")[1].velocity, 0.02);
}

TEST(Gains, SayWhereTheyAreWrong) {
  EXPECT_EQ(message("0.9, 35.0\n0.035;6.5\n"),
            "gain.dat:2:1: found 1 columns; expected angle gain, stiffness gain, velocity gain, "
            "the last may be missing; try a comma between two numbers");
  EXPECT_EQ(message("0.9, x\n"), "gain.dat:1:6: found \"x\"; expected a number");
  EXPECT_EQ(message("1,2,3,4\n").find("gain.dat:1:1: found 4 columns"), 0U);
  EXPECT_EQ(message("1,2\n\n1,nan\n").find("gain.dat:3:3: found \"nan\""), 0U);
}

// Folder with a robot of two joints and an experiment.
class GainFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    write("gain.dat", damped);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string robot(const std::string& more, const std::string& files) const {
    return write("robot.toml", "format = \"sinew.robot/1\"\n" + files + "[joint.hip]\n" + more +
                                   "[joint.knee]\n[joint.ankle]\nkind = \"passive\"\n");
  }
  static std::string value(const Node& root, std::initializer_list<std::string_view> path) {
    const Node* at = &root;
    for (const std::string_view key : path) at = at ? at->find(key) : nullptr;
    return at ? written(*at) : "nothing";
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("sinew-gains-" + std::to_string(getpid()));
};

TEST_F(GainFile, BecomesTheGainsOfTheJointsWithMuscles) {
  const Node root = compose(robot("", "files = { gains = \"gain.dat\" }\n"));
  EXPECT_EQ(value(root, {"joint", "hip", "angle_gain", "value"}), "0.035 %/count");
  EXPECT_EQ(value(root, {"joint", "hip", "stiffness_gain", "value"}), "6.5 %/(lbf in/rad)");
  EXPECT_EQ(value(root, {"joint", "hip", "velocity_gain", "value"}), "0.02 % s/count");
  EXPECT_EQ(value(root, {"joint", "knee", "angle_gain", "value"}), "0.12 %/count");
  EXPECT_EQ(value(root, {"joint", "ankle", "angle_gain"}), "nothing");
  EXPECT_EQ(root.find("control"), nullptr) << "a robot asks for no stiffness";
  EXPECT_EQ(root.find("joint")->find("knee")->find("angle_gain")->where.line, 3);
}

// The experiment's file replaces the robot's, with B.1's desired stiffness of joint 1.
TEST_F(GainFile, OfAnExperimentGoesBeforeTheRobots) {
  robot("angle_gain = \"1 %/count\"\n", "");
  const std::string path = write(
      "walk.toml",
      "format = \"sinew.experiment/1\"\nrobot = \"robot.toml\"\n"
      "files = { gains = \"gain.dat\" }\n[control]\nstiffness = { knee = \"20 lbf in/rad\" }\n");
  const Node root = compose(path);
  EXPECT_EQ(value(root, {"joint", "hip", "angle_gain", "value"}), "0.035 %/count");
  EXPECT_EQ(value(root, {"control", "stiffness", "hip", "value"}), "35 lbf in/rad");
  EXPECT_EQ(value(root, {"control", "stiffness", "knee"}), "20 lbf in/rad");
}

TEST_F(GainFile, ContradictsAKeyBesideIt) {
  const std::string path =
      robot("angle_gain = \"1 %/count\"\n", "files = { gains = \"gain.dat\" }\n");
  try {
    compose(path);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()),
              path +
                  ":4:1: joint.hip.angle_gain: found \"1 %/count\"; expected no value: "
                  "files.gains = \"gain.dat\" has it");
  }
}

TEST_F(GainFile, NeedsARowForEveryJoint) {
  const std::string path = robot("", "files = { gains = \"gain.dat\" }\n");
  const std::string file = write("gain.dat", "0.9,35\n0.035,6.5\n");
  try {
    compose(path);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()),
              file + ":2:1: found 2 rows; expected 3: the cylinder's, then one per joint");
  }
}

}  // namespace
}  // namespace sinew::config::gains_test
