// `run` and what is made of its folder: analyze, export, replay.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "sinew/log/reader.h"
#include "tests/cli/program.h"

namespace sinew::test::run_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::string walk = "experiments/walk-test-1.toml";
const std::string bench = "experiments/one-joint.toml";

// The summary without what belongs to the machine that ran.
Json summary(const std::string& text) {
  Json all = Json::parse(text);
  all.erase("host");
  return all;
}

// --- folders ---

TEST(RunFolder, CountsUpAndHoldsLogResolvedAndSummary) {
  const Workspace w;
  EXPECT_EQ(w.sinew({"run", bench, "--no-report"}).code, 0);
  EXPECT_EQ(w.sinew({"run", bench, "--no-report"}).code, 0);
  EXPECT_THAT(names_in(w / "runs/one-joint"), ElementsAre("1", "2"));
  EXPECT_THAT(names_in(w / "runs/one-joint/2"),
              ElementsAre("log.mcap", "resolved.toml", "summary.json"));

  // A number is one above the highest, whatever is missing below.
  fs::remove_all(w / "runs/one-joint/1");
  EXPECT_EQ(w.sinew({"run", bench}).code, 0);
  EXPECT_THAT(names_in(w / "runs/one-joint"), ElementsAre("2", "3"));
}

TEST(RunFolder, ThatHoldsSomethingIsRefused) {
  const Workspace w;
  fs::create_directory(w / "mine");
  write_text(w / "mine/notes.txt", "keep");
  const Result refused = w.sinew({"run", bench, "-o", "mine"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(StartsWith("mine: found notes.txt; expected an empty folder"),
                                 HasSubstr("--force")));
  EXPECT_THAT(names_in(w / "mine"), ElementsAre("notes.txt"));

  write_text(w / "mine/report.html", "of an earlier run");
  write_text(w / "mine/summary.json", "of an earlier run");
  EXPECT_EQ(w.sinew({"run", bench, "-o", "mine", "--force", "--no-report"}).code, 0);
  EXPECT_THAT(names_in(w / "mine"),
              ElementsAre("log.mcap", "notes.txt", "resolved.toml", "summary.json"));
  EXPECT_EQ(read_text(w / "mine/notes.txt"), "keep");
}

TEST(RunFolder, ThatIsAFileIsRefused) {
  const Workspace w;
  write_text(w / "mine", "a file");
  const Result refused = w.sinew({"run", bench, "-o", "mine", "--force"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(read_text(w / "mine"), "a file");
}

TEST(RunFolder, WithoutLogHoldsOnlyTheSummary) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "off", "--set", "log.enabled=false"}).code, 0);
  ASSERT_EQ(w.sinew({"run", bench, "-o", "on"}).code, 0);
  EXPECT_THAT(names_in(w / "off"), ElementsAre("summary.json"));
  EXPECT_EQ(summary(read_text(w / "off/summary.json")), summary(read_text(w / "on/summary.json")));
}

// --- what is printed ---

TEST(Run, PrintsWhatIsReportedBesideOurs) {
  const Workspace w;
  const Result result = w.sinew({"run", walk});
  EXPECT_EQ(result.code, 0) << "a result that differs is no failure";
  EXPECT_THAT(result.out, AllOf(HasSubstr("trolley.distance  "), HasSubstr("55 to 60 in")));
  EXPECT_THAT(result.err, HasSubstr("kept in runs/walk-test-1/1"));
  EXPECT_THAT(result.err, HasSubstr("warning: hip_extensor_tension: "));
  EXPECT_THAT(result.err, ::testing::Not(HasSubstr("\r"))) << "a bar where there is no terminal";
}

TEST(Run, PrintsItsMainFiguresWhereNothingIsReported) {
  const Workspace w;
  const Result run = w.sinew({"run", bench, "-o", "bench"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("joints.lever.excursion "), HasSubstr("joints.lever.tracking_rms "),
                    HasSubstr(" deg\n"), HasSubstr("joints.lever.passiveness "), HasSubstr(" %\n"),
                    HasSubstr("air_used ")));
  EXPECT_THAT(w.sinew({"analyze", "bench"}).out, HasSubstr("joints.lever.excursion "));
}

TEST(Run, PrintsItsSummaryAsJson) {
  const Workspace w;
  const Result result = w.sinew({"run", bench, "-o", "run", "--json", "--quiet"});
  EXPECT_EQ(result.out, read_text(w / "run/summary.json"));
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_EQ(Json::parse(result.out)["format"], "sinew.summary/1");
}

