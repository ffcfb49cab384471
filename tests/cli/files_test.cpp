// `show` and `check` on the files that are shipped.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::files_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

Json shown(const Workspace& w, const Words& words) {
  Words all{"show", "--json"};
  all.insert(all.end(), words.begin(), words.end());
  const Result result = w.sinew(all);
  EXPECT_EQ(result.code, 0) << result.err;
  return result.code == 0 ? Json::parse(result.out) : Json::array();
}

TEST(Show, TellsOfAValueWhatItIsAndWhereItCameFrom) {
  const Workspace w;
  const Json all = shown(w, {"robots/leg/robot.toml", "joint.knee.damping"});
  ASSERT_EQ(all.size(), 1u);
  const Json& damping = all[0];
  EXPECT_EQ(damping["key"], "joint.knee.damping");
  EXPECT_THAT(damping["written"].get<std::string>(), HasSubstr("lbf in s/rad"));
  EXPECT_THAT(damping["si"].get<std::string>(), HasSubstr(" N m s/rad"));
  EXPECT_EQ(damping["fit"], true);
  EXPECT_EQ(damping["file"], "robots/leg/robot.toml");
  EXPECT_GT(damping["line"], 1);
  EXPECT_FALSE(damping["source"].get<std::string>().empty());
}

TEST(Show, ReadsEveryKindOfFile) {
  const Workspace w;
  for (const auto& [file, key] : {std::pair{"robots/leg/actuator.toml", "actuator.bpa.braid.turns"},
                                  {"robots/leg/valves.toml", "valve.inlet.opening_delay"},
                                  {"robots/leg/robot.toml", "valve.inlet.opening_delay"},
                                  {"experiments/walk-test-1.toml", "actuator.bpa.braid.turns"},
                                  {"experiments/walk-test-1.toml", "phase.swing.duration"}}) {
    EXPECT_EQ(shown(w, {file, key}).size(), 1u) << file;
  }
}

// A value that a file leaves open is no number, and is not shown as one.
TEST(Show, NoNumberIsNone) {
  const Workspace w;
  for (const char* file : {"robots/leg/robot.toml", "experiments/walk-test-1.toml",
                           "experiments/cricket.toml", "experiments/rig/feedback.toml"}) {
    for (const bool json : {true, false}) {
      Words words{"show", file};
      if (json) words.emplace_back("--json");
      const Result r = w.sinew(words);
      EXPECT_EQ(r.code, 0);
      for (const char* none : {" nan ", " inf ", "\"nan ", "\"inf ", "-inf ", "null"})
        EXPECT_THAT(r.out, ::testing::Not(HasSubstr(none))) << file;
    }
  }
  EXPECT_EQ(shown(w, {"robots/leg/robot.toml", "muscle.hip_flexor.moment_arm"})[0]["written"],
            "not set");
}

