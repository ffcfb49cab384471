// Parallel tasks: each runs once, has its own result, the first error is thrown, and all are
// counted.
#include "sinew/host/side_by_side.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace sinew::host::side_by_side_test {
namespace {

TEST(SideBySide, EachAttemptIsMadeOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 57u}) {
    std::vector<int> times(count, 0);
    Tally done = 0;
    side_by_side(
        count, [&](std::size_t k) { ++times[k]; }, &done);
    EXPECT_EQ(times, std::vector<int>(count, 1));
    EXPECT_EQ(done, static_cast<std::int64_t>(count));
  }
}

TEST(SideBySide, ThrowsTheFirstFailureWhenAllAreDone) {
  std::vector<int> times(20, 0);
  Tally done = 0;
  const auto attempt = [&](std::size_t k) {
    ++times[k];
    if (k == 7 || k == 13) throw std::runtime_error(std::to_string(k));
  };
  try {
    side_by_side(times.size(), attempt, &done);
    FAIL() << "no error";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "7");
  }
  EXPECT_EQ(times, std::vector<int>(20, 1));
  EXPECT_EQ(done, 20);
}

}  // namespace
}  // namespace sinew::host::side_by_side_test
