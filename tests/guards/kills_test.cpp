// Killed, terminated or interrupted at any moment: afterwards there is the old result or the new
// one, complete, or a log that reads as cut off; and the next run of the same command works.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "sinew/log/reader.h"
#include "tests/guards/writers.h"

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using Clock = std::chrono::steady_clock;

double seconds_of(const Workspace& w, const Words& words) {
  const auto begin = Clock::now();
  run(w, words);
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// An incomplete log: nothing yet, or messages up to some time.
void expect_readable(const fs::path& log) {
  if (!fs::exists(log)) return;
  try {
    (void)log::read(log);
  } catch (const log::Error& e) {
    EXPECT_THAT(e.what(), AnyOf(::testing::HasSubstr("the log ends after"),
                                ::testing::HasSubstr("the file is empty")));
  }
}

class Kills : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(prepare(w));
    for (Writer& writer : writers(w))
      if (writer.name != "figures" && writer.name != "stand") all.push_back(std::move(writer));
    for (const Writer& writer : all) {
      results.push_back(both(w, writer));
      fs::rename(w / "kept", w / ("kept " + writer.name));
      duration.push_back(seconds_of(w, writer.fresh));
    }
  }

  // Starts from the old result, or from nothing.
  void begin(const Writer& writer, bool old) {
    fs::remove_all(w / "out");
    fs::create_directory(w / "out");
    if (old) fs::copy(w / ("kept " + writer.name), w / writer.target, fs::copy_options::recursive);
  }

  void expect_whole(const Writer& writer, const Results& r, bool old) {
    const fs::path target = w / writer.target;
    if (writer.is_run()) {
      expect_readable(target / "unfinished/log.mcap");
      expect_readable(target / "log.mcap");
      // The next reader completes an unfinished replacement; without a log yet it reports that.
      run(w, {"analyze", writer.target});
    }
    if (!old && writer.is_run()) return;
    EXPECT_EQ(neither(state(target), {old ? r.old : State(), r.fresh}), "") << writer.name;
  }

  void expect_nothing_in_the_way(const Writer& writer, const Results& r) {
    const fs::path rows = w / (writer.target + ".part");  // of a sweep, which are not thrown away
    if (fs::exists(rows)) {
      const Ended refused = run(w, writer.fresh);
      EXPECT_EQ(refused.code, 1);
      EXPECT_THAT(refused.output, ::testing::HasSubstr(".part: stands already"));
      fs::remove(rows);
    }
    const Ended again = run(w, writer.fresh);
    EXPECT_EQ(again.code, 0) << writer.name << again.output;
    EXPECT_EQ(difference(state(w / writer.target), r.fresh), "") << writer.name;
    EXPECT_THAT(names_in(w / "out"), ::testing::SizeIs(1)) << writer.name;
    EXPECT_FALSE(fs::exists(w / writer.target / "unfinished")) << writer.name;
    EXPECT_FALSE(fs::exists(w / writer.target / ".finished")) << writer.name;
  }

  Workspace w;
  std::vector<Writer> all;
  std::vector<Results> results;
  std::vector<double> duration;
};

TEST_F(Kills, LeaveTheOldOrTheNewAndNothingInTheWay) {
  std::mt19937 random(8);
  int signalled = 0;
  for (int i = 0; i < tries(50); ++i) {
    const std::size_t k = random() % all.size();
    const int signal = std::array{SIGKILL, SIGTERM, SIGINT}[random() % 3];
    const bool old = random() % 4 != 0;
    const double after = duration[k] * std::uniform_real_distribution(0.0, 1.1)(random);
    SCOPED_TRACE(all[k].name + ", signal " + std::to_string(signal) + " after " +
                 std::to_string(after) + " s, " + (old ? "over an old one" : "the first"));
    begin(all[k], old);
    const Started process = start(w, all[k].fresh);
    std::this_thread::sleep_for(std::chrono::duration<double>(after));
    kill(process.pid, signal);
    const Ended end = ended(process);
    signalled += end.code != 0;
    EXPECT_THAT(end.code, AnyOf(0, 1, -1)) << end.output;
    expect_whole(all[k], results[k], old);
    expect_nothing_in_the_way(all[k], results[k]);
  }
  EXPECT_GT(signalled, tries(50) / 4) << "most were over before their signal came";
  std::printf("guard: %d kills of %zu commands, %d in time; old or new stood whole after each\n",
              tries(50), all.size(), signalled);
}

// The moment when the new files replace the old ones, which is too short to be hit by chance: the
// state that a process leaves there when it is killed between any two of its steps.
TEST_F(Kills, BetweenTwoRenamesIsFinishedByWhoeverComesNext) {
  const Writer& writer = all.front();
  ASSERT_EQ(writer.name, "run");
  const std::vector<std::string> names = {"log.mcap", "resolved.toml", "summary.json"};
  begin(writer, false);
  ASSERT_EQ(run(w, writer.fresh).code, 0);
  fs::rename(w / writer.target, w / "new");
  for (std::size_t done = 0; done <= names.size(); ++done) {
    for (const bool reader : {true, false}) {
      begin(writer, true);
      write_text(w / writer.target / "report.html", "of the old run");
      fs::copy(w / "new", w / writer.target / ".finished");
      write_text(w / writer.target / ".finished/.replaced", "report.html\n../../one/log.mcap\n");
      for (std::size_t i = 0; i < done; ++i)
        fs::rename(w / writer.target / ".finished" / names[i], w / writer.target / names[i]);
      if (reader) {
        const Ended read = run(w, {"analyze", writer.target});
        EXPECT_EQ(read.code, 0) << read.output;
        EXPECT_EQ(difference(state(w / writer.target), results[0].fresh), "") << done;
      }
      expect_nothing_in_the_way(writer, results[0]);
      EXPECT_TRUE(fs::exists(w / "one/log.mcap")) << "removed outside of the folder";
    }
  }
}

// A run that is interrupted prints where its log is, which reads as cut off.
TEST_F(Kills, AnInterruptedRunLeavesItsLog) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const bool old : {true, false}) {
      begin(all.front(), old);
      Words words = all.front().fresh;
      words.insert(words.end(), {"--pace", "1"});
      const Started process = start(w, words);
      const std::string log = all.front().target + (old ? "/unfinished/log.mcap" : "/log.mcap");
      const auto length = [&] {
        std::error_code none;
        return fs::file_size(w / log, none);
      };
      for (int i = 0; i < 1000 && (!fs::exists(w / log) || length() < 100000); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      kill(process.pid, signal);
      const Ended end = ended(process);
      EXPECT_EQ(end.code, 1) << end.output;
      EXPECT_THAT(end.output,
                  ::testing::AllOf(::testing::HasSubstr("interrupted at "),
                                   ::testing::HasSubstr("reads as cut off, is " + log)));
      const signals::Table table = log::read(w / log);
      EXPECT_FALSE(table.complete);
      EXPECT_GT(table.series.front().time_ns.size(), 5u);
      if (old) {
        EXPECT_EQ(difference(state(w / all.front().target), results[0].old), "");
      }
      EXPECT_EQ(run(w, {"analyze", fs::path(log).parent_path().string()}).code, 0);
    }
  }
}

}  // namespace
}  // namespace sinew::test
