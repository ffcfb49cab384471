// The hash of a run's samples: what changes it, and what does not.
#include "sinew/analysis/state_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "sinew/units/hash.h"

namespace sinew::analysis::state_hash_test {
namespace {

signals::Table of_two_channels() {
  signals::Table table;
  table.series.push_back({{"/b", "", {{"value", "m"}}}, {0, 10}, {{1.5, -2.5}}});
  table.series.push_back({{"/a", "", {{"x", "m"}, {"y", "m"}}}, {0}, {{0.0}, {3.0}}});
  return table;
}

TEST(StateHash, IsFnv1aOfNamesTimesAndNumbers) {
  signals::Table table;
  table.series.push_back({{"/a", "", {{"value", "m"}}}, {258}, {{1.0}}});
  const std::string bytes("/a\x02\x01\0\0\0\0\0\0\0\0\0\0\0\0\xf0\x3f", 18);
  char expected[17];
  std::snprintf(expected, sizeof expected, "%016llx",
                static_cast<unsigned long long>(units::hash(bytes)));
  EXPECT_EQ(state_hash(table), expected);
}

TEST(StateHash, DependsOnEveryBitAndNotOnTheOrderOfChannels) {
  const signals::Table table = of_two_channels();
  const std::string hash = state_hash(table);
  signals::Table other = table;
  std::swap(other.series[0], other.series[1]);
  EXPECT_EQ(state_hash(other), hash);

  other = table;
  other.series[0].columns[0] = {std::nextafter(1.5, 2.0), -2.5};
  EXPECT_NE(state_hash(other), hash);
  other.series[0].columns[0] = {1.5, 2.5};
  EXPECT_NE(state_hash(other), hash);
  other = table;
  other.series[1].columns[0] = {-0.0};
  EXPECT_NE(state_hash(other), hash);
  other = table;
  other.series[0].time_ns = {0, 11};
  EXPECT_NE(state_hash(other), hash);
  other = table;
  other.series[0].topic.name = "/c";
  EXPECT_NE(state_hash(other), hash);
}

// Compilers and processors give different bits to a number that does not exist.
TEST(StateHash, IsTheSameForEveryNan) {
  signals::Table one = of_two_channels(), other = one;
  one.series[0].columns[0] = {std::numeric_limits<double>::quiet_NaN(), 0};
  other.series[0].columns[0] = {std::bit_cast<double>(0xfff8000000000001), 0};
  EXPECT_EQ(state_hash(one), state_hash(other));
}

}  // namespace
}  // namespace sinew::analysis::state_hash_test
