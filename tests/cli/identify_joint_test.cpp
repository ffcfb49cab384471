// `identify joint` from the outside: a joint's table and an actuator's file from angles, pressures
// and a load.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"
#include "sinew/units/constants.h"
#include "tests/cli/program.h"

namespace sinew::test::identify_joint_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

constexpr double arm = 0.03, mount = 0.083, share = 0.9, lever = 0.15;

// A knee that two actuators flex against weights on a lever, at angles that the pressure was set
// for. Synthetic.
std::string poses(double half_range) {
  std::string out = "angle [deg],flexor_pressure [kPa gauge],load [lb]\n";
  for (int i = 0; i < 60; ++i) {
    const double q = half_range * std::sin(2.4 * i), gauge = 150e3 + 400e3 * (i % 7) / 6.0;
    const double tension =
        share * actuator::ideal_tension(actuator::thesis_actuator().braid, mount - arm * q, gauge);
    // Flexion lowers the angle, so the load has to raise it.
    const double angle = 310 - q / units::degree, torque = 2 * arm * tension;
    const double load =
        -torque / (units::standard_gravity * lever * std::sin((angle - 70) * units::degree));
    const double read = load * (1 + 0.002 * std::sin(31.0 * i));
    out += std::to_string(angle) + "," + std::to_string(1e-3 * gauge) + "," +
           std::to_string(read / units::pound_mass) + "\n";
  }
  return out;
}

const Words knee{"identify", "joint",   "knee.csv",  "--actuator",   "robots/leg/actuator.toml",
                 "--count",  "2",       "--flexion", "lowers angle", "--rest-angle",
                 "310 deg",  "--lever", "15 cm",     "--down",       "70 deg",
                 "--joint",  "knee"};

Result identified(const Workspace& w, const Words& more) {
  Words words = knee;
  words.insert(words.end(), more.begin(), more.end());
  return w.sinew(words);
}

TEST(IdentifyJoint, WritesARobotThatHasTheJointAndAnActuator) {
  const Workspace w;
  write_text(w / "knee.csv", poses(0.45));
  const Result result = identified(w, {"--json", "--base", "robots/leg/robot.toml", "-o",
                                       "my-leg.toml", "--actuator-out", "my-actuator.toml"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_EQ(out["chosen"], "round") << out["rule"];
  EXPECT_NEAR(out["moment_arm_m"], arm, 0.02 * arm);
  EXPECT_NEAR(out["flexor_length_m"], mount, 0.01 * mount);
  EXPECT_EQ(out["combinations"].size(), 3u);

  Result check = w.sinew({"check", "my-leg.toml"});
  EXPECT_EQ(check.code, 0) << check.err;
  check = w.sinew({"check", "my-actuator.toml"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(read_text(w / "my-actuator.toml"), HasSubstr("identify joint knee.csv: round, c0"));
  EXPECT_THAT(read_text(w / "my-leg.toml"),
              AllOf(HasSubstr("[muscle.knee_flexor]"), HasSubstr("uncertainty"),
                    HasSubstr("lowers angle")));
}

TEST(IdentifyJoint, SaysWhatItCannotTellApart) {
  const Workspace w;
  write_text(w / "knee.csv", poses(0.06));
  Result result = identified(w, {});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("cannot be told apart"), HasSubstr("determined is"),
                                HasSubstr("try larger excursions, --moment-arm")));

  result = identified(w, {"--moment-arm", "3 cm"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("what the data tell apart"));
}

TEST(IdentifyJoint, RefusesWithoutAKnownLoad) {
  const Workspace w;
  write_text(w / "knee.csv", "angle [deg],flexor_pressure [psi gauge]\n300,20\n310,30\n320,40\n");
  Result result = identified(w, {});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("no known load"));

  result = identified(w, {"--base", "robots/leg/robot.toml"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--base: found no --out"));

  result = identified(w, {"--keep-force", "--model", "round_pressure"});
  EXPECT_EQ(result.code, 2);
}

// Pressures change from pose to pose, so no curve leads through them: the page shows what the model
// says against what was measured.
TEST(IdentifyJoint, LeavesAPageOfItsPoses) {
  if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without npm";
  const Workspace w;
  write_text(w / "knee.csv", poses(0.45));
  const Result result = identified(w, {"--json", "--report", "knee.html"});
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string html = read_text(w / "knee.html"), opening = "id=\"run-data\">";
  const std::size_t from = html.find(opening) + opening.size();
  const Json part = Json::parse(html.substr(from, html.find("</script>", from) - from))["parts"][0];
  const Json &points = part["charts"][0]["curves"][0], &left = part["charts"][1]["curves"][0];
  ASSERT_EQ(points["x"].size(), 60u);
  double square = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const double measured = points["x"][i], model = points["y"][i], off = left["y"][i];
    EXPECT_NEAR(model - measured, off, 2e-6 * std::abs(measured));
    square += off * off / 60;
  }
  EXPECT_NEAR(std::sqrt(square), part["report"]["fit"]["rmse"], 1e-4 * std::sqrt(square));
}

// The same knee held by hand at a torque cell whose zero is another one in each file.
std::string held(double zero) {
  std::string out = "angle [deg],flexor_pressure [kPa gauge],torque [N m]\n";
  for (int i = 0; i < 40; ++i) {
    const double q = 0.45 * std::sin(2.4 * i), gauge = 150e3 + 400e3 * (i % 7) / 6.0;
    const double tension =
        share * actuator::ideal_tension(actuator::thesis_actuator().braid, mount - arm * q, gauge);
    const double torque = 2 * arm * tension + zero + 0.005 * std::sin(31.0 * i);
    out += std::to_string(310 - q / units::degree) + "," + std::to_string(1e-3 * gauge) + "," +
           std::to_string(torque) + "\n";
  }
  return out;
}

TEST(IdentifyJoint, SeveralRecordingsHaveTheirZerosAndWhatIsKnownIsFrozen) {
  const Workspace w;
  write_text(w / "a.csv", held(0.4));
  write_text(w / "b.csv", held(-0.3));
  const auto asked = [&](const std::string& freeze) {
    return w.sinew({"identify", "joint", "a.csv", "b.csv", "--actuator", "robots/leg/actuator.toml",
                    "--count", "2", "--flexion", "lowers angle", "--rest-angle", "310 deg",
                    "--torque-bias", "--freeze", freeze, "--model", "round", "--json"});
  };
  const Result result = asked("moment_arm=3 cm");
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_EQ(out["moment_arm_m"], arm);
  EXPECT_NEAR(out["flexor_length_m"], mount, 0.01 * mount);
  const auto named = [&](const std::string& name) {
    for (const Json& p : out["parameters"])
      if (p["name"] == name) return p;
    return Json();
  };
  EXPECT_EQ(named("moment_arm")["known"], "frozen");
  EXPECT_NEAR(named("torque_bias of a.csv")["value"], 0.4, 0.02);
  EXPECT_NEAR(named("torque_bias of b.csv")["value"], -0.3, 0.02);
  const Result wrong = asked("arm=3 cm");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--freeze: found \"arm\"; expected a parameter"));
}

}  // namespace
}  // namespace sinew::test::identify_joint_test