// Warnings stand in summary.json, are found again by `analyze`, and are told by both.
TEST(Run, KeepsItsWarningsInTheSummary) {
  const Workspace w;
  const Result run = w.sinew({"run", walk, "-o", "a", "--no-report"});
  const Json kept = Json::parse(read_text(w / "a/summary.json"));
  ASSERT_TRUE(kept.contains("warnings"));
  EXPECT_FALSE(kept["host"].contains("warnings"));
  const Result again = w.sinew({"analyze", "a", "--json"});
  EXPECT_EQ(Json::parse(again.out)["warnings"], kept["warnings"]);
  for (const Json& text : kept["warnings"]) {
    const std::string line = "warning: " + text.get<std::string>() + "\n";
    EXPECT_THAT(run.err, HasSubstr(line));
    EXPECT_THAT(again.err, HasSubstr(line));
  }
  EXPECT_THAT(w.sinew({"analyze", "a", "--json", "--quiet"}).err, IsEmpty());
}

TEST(Run, SaysWhereItsPageIs) {
  const Workspace w;
  EXPECT_THAT(w.sinew({"run", bench, "-o", "a"}).err, HasSubstr("open a/report.html\n"));
  EXPECT_THAT(w.sinew({"run", bench, "-o", "b", "--json"}).err, HasSubstr("open b/report.html\n"));
  EXPECT_THAT(w.sinew({"run", bench, "-o", "a", "--force"}).err, HasSubstr("open a/report.html\n"));
  EXPECT_THAT(w.sinew({"run", bench, "-o", "c", "--quiet"}).err, IsEmpty());
  EXPECT_THAT(w.sinew({"run", bench, "-o", "d", "--no-report"}).err, Not(HasSubstr("report")));
  const std::string rig = "experiments/rig/trapped-60-6.toml";
  EXPECT_THAT(w.sinew({"run", rig, "-o", "e"}).err, HasSubstr("open e/report.html\n"));
}

// A robot that does nothing: valves that need longer than the longest pulse.
TEST(Run, WarnsOfARobotThatDoesNothing) {
  const Workspace w;
  const Result run =
      w.sinew({"run", bench, "-o", "a", "--no-report", "--set", "valve.inlet.opening_delay=20 ms",
               "--set", "joint.lever.angle_gain=0.01 %/count"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("no muscle took any air in the 12 s of the plan"),
                             HasSubstr("flexor: the inlet never opens: the longest of its "),
                             HasSubstr("the valve takes 20 ms to move")));
}

// Ends without strength let the lever go round as far as no cord runs; its converter sees a third.
TEST(Run, WarnsOfAJointThatGoesRound) {
  const Workspace w;
  Words words = {"run", bench, "-o", "a", "--no-report"};
  for (const char* set :
       {"joint.lever.moment_arm=0.5 in", "joint.lever.damping=0.001 lbf in s/rad",
        "joint.lever.dry_friction=0 lbf in", "actuator.bpa.long_end.stiffness=0.1 lbf/in",
        "actuator.bpa.short_end.law=zero", "muscle.flexor.bladder_stiffness=0 lbf/in",
        "muscle.extensor.bladder_stiffness=0 lbf/in"})
    words.insert(words.end(), {"--set", set});
  EXPECT_THAT(w.sinew(words).err, AllOf(HasSubstr("warning: lever: turned "),
                                        HasSubstr(" mm long, beyond its thread's 107.1 mm")));
}

TEST(Run, WarnsOfATrackThatEnds) {
  const Workspace w;
  const Result run =
      w.sinew({"run", walk, "-o", "a", "--no-report", "--set", "trolley.track_length=20 in"});
  EXPECT_THAT(run.err, HasSubstr("warning: the trolley reaches the end of its track at "));
  EXPECT_TRUE(summary(read_text(w / "a/summary.json"))["trolley"]["stop_reached_s"].is_number());
}

// --- the same bits ---

