// `sweep`: a table on stdout or in a file.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"

namespace sinew::test::sweep_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::string bench = "experiments/one-joint.toml";

TEST(Sweep, IsATableOnStdout) {
  const Workspace w;
  const Result r = w.sinew({"sweep", bench, "--vary", "phase.up.duration=1,2 s", "--seeds", "2",
                            "--report", "duration_s,sequence_duration_s [ms]"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, StartsWith("phase.up.duration [s],seed,duration [s],sequence_duration [ms],"
                                "status\n1,1,"));
  EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 5);
  EXPECT_THAT(r.err, IsEmpty());
}

// The best speed of a sweep is none where the track ends: the row says so.
TEST(Sweep, ARowSaysThatTheTrackEnded) {
  const Workspace w;
  const Result r =
      w.sinew({"sweep", "experiments/walk-test-1.toml", "--vary", "trolley.track_length=20,100 in",
               "--report", "trolley.mean_speed_m_per_s [in/s]", "--threads", "1"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("\n20,"),
                           HasSubstr(",reaches the end of the track; differs in "
                                     "trolley.mean_speed_m_per_s\n100,"),
                           EndsWith(",ok\n")));
  EXPECT_THAT(r.err, HasSubstr("in 1 of 2 rows the trolley reaches the end of its track"));
}

TEST(Sweep, IsTheSameInAFileAsJsonAndWithMoreThreads) {
  const Workspace w;
  const Words words = {"sweep", bench, "--seeds", "5", "--report", "joints.lever.tracking_rms_rad"};
  const auto with = [&](Words more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return w.sinew(all);
  };
  const Result one = with({"--threads", "1"});
  EXPECT_EQ(with({"--threads", "2"}).out, one.out);
  EXPECT_EQ(with({"-o", "t.csv"}).err, "t.csv\n");
  EXPECT_EQ(read_text(w / "t.csv"), one.out);

  const Json json = Json::parse(with({"--json"}).out);
  ASSERT_EQ(json["rows"].size(), 5U);
  EXPECT_EQ(json["rows"][4]["seed"], 5);
  EXPECT_EQ(json["rows"][4]["status"], "ok");
  EXPECT_TRUE(json["rows"][4]["joints.lever.tracking_rms [rad]"].is_number());

  const Result again = with({"-o", "t.csv"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_EQ(with({"-o", "t.csv", "--force"}).code, 0);
}

TEST(Sweep, ThatIsRefusedLeavesNothing) {
  const Workspace w;
  const Result r = w.sinew({"sweep", bench, "--report", "durations_s", "-o", "t.csv"});
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(r.out, "");
  EXPECT_THAT(r.err, HasSubstr("try \"duration_s\""));
  EXPECT_FALSE(fs::exists(w / "t.csv"));
  EXPECT_EQ(w.sinew({"sweep", bench, "--threads", "0"}).code, 2);
}

// A key that no summary has is no empty column of runs that are fine.
TEST(Sweep, OfAKeyThatNoRunHasFails) {
  const Workspace w;
  const Result r = w.sinew({"sweep", bench, "--seeds", "2", "--report", "duration_s,no.such_m"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.out, HasSubstr(",without no.such_m\n"));
  EXPECT_THAT(r.err, AllOf(HasSubstr("2 of 2 rows lack a figure"),
                           HasSubstr("no.such_m: found no run with it")));
}

// It does not take the place of a good one, and its rows are kept beside.
TEST(Sweep, WithoutFiguresReplacesNoTable) {
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--report", "duration_s,no.such_m"}, "no.such_m: found no run with it"},
      {{"--report", "duration_s", "--vary", "joint.lever.angle_gain=-1,-2 %/count"},
       "no row has figures"}};
  for (const auto& [words, said] : cases) {
    const Workspace w;
    write_text(w / "t.csv", "an older table\n");
    Words all = {"sweep", bench, "-o", "t.csv", "--force"};
    all.insert(all.end(), words.begin(), words.end());
    const Result r = w.sinew(all);
    EXPECT_EQ(r.code, 1);
    EXPECT_THAT(r.err, AllOf(HasSubstr(said), HasSubstr("t.csv.part: holds the rows")));
    EXPECT_EQ(read_text(w / "t.csv"), "an older table\n");
    const std::string rows = read_text(w / "t.csv.part");
    EXPECT_THAT(rows, HasSubstr("duration [s]"));

    const Result again = w.sinew(all);
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, HasSubstr("t.csv.part: stands already"));
    EXPECT_EQ(read_text(w / "t.csv.part"), rows);
  }
}

TEST(Sweep, RefusesAWholeNumberThatIsNone) {
  const Workspace w;
  const Result r = w.sinew({"sweep", bench, "--vary", "seed=1,9223372036854775808"});
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.out, "");
  EXPECT_THAT(r.err, AllOf(HasSubstr("seed: found 9"), HasSubstr("expected 0 to 2147483647")));
}

