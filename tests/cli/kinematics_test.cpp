// `kinematics`: where the foot is, what its muscles and its torques are, in the file's own units.
#include <gmock/gmock.h>

#include "sinew/units/literals.h"
#include "tests/cli/json.h"

namespace sinew::test::kinematics_test {
namespace {

using namespace units::literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const std::string robot = "robots/leg/robot.toml";

TEST(Kinematics, GoesToTheFootAndBack) {
  const Workspace w;
  const Json there = json(w, {"kinematics", robot, "--foot", "-2 in, -13 in"});
  ASSERT_EQ(there["branches"].size(), 2u);
  for (const Json& branch : there["branches"]) {
    const auto angle = [&](const char* joint) {
      return std::to_string(branch["angles_rad"][joint].get<double>()) + " rad";
    };
    const Json back =
        json(w, {"kinematics", robot, "--angles", angle("hip") + "," + angle("knee")});
    EXPECT_NEAR(back["branches"][0]["foot_m"][0], -2.0_in, 1e-6);
    EXPECT_NEAR(back["branches"][0]["foot_m"][1], -13.0_in, 1e-6);
  }
  EXPECT_EQ(there["branches"][0]["within"], true) << "the leg's own branch comes first";
  EXPECT_EQ(there["branches"][1]["within"], false);
}

TEST(Kinematics, RefusesWhatNoJointIs) {
  const Workspace w;
  for (const auto& [words, says] :
       {std::pair{Words{"--angles", "1e300 deg, 10 deg"}, "--angles: found \"1e300 deg\""},
        {Words{"--foot", "1e300 in, 1 in"}, "--foot: found \"1e300 in\""},
        {Words{"--foot", "0 in, -13 in", "--force", "1e300 N, 0 N"},
         "--force: found \"1e300 N\""}}) {
    Words all = {"kinematics", robot};
    all.insert(all.end(), words.begin(), words.end());
    const Result r = w.sinew(all);
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.out, IsEmpty());
    EXPECT_THAT(r.err, AllOf(HasSubstr(says), HasSubstr("; expected "), HasSubstr(" to ")));
  }
}

TEST(Kinematics, SaysHowFarAFootCannotReach) {
  const Workspace w;
  const Result result = w.sinew({"kinematics", robot, "--foot", "-2 in, -23 in"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("23.087 in from the first joint"), HasSubstr("2.625 in to 15.125 in"),
                    HasSubstr("the nearest point that can be reached")));
}

TEST(Kinematics, KnowsOtherRobotsThanTheLeg) {
  const Workspace w;
  const Json lever = json(w, {"kinematics", "robots/one-joint/robot.toml", "--angles", "270 deg"});
  EXPECT_NEAR(lever["branches"][0]["foot_m"][1], -6.0_in, 1e-12);
  const Result foot =
      w.sinew({"kinematics", "robots/one-joint/robot.toml", "--foot", "1 in, 2 in"});
  EXPECT_EQ(foot.code, 1);
  EXPECT_THAT(foot.err, HasSubstr("--foot needs two"));
}

// A knee that bends by 10 deg gives the hamstring its arm there, 0.4 in, times that.
TEST(Kinematics, AMuscleOverTwoJointsFeelsBoth) {
  const Workspace w;
  const auto hamstring = [&](const char* angles) {
    const Json at =
        json(w, {"kinematics", "robots/three-muscle-leg/robot.toml", "--angles", angles});
    return at["branches"][0]["muscles"]["hamstring"]["length_m"].get<double>();
  };
  EXPECT_NEAR(hamstring("290 deg, 310 deg"), 3.15_in, 1e-12);
  EXPECT_NEAR(hamstring("290 deg, 300 deg"), 3.15_in - 0.4_in * 0.174532925199, 1e-12);
  EXPECT_NEAR(hamstring("300 deg, 300 deg"), 3.15_in + 0.6_in * 0.174532925199, 1e-12);
}

// Its file says mm and rad; so does what is printed of it, and the refusal.
TEST(Kinematics, SpeaksInTheUnitsOfTheRobotsFile) {
  const Workspace w;
  const std::string lever = "robots/one-joint/robot.toml";
  const Words words = {"kinematics", lever, "--angles", "270 deg"};
  EXPECT_THAT(w.sinew(words).out, AllOf(HasSubstr("-6 in"), HasSubstr("270 deg")));
  w.edit(lever, "value = \"6 in\"", "value = \"152.4 mm\"");
  w.edit(lever, "rest_angle     = \"270 deg\"", "rest_angle     = \"4.712 rad\"");
  const std::string out = w.sinew(words).out;
  EXPECT_THAT(out, AllOf(HasSubstr("foot at 0 mm, -152.4 mm"), HasSubstr("4.7124 rad"),
                         HasSubstr("99.517 mm")));
  EXPECT_THAT(out, AllOf(Not(HasSubstr(" in")), Not(HasSubstr("deg"))));

  const std::string& leg = robot;
  w.edit(leg, "value = \"8.875 in\"", "value = \"225.425 mm\"");
  EXPECT_THAT(w.sinew({"kinematics", leg, "--foot", "-2 in, -23 in"}).err,
              HasSubstr("66.675 mm to 384.18 mm"));
}

// [71]: a foot that presses straight down below the hip needs no torque there.
TEST(Kinematics, GivesTheTorquesOfAForce) {
  const Workspace w;
  const Words down = {"kinematics", robot, "--foot", "0 in, -13 in", "--force", "0 lbf, -20 lbf"};
  const Json out = json(w, down);
  for (const Json& branch : out["branches"]) {
    const double knee_y = branch["jacobian_m_per_rad"][1][1].get<double>();
    EXPECT_NEAR(branch["torques_Nm"]["hip"], 0, 1e-9);
    EXPECT_NEAR(branch["torques_Nm"]["knee"], -20.0_lbf * knee_y, 1e-9);
  }
  EXPECT_THAT(w.sinew(down).out, HasSubstr(" lbf in\n"));
  Words newtons = down;
  newtons.back() = "0 N, -90 N";
  EXPECT_THAT(w.sinew(newtons).out, AllOf(HasSubstr("torque knee"), HasSubstr(" N m\n")));
  newtons.back() = "-90 N";
  EXPECT_THAT(w.sinew(newtons).err, HasSubstr("--force: found \"-90 N\"; expected x and y; try "));
  newtons.back() = "0 lb, 1 lb";
  EXPECT_THAT(w.sinew(newtons).err, HasSubstr("--force: found \"0 lb\""));
}

}  // namespace
}  // namespace sinew::test::kinematics_test