TEST(Run, TwiceTheSameBits) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "a"}).code, 0);
  ASSERT_EQ(w.sinew({"run", walk, "-o", "b"}).code, 0);
  for (const char* name : {"log.mcap", "resolved.toml"}) {
    const bool same =
        read_text(w / ("a/" + std::string(name))) == read_text(w / ("b/" + std::string(name)));
    EXPECT_TRUE(same) << name;
  }
  EXPECT_EQ(summary(read_text(w / "a/summary.json")), summary(read_text(w / "b/summary.json")));

  ASSERT_EQ(w.sinew({"run", walk, "-o", "c", "--set", "seed=2"}).code, 0);
  EXPECT_NE(summary(read_text(w / "a/summary.json")), summary(read_text(w / "c/summary.json")));
}

TEST(Run, WhatWasResolvedRunsAgainTheSame) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "a", "--set", "trolley.drag=1 lbf"}).code, 0);
  const Result again = w.sinew({"run", "a/resolved.toml", "-o", "b"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(summary(read_text(w / "a/summary.json")), summary(read_text(w / "b/summary.json")));
}

TEST(Run, OverridesSayThatTheyAre) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "a", "--set", "trolley.drag=1 lbf"}).code, 0);
  const Result shown = w.sinew({"show", "a/resolved.toml", "trolley.drag", "--json"});
  const Json drag = Json::parse(shown.out)[0];
  EXPECT_EQ(drag["written"], "1 lbf");
  EXPECT_EQ(drag["source"], "--set");
}

// 7.2: what the thesis saw without stiffness control, and our lightly damped leg does, is told;
// test 1 keeps its rollers down.
TEST(Run, WarnsOfRollersThatLiftOff) {
  const Workspace w;
  const Result lifted = w.sinew({"run", "experiments/no-stiffness-control.toml", "-o", "lifted",
                                 "--set", "robot=robots/leg-lightly-damped/robot.toml"});
  EXPECT_EQ(lifted.code, 0);
  EXPECT_THAT(lifted.err, HasSubstr("the front roller lifts off the track in "));
  const Result down = w.sinew({"run", "experiments/walk-test-1.toml", "-o", "down"});
  EXPECT_THAT(down.err, Not(HasSubstr("lifts off")));
}