// Beside the table that it would have become, which stands as it was.
TEST(Sweep, InterruptedKeepsWhatIsDone) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Workspace w;
    write_text(w / "t.csv", "an older table\n");
    const pid_t pid =
        w.start({"sweep", bench, "--seeds", "10000", "-o", "t.csv", "--force", "--quiet"});
    for (int i = 0; i < 1000 && !fs::exists(w / "t.csv.part"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(pid, signal);
    int status = 0;
    waitpid(pid, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << "it should end by itself at signal " << signal;
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_text(w / "err"), HasSubstr("kept in t.csv.part"));
    EXPECT_EQ(read_text(w / "t.csv"), "an older table\n");
    const std::string text = read_text(w / "t.csv.part");
    EXPECT_THAT(text, AllOf(StartsWith("seed,status\n1,ok\n"), EndsWith(",ok\n")));
  }
}

TEST(Sweep, OfMoreThanMemoryHoldsIsRefused) {
  const Workspace w;
  const Result r =
      w.sinew({"sweep", bench, "--vary", "joint.lever.angle_gain=0.01:0.1:1000 %/count", "--vary",
               "seed=1:1000:1000", "--vary", "phase.up.duration=1:2:1000 s", "-o", "t.csv"});
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("found 1000 x 1000 x 1000 = 1e+09 points"),
                           HasSubstr("expected at most 1000000"), HasSubstr("try fewer values")));
  EXPECT_FALSE(fs::exists(w / "t.csv"));
}

TEST(Sweep, RunsAPlan) {
  const Workspace w;
  write_text(w / "plan.toml", "format = \"sinew.plan/1\"\ntitle = \"noise\"\nexperiment = \"" +
                                  bench + "\"\nseeds = 2\nreport = [\"duration_s\"]\n");
  EXPECT_EQ(w.sinew({"sweep", "plan.toml"}).out,
            w.sinew({"sweep", bench, "--seeds", "2", "--report", "duration_s"}).out);
  EXPECT_EQ(w.sinew({"check", "plan.toml"}).code, 0);
}

// The plans can run, and the quickest one's published table is what today's leg gives.
TEST(Studies, AreInOrderAndOfToday) {
  const Workspace w;
  const fs::path source = SINEW_SOURCE_DIR;
  int plans = 0;
  for (const auto& entry : fs::directory_iterator(source / "studies")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_EQ(w.sinew({"check", entry.path().string()}).code, 0) << entry.path();
    const bool tuned = read_text(entry.path()).find("\"sinew.tuning/1\"") != std::string::npos;
    const fs::path name = entry.path().stem();
    const fs::path result = source / (tuned ? "experiments/tuned" : "docs/studies") /
                            (name.string() + (tuned ? ".toml" : ".csv"));
    EXPECT_TRUE(fs::exists(result)) << result;
    ++plans;
  }
  EXPECT_GE(plans, 10);
  const std::string range = "range-stiffness";
  EXPECT_EQ(w.sinew({"sweep", (source / "studies" / (range + ".toml")).string()}).out,
            read_text(source / "docs/studies" / (range + ".csv")));
}

}  // namespace
}  // namespace sinew::test::sweep_test
