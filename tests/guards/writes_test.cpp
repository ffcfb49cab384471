// The n-th call that writes fails, for n = 1, 2, 3 … until the command makes fewer calls:
// each time the command reports it and ends with 1, and afterwards there is the old result or,
// where only the final flush to the disk failed, the new one.
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>

#include "tests/guards/writers.h"
#include "tests/places.h"

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Did the call number n fail? Also the command's exit.
bool failed(const Workspace& w, const Writer& writer, int n, Ended& end) {
  const std::string told = (w / "told").string();
  fs::remove(told);
  end = run(w, writer.fresh, [&] {
    setenv("LD_PRELOAD", (test::build_dir() + "/tests/sinew_fail_write.so").c_str(), 1);
    setenv("SINEW_FAIL_WRITE", std::to_string(n).c_str(), 1);
    setenv("SINEW_FAIL_TOLD", told.c_str(), 1);
  });
  return fs::exists(told);
}

// One of them after the other in ./check long; here fewer and fewer.
int next(int n, bool all) { return all || n < 4 ? n + 1 : n + n / 3; }

TEST(Writes, ThatFailAreReportedAndLoseNothing) {
  const Workspace w;
  ASSERT_NO_FATAL_FAILURE(prepare(w));
  const bool all = std::getenv("SINEW_GUARD_COUNT") != nullptr;
  int total = 0;
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    int failures = 0;
    Ended end;
    for (int n = 1; n < 5000 && failed(w, writer, n, end); n = next(n, all), ++failures) {
      EXPECT_EQ(end.code, 1) << writer.name << ", call " << n;
      EXPECT_THAT(end.output, HasSubstr(writer.target)) << writer.name << ", call " << n;
      EXPECT_THAT(end.output, HasSubstr("No space left on device")) << writer.name << n;
      // The next command completes an unfinished replacement, also where that is all it does.
      Words look = writer.fresh;
      std::erase(look, "--force");
      if (writer.is_folder()) run(w, writer.is_run() ? Words{"analyze", writer.target} : look);
      EXPECT_EQ(neither(state(w / writer.target), results), "") << writer.name << ", call " << n;
      put_back(w, writer);
    }
    EXPECT_EQ(end.code, 0) << writer.name << end.output;
    EXPECT_EQ(difference(state(w / writer.target), results.fresh), "") << writer.name;
    EXPECT_GE(failures, 3) << writer.name << " does not even write, sync and rename";
    total += failures;
  }
  std::printf("guard: %d calls that write failed in turn, each was told of, nothing was lost\n",
              total);
}

// A row that could not be written to a study's file is run again; no written row is lost.
void lose_no_row(const Workspace& w, const Words& alone, const std::string& result, int least) {
  Words words = alone;
  words.insert(words.end(), {"--results", "s.db"});
  const Writer writer{.name = "study", .old = {}, .fresh = words, .refused = {}, .target = "s.db"};
  const bool all = std::getenv("SINEW_GUARD_COUNT") != nullptr;
  int failures = 0, told = 0;
  Ended end;
  for (int n = 1; n < 500 && failed(w, writer, n, end); n = next(n, all), ++failures) {
    SCOPED_TRACE("call " + std::to_string(n));
    // At the very end, when all rows are there, SQLite postpones writes that fail.
    EXPECT_THAT(end.code, ::testing::AnyOf(0, 1)) << end.output;
    told += end.code;
    EXPECT_TRUE(end.code == 0 || end.output.find("s.db: cannot be") != std::string::npos)
        << end.output;
    const Result again = w.sinew(words);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.out, result);
    for (const char* part : {"s.db", "s.db-wal", "s.db-shm"}) fs::remove(w / part);
  }
  EXPECT_GE(told, least);
  std::printf("guard: %d calls that write a %s failed in turn, %d were told of, no row was lost\n",
              failures, alone.front() == "tune" ? "tuning" : "study", told);
}

TEST(Writes, ThatFailOfAStudyLoseNoRow) {
  const Workspace w;
  const Words sweep = {
      "sweep", "experiments/one-joint.toml", "--seeds", "3", "--report", "duration_s", "--quiet"};
  lose_no_row(w, sweep, w.sinew(sweep).out, 3);
}

TEST(Writes, ThatFailOfATuningLoseNoRow) {
  const Workspace w;
  write_text(w / "t.toml",
             "format = \"sinew.tuning/1\"\ntitle = \"a lever\"\n"
             "experiment = \"experiments/one-joint.toml\"\n"
             "tune = [\"joint.lever.angle_gain=0.05:0.2 %/count\"]\n"
             "minimize = [\"air_used_kg\"]\npopulation = 5\ngenerations = 2\n");
  const Words tune = {"tune", "t.toml", "--quiet", "--threads", "1"};
  Words apart = tune;
  apart.insert(apart.end(), {"--results", "apart.db"});
  lose_no_row(w, tune, w.sinew(apart).out, 3);
}

}  // namespace
}  // namespace sinew::test
