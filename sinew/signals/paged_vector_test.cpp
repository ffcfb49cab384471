// A vector with pages in a file behaves as a std::vector, whatever operations are applied.
#include "sinew/signals/paged_vector.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

namespace sinew::signals::paged_vector_test {
namespace {

using Numbers = PagedVector<std::int64_t>;

// Applies the same random pushes, pops, changes and copies to both, and compares all values.
TEST(PagedVector, IsAsAStdVector) {
  std::mt19937_64 random(7);
  for (const bool with_file : {false, true}) {
    const PageFile file = with_file ? PageFile::make() : PageFile();
    Numbers ours(file), copy;
    std::vector<std::int64_t> theirs, their_copy;
    for (int round = 0; round < 60; ++round) {
      const auto some = static_cast<std::size_t>(random() % (Numbers::page_size / 2));
      const auto what = random() % 8;
      for (std::size_t i = 0; i < some; ++i) {
        const auto x = static_cast<std::int64_t>(random());
        if (what == 0 && !theirs.empty()) {
          ours.pop_back();
          theirs.pop_back();
        } else if (what == 1 && !theirs.empty() && i < 100) {
          const std::size_t at = random() % theirs.size();
          ours.set(at, x);
          theirs[at] = x;
        } else if (what > 1) {
          ours.push_back(x);
          theirs.push_back(x);
        }
      }
      if (round % 7 == 3) {
        copy = ours;
        their_copy = theirs;
      }
      ASSERT_EQ(ours.size(), theirs.size());
      ASSERT_EQ(copy.in_memory(), their_copy);
      for (int k = 0; k < 50 && !theirs.empty(); ++k) {
        const std::size_t at = random() % theirs.size();
        ASSERT_EQ(ours[at], theirs[at]) << at;
      }
    }
    ASSERT_GT(ours.size(), 3 * Numbers::page_size);
    EXPECT_TRUE(std::ranges::equal(ours, theirs));
    EXPECT_EQ(ours.back(), theirs.back());
    EXPECT_EQ(ours, Numbers(theirs));
    copy.push_back(ours.back());
    EXPECT_NE(ours, copy);
  }
}

TEST(PagedVector, IsSearchedAndSlicedAsAVector) {
  Numbers ascending(PageFile::make());
  const auto n = static_cast<std::int64_t>(3 * Numbers::page_size + 5);
  for (std::int64_t i = 0; i < n; ++i) ascending.push_back(2 * i);
  for (const std::int64_t x : {std::int64_t{-1}, std::int64_t{9001}, 2 * n - 2, 2 * n})
    EXPECT_EQ(std::ranges::upper_bound(ascending, x) - ascending.begin(),
              std::clamp<std::int64_t>(x < 0 ? 0 : x / 2 + 1, 0, n));
  EXPECT_EQ(ascending.slice(8190, 8194), (std::vector<std::int64_t>{16380, 16382, 16384, 16386}));
  Numbers other(PageFile::make());
  std::ranges::copy(ascending, std::back_inserter(other));
  EXPECT_EQ(ascending, other);
}

// The loop relies on this: nothing is added without room, and no earlier element is lost.
TEST(PagedVector, AddsWithinWhatWasReserved) {
  Numbers in_memory;
  in_memory.reserve(3);
  std::int64_t added = 0;
  while (in_memory.try_push_back(added)) ++added;
  EXPECT_EQ(added, 3);

  PageFile file = PageFile::make();
  ASSERT_TRUE(file.open(0)) << file.problem();
  Numbers paged(file);
  paged.reserve(2 * Numbers::page_size);
  for (added = 0; paged.try_push_back(added);) ++added;
  EXPECT_GE(added, static_cast<std::int64_t>(2 * Numbers::page_size));
  for (std::int64_t i = 0; i < added; ++i) ASSERT_EQ(paged[static_cast<std::size_t>(i)], i);
}

TEST(PagedVector, ReportsWhereItCannotPutItsPages) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", "/nowhere/at/all", 1);
  Numbers numbers(PageFile::make());
  std::string said;
  try {
    for (std::size_t i = 0; i <= 2 * Numbers::page_size; ++i) numbers.push_back(1);
  } catch (const std::runtime_error& e) {
    said = e.what();
  }
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_NE(said.find("/nowhere/at/all: cannot keep a long run's numbers"), std::string::npos)
      << said;
  EXPECT_NE(said.find("TMPDIR"), std::string::npos) << said;
  EXPECT_EQ(numbers.size(), Numbers::page_size);
}

// Pages of destroyed vectors are reused: a file grows with the current data, not with all past
// data.
TEST(PageFile, UsesPagesAgain) {
  const PageFile file = PageFile::make();
  for (int round = 0; round < 50; ++round) {
    Numbers gone(file);
    gone.assign(4 * Numbers::page_size, round);
  }
  Numbers last(file);
  last.assign(4 * Numbers::page_size, 1);
  EXPECT_LE(file.pages(), 4u);
}

}  // namespace
}  // namespace sinew::signals::paged_vector_test
