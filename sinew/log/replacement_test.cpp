// The older file remains until the new one is complete.
#include "sinew/log/replacement.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sinew/log/file.h"
#include "sinew/log/fixtures_test.h"
#include "sinew/log/reader.h"
#include "sinew/log/writer.h"

namespace sinew::log::replacement_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Replacement, IsThereWhenItIsCommitted) {
  const Folder folder;
  put_bytes(folder / "a.csv", "old");
  {
    Replacement file(folder / "a.csv");
    file.write("ne");
    EXPECT_EQ(bytes_of(folder / "a.csv"), "old");
    EXPECT_EQ(bytes_of(file.part()), "ne") << "every call reaches the file at once";
    file.write("w");
    file.commit();
    EXPECT_EQ(bytes_of(folder / "a.csv"), "new");
  }
  EXPECT_FALSE(fs::exists(folder / ".a.csv.sinew"));
}

TEST(Replacement, LeavesTheOldOneWithoutACommit) {
  const Folder folder;
  put_bytes(folder / "a.csv", "old");
  { Replacement(folder / "a.csv").write("new"); }
  EXPECT_EQ(bytes_of(folder / "a.csv"), "old");
  EXPECT_FALSE(fs::exists(folder / ".a.csv.sinew"));
  constexpr auto now = Replacement::Sync::now;
  { Replacement(folder / "a.csv", now, Replacement::Part::kept).write("rows"); }
  EXPECT_EQ(bytes_of(folder / "a.csv"), "old");
  EXPECT_EQ(bytes_of(folder / "a.csv.part"), "rows");

  // A kept part is not lost to the next one, and does not block a hidden one.
  EXPECT_THAT(error_of([&] { Replacement(folder / "a.csv", now, Replacement::Part::kept); }),
              AllOf(HasSubstr("a.csv.part: stands already"), HasSubstr("move it elsewhere")));
  put_bytes(folder / ".a.csv.sinew", "of one that was killed");
  Replacement again(folder / "a.csv");
  again.write("new");
  again.commit();
  EXPECT_EQ(bytes_of(folder / "a.csv"), "new");
  EXPECT_EQ(bytes_of(folder / "a.csv.part"), "rows");
  EXPECT_FALSE(fs::exists(folder / ".a.csv.sinew"));
}

TEST(Replacement, FollowsALinkAlsoToNothing) {
  const Folder folder;
  fs::create_directory(folder / "far");
  fs::create_symlink("far/real.csv", folder / "a.csv");
  for (const char* text : {"first", "second"}) {
    Replacement file(folder / "a.csv");
    file.write(text);
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "a.csv"));
    EXPECT_EQ(bytes_of(folder / "far/real.csv"), text);
  }
}

TEST(Replacement, KeepsTheModeOfTheOldOne) {
  const Folder folder;
  put_bytes(folder / "a.csv", "old");
  fs::permissions(folder / "a.csv", fs::perms(0604));
  Replacement file(folder / "a.csv");
  file.commit();
  EXPECT_EQ(fs::status(folder / "a.csv").permissions(), fs::perms(0604));
}

TEST(Replacement, IsOneWritersAtATime) {
  const Folder folder;
  Replacement first(folder / "a.csv");
  EXPECT_THAT(error_of([&] { Replacement(folder / "a.csv"); }),
              AllOf(HasSubstr("a.csv: process " + std::to_string(::getpid()) + " is writing it"),
                    HasSubstr("wait for it")));
  first.write("first");
  first.commit();
  Replacement second(folder / "a.csv");
  second.write("second");
  second.commit();
  EXPECT_EQ(bytes_of(folder / "a.csv"), "second");
}

TEST(Replacement, ReportsWhatItCannotWrite) {
  const Folder folder;
  EXPECT_THAT(error_of([&] { Replacement(folder / "no" / "a.csv"); }),
              AllOf(HasSubstr("no/a.csv: cannot be written: No such file or directory"),
                    HasSubstr("choose a folder")));
  EXPECT_TRUE(is_written_directly("/dev/null"));
  EXPECT_TRUE(is_written_directly("/dev/stdout"));
  EXPECT_FALSE(is_written_directly(folder / "a.csv"));
  EXPECT_FALSE(is_written_directly(folder.path()));
  EXPECT_THAT(error_of([&] {
                Replacement full("/dev/full");
                full.write("a");
              }),
              HasSubstr("/dev/full: cannot be written: No space left on device"));
}

TEST(Lock, IsFreeWhenItsDescriptorIsClosed) {
  const Folder folder;
  const auto open = [&] { return ::open(folder.path().c_str(), O_RDONLY | O_DIRECTORY); };
  const int first = open(), second = open();
  EXPECT_EQ(lock(first), "");
  EXPECT_EQ(lock(second), "process " + std::to_string(::getpid()));
  ::close(first);
  EXPECT_EQ(lock(second), "");
  ::close(second);
}

// Two logs of one name: the second finds the first at work; if another file has taken the name
// nevertheless, finishing does not change it.
TEST(Lock, OfALogIsItsWriters) {
  const Folder folder;
  const std::vector<signals::Topic> topics = {{"/t", "", {{"x", "N"}}}};
  Writer first(folder / "log.mcap", topics);
  ASSERT_TRUE(first.push(0, 0, std::array{1.0}));
  EXPECT_THAT(
      error_of([&] { Writer(folder / "log.mcap", topics); }),
      AllOf(HasSubstr("log.mcap: cannot create the log: process "), HasSubstr(" is writing it")));
  fs::rename(folder / "log.mcap", folder / "moved.mcap");
  Writer second(folder / "log.mcap", topics);
  ASSERT_TRUE(second.push(0, 0, std::array{2.0}));
  EXPECT_THAT(error_of([&] { first.finish(); }), HasSubstr("another log has taken its place"));
  second.finish();
  EXPECT_EQ(read(folder / "log.mcap").series[0].columns[0][0], 2.0);
  EXPECT_EQ(read(folder / "moved.mcap").series[0].columns[0][0], 1.0);
  EXPECT_TRUE(read(folder / "moved.mcap").complete);
}

}  // namespace
}  // namespace sinew::log::replacement_test