TEST(Run, LogsOnlyTheChannelsThatAreAskedFor) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run", "--set",
                     R"(log.channels=["/sensor/*", "/joint/lever/angle", "/valve"])"})
                .code,
            0);
  for (const signals::Series& s : log::read(w / "run/log.mcap").series) {
    const std::string& name = s.topic.name;
    EXPECT_TRUE(name.starts_with("/sensor/") || name == "/joint/lever/angle" ||
                name.starts_with("/valve/"))
        << name;
    EXPECT_FALSE(s.time_ns.empty()) << name;
  }
  EXPECT_EQ(w.sinew({"replay", "run"}).code, 0);
}

TEST(Run, TellsInItsLogWhatWasRun) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  const auto pairs = log::read_metadata(w / "run/log.mcap");
  const auto value = [&](const std::string& key) {
    for (const auto& [name, text] : pairs)
      if (name == key) return text;
    return std::string();
  };
  EXPECT_EQ(value("experiment"), "one-joint");
  EXPECT_EQ(value("seed"), "1");
  EXPECT_EQ(value("resolved"), read_text(w / "run/resolved.toml"));
  EXPECT_THAT(value("version"), StartsWith("0."));
}

// --- analyze ---

TEST(Analyze, GivesTheRunsOwnSummaryFromItsLog) {
  const Workspace w;
  for (const std::string& experiment :
       {walk, bench, std::string("experiments/joint-limits.toml")}) {
    ASSERT_EQ(w.sinew({"run", experiment, "-o", "run", "--force"}).code, 0);
    const Result result = w.sinew({"analyze", "run", "--json", "-o", "again.json", "--force"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(summary(result.out), summary(read_text(w / "run/summary.json"))) << experiment;
    EXPECT_EQ(result.out, read_text(w / "again.json"));
  }
}

TEST(Analyze, PrintsTheTableOfTheRun) {
  const Workspace w;
  const Result run = w.sinew({"run", walk, "-o", "run"});
  const Result analysis = w.sinew({"analyze", "run"});
  EXPECT_EQ(analysis.code, 0);
  EXPECT_THAT(run.out, StartsWith(analysis.out));
}

// A log that was cut in the middle: its first half.
void cut(const fs::path& log) { fs::resize_file(log, fs::file_size(log) / 2); }

TEST(CutLog, IsUsedAsFarAsItGoesWithAWarning) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "run"}).code, 0);
  cut(w / "run/log.mcap");
  const signals::Table table = log::read(w / "run/log.mcap");
  ASSERT_FALSE(table.complete);
  EXPECT_GT(table.column("/joint/hip/angle")->size(), 300u);

  const Result analysis = w.sinew({"analyze", "run", "--json"});
  EXPECT_EQ(analysis.code, 0);
  EXPECT_THAT(analysis.err, HasSubstr("warning: run/log.mcap was cut off"));
  const double distance = Json::parse(analysis.out)["trolley"]["distance_m"];
  EXPECT_GT(distance, 0.1);
  EXPECT_LT(distance, 1.2);
  EXPECT_EQ(Json::parse(analysis.out)["cut_off"], true);

  // Only whole walks are reported.
  const Result told = w.sinew({"analyze", "run"});
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.out, AllOf(HasSubstr("trolley.distance"), Not(HasSubstr("differs")),
                              Not(HasSubstr("agrees"))));
  EXPECT_EQ(Json::parse(w.sinew({"analyze", "run", "--verdicts"}).out), Json::array());

  const Result check = w.sinew({"check", "run"});
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.out, HasSubstr("was cut off"));

  const Result replay = w.sinew({"replay", "run"});
  EXPECT_EQ(replay.code, 0) << replay.out;
  EXPECT_THAT(replay.out, HasSubstr("all equal"));
}

TEST(CutLog, ThatIsNoLogAtAllIsRefused) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  write_text(w / "run/log.mcap", "not a log");
  for (const char* command : {"analyze", "replay", "check"}) {
    const Result result = w.sinew({command, "run"});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err + result.out, HasSubstr("run/log.mcap: "));
  }
  fs::remove(w / "run/log.mcap");
  const Result none = w.sinew({"analyze", "run"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("run: found no log.mcap"));
}

// --- export ---

TEST(Export, HeadsEveryColumnWithNameAndUnit) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  ASSERT_EQ(w.sinew({"export", "run", "--csv", "-o", "lever.csv", "--channels", "/joint/*",
                     "/true/muscle/*/pressure"})
                .code,
            0);
  std::istringstream csv(read_text(w / "lever.csv"));
  std::string header, row;
  std::getline(csv, header);
  EXPECT_EQ(header,
            "time [s],/joint/lever/angle [rad],/joint/lever/stiffness [N m/rad],"
            "/joint/lever/velocity_estimate [rad/s],"
            "/true/muscle/flexor/pressure [Pa],/true/muscle/extensor/pressure [Pa]");
  std::getline(csv, row);
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), 5);

  const Result again = w.sinew({"export", "run", "--csv", "-o", "lever.csv"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, StartsWith("lever.csv: found a file"));
  EXPECT_EQ(w.sinew({"export", "run", "--csv", "-o", "lever.csv", "--force"}).code, 0);
}

TEST(Export, AddsWhatIsDerived) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "run"}).code, 0);
  const Result plain = w.sinew({"export", "run", "--csv"});
  const Result derived = w.sinew({"export", "run", "--csv", "--derived"});
  ASSERT_EQ(derived.code, 0) << derived.err;
  EXPECT_THAT(plain.out.substr(0, plain.out.find('\n')),
              ::testing::Not(HasSubstr(",/foot/force.x [N]")));
  EXPECT_THAT(derived.out.substr(0, derived.out.find('\n')), HasSubstr(",/foot/force.x [N]"));
}

// --- replay ---

TEST(Replay, DecidesTheRecordedEdges) {
  const Workspace w;
  for (const std::string& experiment : {walk, bench}) {
    ASSERT_EQ(w.sinew({"run", experiment, "-o", "run", "--force"}).code, 0);
    const Result result = w.sinew({"replay", "run", "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    const Json said = Json::parse(result.out);
    EXPECT_EQ(said["equal"], true);
    EXPECT_GT(said["recorded_edges"], 1000);
    EXPECT_EQ(said["recorded_edges"], said["replayed_edges"]);
  }
}

TEST(Replay, NamesTheFirstEdgeThatDiffers) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  const std::string resolved = read_text(w / "run/resolved.toml");
  ASSERT_EQ(
      w.sinew({"run", bench, "-o", "other", "--set", "joint.lever.angle_gain=0.1 %/count"}).code,
      0);
  const Result result = w.sinew({"replay", "run", "--machine", "other/resolved.toml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.out, HasSubstr("first difference at "));
}

}  // namespace
}  // namespace sinew::test::run_test
