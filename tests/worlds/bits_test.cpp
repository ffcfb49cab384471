// A world has the same bits twice, however often and however it is observed.
#include <gtest/gtest.h>

#include "sinew/run/simulation/test_same.h"
#include "tests/worlds/drive.h"

namespace sinew::worlds {
namespace {

class Bits : public Worlds {};

constexpr Tick end = 4000;

void expect_same(const Subject& s, const Record& a, const Record& b) {
  const std::size_t count = s.make({})->quantities().size();
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i)
    ASSERT_EQ(a.truth[i], b.truth[i])
        << s.name << ", " << s.make({})->quantities()[i % count].name << ", look " << i / count;
  EXPECT_EQ(a.readings, b.readings) << s.name;
}

TEST_P(Bits, TwiceTheSameBits) {
  const Record once = follow(GetParam(), {}, end, 1);
  expect_same(GetParam(), once, follow(GetParam(), {}, end, 1));
}

// Observations at random instants, several per tick.
TEST_P(Bits, PeeksLeaveNoTrace) {
  expect_same(GetParam(), follow(GetParam(), {}, end, 2),
              follow(GetParam(), {}, end, 2, {.truths = 3}));
}

TEST_P(Bits, VisitingEveryTickChangesNoBit) {
  expect_same(GetParam(), follow(GetParam(), {}, end, 3),
              follow(GetParam(), {}, end, 3, {.every_tick = true}));
}

// Nodes that are committed early, in portions of any length, are the same nodes.
TEST_P(Bits, AdvancingInPortionsChangesNoBit) {
  expect_same(GetParam(), follow(GetParam(), {}, end, 4),
              follow(GetParam(), {}, end, 4, {.advances = true}));
}

// A save that another body restores contains all state that the future depends on: some 80 times in
// a run, also between nodes, while edges are pending.
TEST_P(Bits, GoesOnFromASave) {
  expect_same(GetParam(), follow(GetParam(), {}, end, 5),
              follow(GetParam(), {}, end, 5, {.restores = true}));
}

// The real controller in the loop: its output depends on every reading.
TEST_P(Bits, ReadsDoNotChangeAClosedLoop) {
  if (!GetParam().run) return;
  const signals::Table alone = GetParam().run(false, 0);
  ASSERT_FALSE(alone.series.empty());
  run::expect_same(alone, GetParam().run(true, 2));
}

INSTANTIATE_TEST_SUITE_P(Worlds, Bits, ::testing::ValuesIn(subjects()), name_of);

}  // namespace
}  // namespace sinew::worlds