TEST(Show, FiltersByHowKeysBegin) {
  const Workspace w;
  for (const Json& value : shown(w, {"robots/leg/robot.toml", "joint.hip", "air"})) {
    const std::string key = value["key"];
    EXPECT_TRUE(key.starts_with("joint.hip") || key.starts_with("air")) << key;
  }
  const Result none = w.sinew({"show", "robots/leg/robot.toml", "trolley.darg"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, AllOf(HasSubstr("found \"trolley.darg\""), HasSubstr("try trolley.drag")));
}

TEST(Show, TakesOverrides) {
  const Workspace w;
  const Json drag =
      shown(w, {"experiments/walk-test-1.toml", "trolley.drag", "--set", "trolley.drag=1 lbf"});
  EXPECT_EQ(drag[0]["si"], "4.4482216152605 N");
}

TEST(Check, FindsNothingWrongWithWhatIsShipped) {
  const Workspace w;
  Words words{"check", "--json"};
  for (const char* folder : {"robots", "experiments"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(w / folder))
      if (entry.is_regular_file()) words.push_back(entry.path().string());
  const Result result = w.sinew(words);
  EXPECT_EQ(result.code, 0) << result.out;
  for (const Json& file : Json::parse(result.out)) {
    EXPECT_EQ(file["problems"], Json::array());
    const bool robot = file["file"].get<std::string>().find("robots/") != std::string::npos;
    EXPECT_TRUE(!robot || file["warnings"].empty()) << file["file"];
  }
}

TEST(Check, WantsSources) {
  const Workspace w;
  const Result experiment = w.sinew({"check", "experiments/one-joint.toml"});
  EXPECT_EQ(experiment.code, 0);
  EXPECT_THAT(
      experiment.out,
      AllOf(HasSubstr("warning: experiments/one-joint.toml: "),
            HasSubstr("values without a source"), HasSubstr("where\n  "),
            ::testing::ContainsRegex(
                "\n  phase.up.duration +\"[0-9.]+ s\" +experiments/one-joint.toml:[0-9]+\n")));
  const Json rows =
      Json::parse(w.sinew({"check", "experiments/one-joint.toml", "--json"}).out)[0]["unsourced"];
  EXPECT_GT(rows.size(), 3U);
  for (const Json& row : rows) EXPECT_GT(row["line"].get<int>(), 0) << row["key"];

  w.edit("robots/leg/robot.toml", R"({ value = "8.875 in", source = "5.3" })", R"("8.875 in")");
  const Result robot = w.sinew({"check", "robots/leg/robot.toml"});
  EXPECT_EQ(robot.code, 1);
  EXPECT_THAT(robot.out, HasSubstr("link.femur.length: found \"8.875 in\" without a source"));
}

TEST(Check, FollowsNamesFromTableToTable) {
  const Workspace w;
  w.edit("robots/one-joint/robot.toml", R"({ valve = "inlet", bit = 0 })",
         R"({ valve = "inltet", bit = 0 })");
  const Result result = w.sinew({"check", "robots/one-joint/robot.toml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("muscle.flexor.inlet.valve: found \"inltet\""),
                                HasSubstr("try \"inlet\"")));
}

TEST(Check, GoesOnAfterAFileWithProblems) {
  const Workspace w;
  const Result result = w.sinew({"check", "nothing.toml", "robots/leg/valves.toml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("nothing.toml: 1 problem\n"),
                                HasSubstr("robots/leg/valves.toml: ok\n")));
}

// What a command reads, a log and parameters are replaced by no table, page or summary.
TEST(Files, ForceReplacesNoInputAndNoOtherKind) {
  const Workspace w;
  const std::string bench = "experiments/one-joint.toml";
  ASSERT_EQ(w.sinew({"run", bench, "-o", "r", "--no-report"}).code, 0);
  std::filesystem::create_hard_link(w / "r/log.mcap", w / "same.csv");
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"export", "r", "--csv"}, "r/log.mcap"},     {{"export", "r", "--csv"}, "same.csv"},
      {{"export", "r", "--csv"}, "r/summary.json"}, {{"report", "r"}, "r/log.mcap"},
      {{"analyze", "r"}, "r/resolved.toml"},        {{"sweep", bench}, bench}};
  for (const auto& [words, target] : cases) {
    const std::string before = read_text(w / target);
    Words all = words;
    all.insert(all.end(), {"-o", target, "--force"});
    const Result r = w.sinew(all);
    EXPECT_EQ(r.code, 1) << words[0] << " -o " << target;
    EXPECT_THAT(r.err, ::testing::HasSubstr("another name")) << words[0];
    EXPECT_TRUE(read_text(w / target) == before) << words[0] << " -o " << target;
  }
  EXPECT_EQ(w.sinew({"analyze", "r", "-o", "r/summary.json", "--force"}).code, 0);
}

// A name beside that is a user's own.
TEST(Files, APartOfAUsersStays) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", "experiments/one-joint.toml", "-o", "r", "--no-report"}).code, 0);
  write_text(w / "foo.csv.part", "mine");
  EXPECT_EQ(w.sinew({"export", "r", "--csv", "-o", "foo.csv"}).code, 0);
  EXPECT_EQ(read_text(w / "foo.csv.part"), "mine");
}

}  // namespace
}  // namespace sinew::test::files_test
