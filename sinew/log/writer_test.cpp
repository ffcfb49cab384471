#include "sinew/log/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "sinew/log/fixtures_test.h"
#include "sinew/log/reader.h"
#include "tests/counted_heap.h"

namespace sinew::log::writer_test {
namespace {

using namespace testing;
using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

const std::vector<signals::Topic> kForce = {
    {"/true/foot/force", "Force on the foot", {{"x", "N"}, {"y", "N"}}}};

std::int64_t wall_ns() { return steady_clock::now().time_since_epoch().count(); }

TEST(Writer, RoundTripKeepsEveryBit) {
  const Folder folder;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const signals::Table table = random_table(seed, 300);
    write_log(folder / "log.mcap", table, true);
    const signals::Table back = read(folder / "log.mcap");
    EXPECT_TRUE(back.complete);
    expect_same(back, table);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Writer, InfinityBecomesNaN) {
  const Folder folder;
  const double inf = std::numeric_limits<double>::infinity();
  Writer writer(folder / "log.mcap", kForce);
  ASSERT_TRUE(writer.push(0, 0, std::array{inf, -inf}));
  writer.finish();
  const signals::Table table = read(folder / "log.mcap");
  EXPECT_TRUE(std::isnan(table.series[0].columns[0][0]));
  EXPECT_TRUE(std::isnan(table.series[0].columns[1][0]));
}

TEST(Writer, PlainAndIndexedFilesReadEqual) {
  const Folder folder;
  const signals::Table table = random_table(7, 500);
  write_log(folder / "plain.mcap", table, false);
  write_log(folder / "indexed.mcap", table, true);
  const signals::Table plain = read(folder / "plain.mcap");
  EXPECT_FALSE(plain.complete);  // not finished
  expect_same(plain, table);
  expect_same(read(folder / "indexed.mcap"), plain);
  EXPECT_FALSE(std::filesystem::exists(folder / "indexed.mcap.tmp"));
}

TEST(Writer, SameSamplesGiveTheSameFile) {
  const Folder folder;
  const signals::Table table = random_table(8, 500);
  write_log(folder / "a.mcap", table, true);
  write_log(folder / "b.mcap", table, true);
  EXPECT_EQ(bytes_of(folder / "a.mcap"), bytes_of(folder / "b.mcap"));
}

// Metadata of a run that was changed while it ran; the file equals one with it from the start.
TEST(Writer, WhatWasRunMayBeKnownAtTheEnd) {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  const Folder folder;
  const Pairs before = {{"resolved", "a"}}, after = {{"resolved", "another, longer one"}};
  const auto write = [&](const char* name, const Pairs& first, const Pairs& last) {
    Writer writer(folder / name, kForce, first);
    for (int i = 0; i < 100; ++i) writer.push(0, i, std::array{1.0 * i, 2.0});
    writer.finish(last);
  };
  write("changed", before, after);
  write("known", after, {});
  write("kept", before, {});
  EXPECT_EQ(read_metadata(folder / "changed"), after);
  EXPECT_EQ(read_metadata(folder / "kept"), before);
  EXPECT_EQ(bytes_of(folder / "changed"), bytes_of(folder / "known"));
  EXPECT_TRUE(read(folder / "changed").complete);
}

TEST(Writer, ManyChunks) {
  const Folder folder;
  signals::Table table = random_table(9, 0);
  for (signals::Series& s : table.series)
    for (int i = 0; i < 20'000; ++i) {
      s.time_ns.push_back(i * 10'000'000LL);
      for (auto& column : s.columns) column.push_back(i / 7.0);
    }
  write_log(folder / "log.mcap", table, true);
  EXPECT_GT(std::filesystem::file_size(folder / "log.mcap"), 3u << 20);
  const signals::Table back = read(folder / "log.mcap");
  EXPECT_TRUE(back.complete);
  expect_same(back, table);
}

TEST(Writer, PushTakesNoMemory) {
  const Folder folder;
  Writer writer(folder / "log.mcap", kForce, {}, {.ring = 64});
  test::allocations = 0;
  test::counting = true;
  for (int i = 0; i < 10'000; ++i) writer.push(0, i, std::array{0.1 * i, -0.1 * i});
  EXPECT_EQ(test::allocations, 0);
  writer.finish();
  test::counting = false;
  EXPECT_GT(test::allocations, 0);  // the counter counts
}

TEST(Writer, FullRingWaitsAndLosesNothing) {
  const Folder folder;
  const std::vector<signals::Topic> topics = {{"/a", "", {{"value", "1"}}},
                                              {"/b", "", {{"value", "1"}}}};
  Writer writer(folder / "log.mcap", topics, {}, {.ring = 4});
  for (int i = 0; i < 20'000; ++i)
    ASSERT_TRUE(writer.push(static_cast<std::uint16_t>(i % 2), i, std::array{double(i)}));
  EXPECT_GT(writer.waits(), 0u);
  writer.finish();
  const signals::Table table = read(folder / "log.mcap");
  ASSERT_EQ(table.series.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) {
    ASSERT_EQ(table.series[t].time_ns.size(), 10'000u);
    for (std::size_t i = 0; i < 10'000; ++i) {
      ASSERT_EQ(table.series[t].time_ns[i], static_cast<std::int64_t>(2 * i + t));
      ASSERT_EQ(table.series[t].columns[0][i], static_cast<double>(2 * i + t));
    }
  }
}

TEST(Writer, RefusesWhatDoesNotFit) {
  const Folder folder;
  Writer writer(folder / "log.mcap", kForce);
  EXPECT_FALSE(writer.push(1, 0, std::array{1.0, 2.0}));
  EXPECT_FALSE(writer.push(0, 0, std::array{1.0}));
  writer.finish();
  writer.finish();
  EXPECT_FALSE(writer.push(0, 0, std::array{1.0, 2.0}));
  EXPECT_EQ(messages_in(read(folder / "log.mcap")), 0u);
  EXPECT_TRUE(read(folder / "log.mcap").complete);
}

TEST(Writer, RefusesTopicsItCannotHold) {
  const Folder folder;
  const auto create = [&](std::vector<signals::Topic> topics) {
    return error_of([&] { Writer(folder / "log.mcap", std::move(topics)); });
  };
  const signals::Field f{"a", "1"};
  EXPECT_THAT(create({{"/wide", "", {f, {"b", ""}, {"c", ""}, {"d", ""}, {"e", ""}}}}),
              HasSubstr("topic /wide has 5 fields; a topic has 1 to 4"));
  EXPECT_THAT(create({{"/none", "", {}}}), HasSubstr("topic /none has 0 fields"));
  EXPECT_THAT(create({{"/t", "", {f}}, {"/t", "", {f}}}), HasSubstr("/t stands twice"));
  EXPECT_THAT(create({{"/t", "", {f, f}}}), HasSubstr("two fields a"));
  EXPECT_THAT(create({{"/t", "\xFF", {f}}}), HasSubstr("not UTF-8"));
}

TEST(Writer, ReportsWhereItCannotWrite) {
  const Folder folder;
  EXPECT_THAT(error_of([&] { Writer(folder / "no" / "log.mcap", kForce); }),
              AllOf(HasSubstr("no/log.mcap: cannot create the log: No such file or directory; "),
                    HasSubstr("choose a folder")));
}

TEST(Writer, ReportsAFolderThatIsNotWritable) {
  const Folder own;
  std::filesystem::permissions(
      own.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  // Root may write anywhere except there.
  const std::filesystem::path folder = ::geteuid() == 0 ? "/sys" : own.path();
  EXPECT_THAT(error_of([&] { Writer(folder / "log.mcap", kForce); }),
              AllOf(HasSubstr("log.mcap: cannot create the log: "),
                    AnyOf(HasSubstr("Permission denied"), HasSubstr("Read-only file system"),
                          HasSubstr("not permitted")),
                    HasSubstr("that you may write to")));
  std::filesystem::permissions(own.path(), std::filesystem::perms::owner_all);
}

// A limit on the file size simulates a full disk.
TEST(Writer, FullDiskIsReportedAtTheEnd) {
  const Folder folder;
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  ::getrlimit(RLIMIT_FSIZE, &old_limit);
  Writer writer(folder / "log.mcap", kForce);
  const rlimit small{10'000, old_limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  int pushed = 0;
  while (pushed < 10'000'000 && writer.push(0, pushed, std::array{double(pushed), 0.0})) ++pushed;
  const std::string message = error_of([&] { writer.finish(); });
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  ::signal(SIGXFSZ, old_handler);

  EXPECT_LT(pushed, 10'000'000);  // push() reports it to the loop
  EXPECT_THAT(
      message,
      AllOf(HasSubstr("cannot write the log: File too large; it ends after 10000 bytes"),
            HasSubstr("all later samples are lost"), HasSubstr("what is in the file can be read")));
  const signals::Table table = read(folder / "log.mcap");
  EXPECT_FALSE(table.complete);
  EXPECT_GT(messages_in(table), 50u);
  EXPECT_EQ(table.series[0].columns[0].back(), static_cast<double>(messages_in(table) - 1));
}

TEST(Writer, FileThatCannotBeIndexedStaysWhole) {
  const Folder folder;
  const signals::Table table = random_table(10, 100);
  Writer writer(folder / "log.mcap", topics_of(table));
  push_all(writer, table);
  std::filesystem::create_directories(folder / "log.mcap.tmp" / "in the way");
  EXPECT_THAT(error_of([&] { writer.finish(); }), HasSubstr("log.mcap.tmp: cannot create"));
  const signals::Table back = read(folder / "log.mcap");
  EXPECT_TRUE(back.complete);
  expect_same(back, table);
}

// A child pushes a sample per millisecond and is killed; it stores the time of each push in shared
// memory. Samples missing from the file must be younger than 20 ms; 60, as a loaded machine may
// delay the log's thread.
TEST(Writer, KilledRunLosesOnlyItsLastMilliseconds) {
  const Folder folder;
  struct Shared {
    std::atomic<int> pushed;
    std::int64_t at_ns[100'000];
  };
  void* memory =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  auto* shared = new (memory) Shared;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Writer writer(folder / "log.mcap", kForce);
    for (int i = 0; i < 100'000; ++i) {
      shared->at_ns[i] = wall_ns();
      writer.push(0, i * 1'000'000LL, std::array{double(i), 0.0});
      shared->pushed.store(i + 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::_exit(0);
  }
  for (int i = 0; i < 10'000 && shared->pushed.load() < 200; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::int64_t killed_ns = wall_ns();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);

  const signals::Table table = read(folder / "log.mcap");
  const auto kept = static_cast<int>(messages_in(table));
  const int pushed = shared->pushed.load();
  EXPECT_FALSE(table.complete);
  EXPECT_GE(pushed, 200);
  ASSERT_GT(kept, 0);
  EXPECT_EQ(table.series[0].columns[0].back(), kept - 1.0);
  const double lost_ms = kept < pushed ? (killed_ns - shared->at_ns[kept]) * 1e-6 : 0.0;
  EXPECT_LT(lost_ms, 60.0);
  ::munmap(memory, sizeof(Shared));
}

}  // namespace
}  // namespace sinew::log::writer_test
