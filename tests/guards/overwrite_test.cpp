// The target of a command contains the old result or the new one, complete, after any disturbance.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdio>
#include <thread>

#include "sinew/log/reader.h"
#include "tests/guards/writers.h"

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// One workspace for all of them: its robots and runs are only read.
class Overwrite : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_NO_FATAL_FAILURE(prepare(w)); }
  Workspace w;
};

std::vector<std::string> all_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(fs::relative(entry.path(), folder).string());
  std::ranges::sort(names);
  return names;
}

TEST_F(Overwrite, WhatIsRefusedTouchesNothing) {
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    const auto names = all_names(w / "out");
    const Ended refused = run(w, writer.refused);
    EXPECT_THAT(refused.code, AnyOf(1, 2)) << writer.name << refused.output;
    EXPECT_EQ(difference(state(w / writer.target), results.old), "") << writer.name;
    EXPECT_EQ(all_names(w / "out"), names) << writer.name;
  }
}

TEST_F(Overwrite, WhatIsDoneLeavesTheNewAndNothingBeside) {
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    const auto names = all_names(w / "out");
    EXPECT_EQ(run(w, writer.fresh).code, 0) << writer.name;
    EXPECT_EQ(difference(state(w / writer.target), results.fresh), "") << writer.name;
    EXPECT_EQ(all_names(w / "out"), names) << writer.name;
  }
}

// The limit on the size of files simulates a disk that is full at some byte.
TEST_F(Overwrite, AFullDiskLeavesTheOld) {
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    std::size_t largest = 0;
    for (const auto& [name, text] : results.fresh) largest = std::max(largest, text.size());
    for (const double share : {0.0, 0.1, 0.9}) {
      const rlimit limit{static_cast<rlim_t>(share * static_cast<double>(largest)), RLIM_INFINITY};
      const Ended full = run(w, writer.fresh, [&] { setrlimit(RLIMIT_FSIZE, &limit); });
      EXPECT_EQ(full.code, 1) << writer.name << " with " << limit.rlim_cur << " bytes";
      EXPECT_THAT(full.output, AllOf(HasSubstr(writer.target), HasSubstr("File too large")));
      EXPECT_EQ(difference(state(w / writer.target), results.old), "") << writer.name;
      put_back(w, writer);
    }
  }
}

TEST_F(Overwrite, AFaultLeavesTheOldRunAndReportsWhereTheNewOneIs) {
  const Writer writer = writers(w).front();
  const Results results = both(w, writer);
  const Ended fault = run(w, {"run", "experiments/walk-test-1.toml", "-o", writer.target, "--force",
                              "--set", "muscle.knee_extensor.bladder_stiffness=1e8 N/m"});
  EXPECT_EQ(fault.code, 1);
  EXPECT_THAT(fault.output, AllOf(HasSubstr("the run was ended: "),
                                  HasSubstr("out/run: holds what was there before"),
                                  HasSubstr("out/run/unfinished")));
  EXPECT_EQ(difference(state(w / writer.target), results.old), "");
  EXPECT_FALSE(log::read(w / "out/run/unfinished/log.mcap").series.empty());

  // The next command takes its place.
  EXPECT_EQ(run(w, writer.fresh).code, 0);
  EXPECT_EQ(difference(state(w / writer.target), results.fresh), "");
  EXPECT_FALSE(fs::exists(w / "out/run/unfinished"));
}

TEST_F(Overwrite, WhatIsNotOursStays) {
  const Writer writer = writers(w).front();
  const Results results = both(w, writer);
  write_text(w / "out/run/notes.txt", "mine");
  fs::create_directory(w / "out/run/more");
  write_text(w / "out/run/more/log.mcap", "mine too");
  EXPECT_EQ(run(w, writer.fresh).code, 0);
  State mine = results.fresh;
  mine["notes.txt"] = "mine";
  mine["more/log.mcap"] = "mine too";
  EXPECT_EQ(difference(state(w / writer.target), mine), "");

  fs::create_directory(w / "out/run/unfinished");
  write_text(w / "out/run/unfinished/notes.txt", "mine");
  const Ended refused = run(w, writer.fresh);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.output, HasSubstr("out/run/unfinished: found notes.txt"));
  EXPECT_EQ(read_text(w / "out/run/unfinished/notes.txt"), "mine");
}

