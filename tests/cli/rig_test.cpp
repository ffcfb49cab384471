// Experiments on the test stand, as their users run them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "sinew/log/reader.h"
#include "tests/cli/program.h"

namespace sinew::test::rig_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

const std::string trapped = "experiments/rig/trapped-60-6.toml";

Json summary(const std::string& text) {
  Json all = Json::parse(text);
  all.erase("host");
  return all;
}

TEST(Rig, ARunIsAFolderThatRunsAndIsAnalyzedAgain) {
  const Workspace w;
  const Result run = w.sinew({"run", trapped, "-o", "a", "--no-report"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(StartsWith("Trapped air, 60 psi and 6 lb"), HasSubstr("  agrees  "),
                             Not(HasSubstr("  differs  "))));
  EXPECT_THAT(names_in(w / "a"), ElementsAre("log.mcap", "resolved.toml", "summary.json"));

  EXPECT_EQ(w.sinew({"run", "a/resolved.toml", "-o", "b", "--quiet"}).code, 0);
  const Json first = summary(read_text(w / "a/summary.json"));
  EXPECT_EQ(first, summary(read_text(w / "b/summary.json")));
  EXPECT_EQ(first, summary(w.sinew({"analyze", "a", "--json"}).out));
  EXPECT_EQ(w.sinew({"check", "a", trapped}).code, 0);
}

// A stand with sensors leaves what they showed, as `sinew identify` reads it.
TEST(Rig, SensorsLeaveMeasuredCsv) {
  const Workspace w;
  const Words run{
      "run", "experiments/rig/weights-60.toml", "-o", "a", "--set", "duration=5 s", "--no-report"};
  ASSERT_EQ(w.sinew(run).code, 0);
  EXPECT_THAT(names_in(w / "a"),
              ElementsAre("log.mcap", "measured.csv", "resolved.toml", "summary.json"));
  EXPECT_THAT(read_text(w / "a/measured.csv"),
              StartsWith("time [s],length [m],force [N],pressure [Pa gauge]\n0.4,"));
  Words again = run;
  again.emplace_back("--force");
  EXPECT_EQ(w.sinew(again).code, 0);
}

TEST(Rig, TheLogHasWhatTheRunHas) {
  const Workspace w;
  const std::string file = "experiments/rig/pwm-25hz-5lb.toml";
  ASSERT_EQ(w.sinew({"run", file, "-o", "a", "--set", "duration=0.2 s", "--set",
                     "log.channels=[\"/true/stand/*\", \"/valve/*\"]"})
                .code,
            0);
  const signals::Table log = log::read(w / "a/log.mcap");
  EXPECT_EQ(log.column("/true/stand/length")->size(), 201u);
  EXPECT_EQ(log.column("/valve/bpa/inlet/open")->size(), 11u);
  EXPECT_EQ(log.find("/true/muscle/bpa/pressure"), nullptr);
}

TEST(Rig, RunsWithoutHoseAndFittings) {
  const Workspace w;
  const Result run = w.sinew({"run", trapped, "-o", "a", "--no-report", "--json", "--set",
                              "element.external_volume=0 m3"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, Not(HasSubstr("hangs nowhere")));
  EXPECT_TRUE(summary(run.out)["stand"]["final_length_m"].is_number());
}

// One channel alone, of a place of its own in what is recorded: the length that is desired.
TEST(Rig, ALogOfOneChannelHoldsThatChannel) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", "experiments/rig/feedback.toml", "-o", "a", "--no-report", "--set",
                     "duration=0.2 s", "--set", "log.channels=[\"/desired/length\"]"})
                .code,
            0);
  const signals::Table log = log::read(w / "a/log.mcap");
  ASSERT_EQ(log.series.size(), 1u);
  EXPECT_NEAR(log.column("/desired/length")->front(), 0.08128, 1e-12);
  EXPECT_THAT(w.sinew({"export", "a", "--csv"}).out,
              StartsWith("time [s],/desired/length [m]\n0,0.08128\n"));
}

TEST(Rig, BothSetsOfConstantsAreOneSetApart) {
  const Workspace w;
  const auto length = [&](const Words& sets) {
    Words words{"run", trapped, "--json", "--quiet"};
    words.insert(words.end(), sets.begin(), sets.end());
    return Json::parse(w.sinew(words).out)["stand"]["final_length_m"].get<double>() / 0.0254;
  };
  EXPECT_NEAR(length({}), 2.89320, 1e-5);  // data/reference.json
  EXPECT_NEAR(length({"--set", "element.actuator=equations"}), 2.87994, 1e-5);
}

TEST(Rig, MessagesNameWhatIsWrong) {
  const Workspace w;
  const Result pace = w.sinew({"run", trapped, "--pace", "1"});
  EXPECT_EQ(pace.code, 2);
  EXPECT_THAT(pace.err, HasSubstr("--pace"));
  const int line = w.edit(trapped, "external_volume = ", "external_volum = ");
  const Result check = w.sinew({"check", trapped});
  EXPECT_EQ(check.code, 1);
  EXPECT_THAT(check.out, AllOf(HasSubstr(trapped + ":" + std::to_string(line)),
                               HasSubstr("element.external_volum"), HasSubstr("external_volume")));
}

TEST(Rig, ALengthThatNoMuscleHasIsTold) {
  const Workspace w;
  const Words pulsed{"run", "experiments/rig/pwm-25hz-1lb.toml", "--set"};
  const auto warns = [&](const std::string& actuator) {
    Words words = pulsed;
    words.push_back("element.actuator=" + actuator);
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.err.find("[31] has no force") != result.err.npos;
  };
  EXPECT_TRUE(warns("appendix-a"));
  EXPECT_FALSE(warns("empirical"));
}

TEST(Rig, ShowTellsWhereAValueCameFrom) {
  const Workspace w;
  const Result show = w.sinew({"show", "experiments/rig/trapped-80-11.toml", "load.mass"});
  EXPECT_EQ(show.code, 0);
  EXPECT_THAT(show.out, AllOf(HasSubstr("11 lb"), HasSubstr("figure 3-8")));
}

}  // namespace
}  // namespace sinew::test::rig_test
