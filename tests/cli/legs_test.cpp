// Robots with several legs, through every command that looks at one.
#include <gmock/gmock.h>

#include "sinew/units/literals.h"
#include "tests/cli/json.h"

namespace sinew::test::legs_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const std::string robot = "robots/two-legs/robot.toml", walk = "experiments/walk-two-legs.toml";

// One short step, kept in `run`.
Result walked(const Workspace& w) {
  return w.sinew({"run", walk, "--set", "sequence.repeat=1", "-o", "run", "--quiet"});
}

TEST(Legs, RunKeepReplayAndExport) {
  const Workspace w;
  const Result run = walked(w);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(read_text(w / "run/summary.json"));
  for (const char* leg : {"left", "right"}) {
    const Json& of = summary["legs"][leg];
    for (const char* part : {"joints", "muscles", "foot", "ground_reaction", "phases"})
      EXPECT_TRUE(of.contains(part)) << leg << part;
    EXPECT_GT(of["foot"]["loaded_share_true"].get<double>(), 0.2);
    EXPECT_GT(of["joints"]["hip"]["excursion_rad"].get<double>(), 0.3);
  }
  EXPECT_FALSE(summary.contains("joints"));
  EXPECT_TRUE(summary["trolley"].contains("distance_from_torques_m"));

  const Result replay = w.sinew({"replay", "run"});
  EXPECT_EQ(replay.code, 0) << replay.err;
  EXPECT_THAT(replay.out, HasSubstr("all equal"));

  // A resolved run runs again, from its own numbers alone.
  const Result again = w.sinew({"run", "run/resolved.toml", "-o", "again", "--quiet"});
  ASSERT_EQ(again.code, 0) << again.err;
  Json second = Json::parse(read_text(w / "again/summary.json")), first = summary;
  first.erase("host"), second.erase("host");
  EXPECT_EQ(first, second);

  const Result csv = w.sinew({"export", "run", "--format", "csv", "--derived"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  const std::string header = csv.out.substr(0, csv.out.find('\n'));
  for (const char* column :
       {"/leg/left/joint/hip/angle [rad]", "/desired/leg/right/joint/knee/angle [rad]",
        "/true/leg/left/foot/force.y [N]", "/leg/right/foot/force.y [N]",
        "/leg/right/valve/hip_flexor/inlet/open [1]", "/leg/left/joint/hip/torque [N m]",
        "/true/trolley/position [m]", "/sensor/left_hip_angle/count [count]"})
    EXPECT_THAT(header, HasSubstr(column));

  const Result old = w.sinew({"export", "run", "--format", "out.dat"});
  EXPECT_EQ(old.code, 1);
  EXPECT_THAT(old.err, AllOf(HasSubstr("2 legs"), HasSubstr("--format csv")));
  const Result ports = w.sinew({"export", "run", "--format", "ports"});
  EXPECT_EQ(ports.code, 0) << ports.err;
}

TEST(Legs, AnalyzeCompareAndFigures) {
  const Workspace w;
  ASSERT_EQ(walked(w).code, 0);
  const Result analyze = w.sinew({"analyze", "run", "--json"});
  EXPECT_EQ(analyze.code, 0) << analyze.err;
  EXPECT_THAT(analyze.out, HasSubstr("loaded_share_true"));
  const Result compare = w.sinew({"compare", "run", "run", "--json"});
  EXPECT_EQ(compare.code, 0) << compare.err;
  EXPECT_THAT(compare.out, HasSubstr("/true/leg/left/foot/position"));
  const Result figures = w.sinew({"figures", "run", "-o", "figures", "--quiet"});
  EXPECT_EQ(figures.code, 0) << figures.err;
  const auto names = names_in(w / "figures");
  EXPECT_THAT(names, ::testing::Contains(HasSubstr("foot-path-left")));
  EXPECT_THAT(names, ::testing::Contains(HasSubstr("foot-path-right")));
}

TEST(Legs, CheckAndShow) {
  const Workspace w;
  EXPECT_EQ(w.sinew({"check", robot}).code, 0);
  EXPECT_EQ(w.sinew({"check", walk}).code, 0);
  const Result show = w.sinew({"show", robot, "leg.right"});
  EXPECT_EQ(show.code, 0) << show.err;
  EXPECT_THAT(show.out, AllOf(HasSubstr("right_hip"), HasSubstr("50 %")));
}

TEST(Legs, KinematicsOfOne) {
  const Workspace w;
  const Json two = json(w, {"kinematics", robot, "--leg", "right", "--foot", "-2 in, -13 in"});
  const Json one = json(w, {"kinematics", "robots/leg/robot.toml", "--foot", "-2 in, -13 in"});
  EXPECT_EQ(two["leg"], "right");
  EXPECT_EQ(two["branches"], one["branches"]);

  const Result none = w.sinew({"kinematics", robot, "--foot", "-2 in, -13 in"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("--leg: found none"), HasSubstr("--leg left")));
  const Result other =
      w.sinew({"kinematics", "robots/leg/robot.toml", "--leg", "left", "--foot", "-2 in, -13 in"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("leg has one leg"));
}

// A contradiction is said in the file's words, with what to do.
TEST(Legs, WhatCannotBe) {
  const auto says = [](const std::vector<std::string>& sets) {
    const Workspace w;
    Words words{"run", walk, "-o", "run", "--quiet"};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, r.err.starts_with("--set") ? 2 : 1) << sets[0];
    return r.err;
  };
  EXPECT_THAT(says({"link.right_femur.parent=left_shin"}),
              AllOf(HasSubstr("link.right_femur.parent: found \"left_shin\""),
                    HasSubstr("body, left_femur, left_tibia")));
  EXPECT_THAT(says({"link.right_femur.parent=left_tibia"}),
              AllOf(HasSubstr("body, or a link of no leg"), HasSubstr("parent = \"body\"")));
  EXPECT_THAT(says({"leg.right.joints=[\"right_hip\"]"}),
              AllOf(HasSubstr("robots/two-legs/robot.toml:"),
                    HasSubstr("joint.right_knee: found in no leg")));
  EXPECT_THAT(says({"leg.right.plan=late"}),
              AllOf(HasSubstr("leg.right.plan: found \"late\""), HasSubstr("[plan.late]")));
  EXPECT_THAT(says({"leg.right.offset=120 %"}), HasSubstr("leg.right.offset"));
  EXPECT_THAT(says({"phase.swing.until={ measure = \"joint.left_hip.angle\", level = \"1 rad\" }"}),
              HasSubstr("phase.swing.until.measure: found \"joint.left_hip.angle\""));
  EXPECT_THAT(says({"joint.right_knee.angle_gain=0.3 %/count"}),
              HasSubstr("joint.right_knee: found another kind, switch or gain"));
}

}  // namespace
}  // namespace sinew::test::legs_test