TEST_F(Overwrite, ASymbolicLinkStaysAndWhatItLeadsToIsReplaced) {
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    fs::remove_all(w / "elsewhere");
    fs::create_directory(w / "elsewhere");
    fs::rename(w / writer.target, w / "elsewhere/real");
    fs::create_symlink("../elsewhere/real", w / writer.target);
    EXPECT_EQ(run(w, writer.fresh).code, 0) << writer.name;
    EXPECT_TRUE(fs::is_symlink(w / writer.target)) << writer.name;
    EXPECT_EQ(difference(state(w / "elsewhere/real"), results.fresh), "") << writer.name;
    EXPECT_THAT(names_in(w / "elsewhere"), ::testing::ElementsAre("real")) << writer.name;
    fs::remove(w / writer.target);
  }
}

TEST_F(Overwrite, ModesStay) {
  for (const Writer& writer : writers(w)) {
    if (writer.is_folder()) continue;
    const Results results = both(w, writer);
    fs::permissions(w / writer.target, fs::perms(0640));
    EXPECT_EQ(run(w, writer.fresh).code, 0) << writer.name;
    EXPECT_EQ(fs::status(w / writer.target).permissions(), fs::perms(0640)) << writer.name;
  }
}

TEST_F(Overwrite, PipesAndStdoutAreWrittenDirectly) {
  for (const Writer& writer : writers(w)) {
    if (writer.is_folder()) continue;
    const Results results = both(w, writer);
    fs::remove(w / writer.target);
    ASSERT_EQ(mkfifo((w / writer.target).c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] { read = read_text(w / writer.target); });
    Words words = writer.fresh;
    std::erase(words, "--force");  // there is nothing to replace
    const Ended piped = run(w, words);
    if (piped.code != 0) close(open((w / writer.target).c_str(), O_WRONLY | O_NONBLOCK));
    reader.join();
    EXPECT_EQ(piped.code, 0) << writer.name << piped.output;
    EXPECT_TRUE(read == results.fresh.at("")) << writer.name;
    EXPECT_TRUE(fs::is_fifo(w / writer.target)) << writer.name;
    fs::remove(w / writer.target);

    std::ranges::replace(words, writer.target, std::string("/dev/stdout"));
    const Ended out = run(w, words);
    EXPECT_EQ(out.code, 0) << writer.name;
    EXPECT_THAT(out.output, HasSubstr(results.fresh.at(""))) << writer.name;

    // Also where the shell made a file of it, and continues with it.
    const Ended file = run(w, words, [&] {
      const int fd = open("appended", O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dprintf(fd, "before\n");
      dup2(fd, STDOUT_FILENO);
    });
    EXPECT_EQ(file.code, 0) << writer.name << file.output;
    EXPECT_THAT(read_text(w / "appended"),
                AllOf(::testing::StartsWith("before\n"), HasSubstr(results.fresh.at(""))))
        << writer.name;
  }
}

// Both at once: one of them reports the other, or both are done one after the other.
TEST_F(Overwrite, TwoAtOnceLeaveOneOfTheTwoWhole) {
  int pairs = 0;
  for (const Writer& writer : writers(w)) {
    const Results results = both(w, writer);
    for (int i = 0; i < tries(2); ++i, ++pairs) {
      const Started first = start(w, writer.old), second = start(w, writer.fresh);
      for (const Ended& end : {ended(first), ended(second)}) {
        if (end.code == 0) continue;
        EXPECT_EQ(end.code, 1) << writer.name;
        EXPECT_THAT(end.output, ::testing::ContainsRegex("process [0-9]+")) << writer.name;
      }
      EXPECT_EQ(neither(state(w / writer.target), results), "") << writer.name;
    }
  }
  std::printf(
      "guard: %zu commands refused, cut short by a full disk, through links and pipes; %d "
      "times two at once\n",
      writers(w).size(), pairs);
}

// Half a walk in place of a whole one, as if the robot had stopped there.
TEST_F(Overwrite, AFolderInUseIsRefusedWithItsProcess) {
  const Words walk = {"run", "experiments/walk-test-1.toml", "-o", "walk", "--no-report"};
  Words slow = walk;
  slow.insert(slow.end(), {"--pace", "1"});
  const Started first = start(w, slow);
  for (int i = 0; i < 1000 && !fs::exists(w / "walk/log.mcap"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  Words force = walk;
  force.emplace_back("--force");
  const Ended second = run(w, force);
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.output, AllOf(HasSubstr("walk: found process " + std::to_string(first.pid)),
                                   HasSubstr("which is writing there")));
  kill(first.pid, SIGKILL);
  ended(first);

  // The lock ended with its process.
  EXPECT_EQ(run(w, force).code, 0);
  EXPECT_TRUE(log::read(w / "walk/log.mcap").complete);
}

}  // namespace
}  // namespace sinew::test
