// Tests one valve with constant and changing duties.
#include "sinew/control/joint/pulse_train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "sinew/signals/timing.h"

namespace sinew::control::pulse_train_test {
namespace {

using signals::Tick;

// Returns the edges as (tick, open) for laws at ticks 0, 100, 200 ... with these duties.
std::map<Tick, bool> edges(const std::vector<int>& duties, const signals::ValveTiming& timing,
                           int disabled_at = -1, int delay = 1) {
  std::map<Tick, bool> out;
  PulseTrain train;
  const Tick end = 100 * static_cast<Tick>(duties.size());
  for (Tick t = 0; t < end; ++t) {
    while (train.next() <= t) {
      out.emplace(t, train.next_opens());
      train.drive();
    }
    if (t % 100 != 0) continue;
    const int duty = duties[static_cast<std::size_t>(t / 100)];
    train.cycle(t, {timing.closing[duty], timing.opening[duty], 100, delay},
                t / 100 != disabled_at);
  }
  return out;
}

// Returns the open time within [from, until).
Tick open_ticks(const std::map<Tick, bool>& edges, Tick from, Tick until) {
  Tick sum = 0, opened = until;
  for (const auto& [at, opens] : edges) {
    if (opens)
      opened = std::max(at, from);
    else
      sum += std::max<Tick>(0, std::min(at, until) - opened), opened = until;
  }
  return sum + std::max<Tick>(0, until - opened);
}

// In each tick the valve follows its period's opening, independent of the previous one.
TEST(PulseTrain, OpensAsAHostHasIt) {
  constexpr int period = 6;
  PulseTrain train;
  Opening opening{};
  bool open = false;
  for (Tick t = 0; t < 10 * 49 * 49 * period; ++t) {
    const auto at = static_cast<int>(t % period);
    const auto n = static_cast<unsigned>(t / period * 4'567);  // pairs of openings in any order
    if (at == 0) {
      opening = {static_cast<std::uint16_t>(n % 7), static_cast<std::uint16_t>(n / 7 % 7)};
      train.open(t, period, opening);
    }
    for (; train.next() <= t; train.drive()) {
      ASSERT_EQ(train.next(), t);
      ASSERT_NE(train.next_opens(), open) << "an edge that changes nothing";
      open = train.next_opens();
    }
    const bool between = opening.from <= at && at < opening.until;
    const bool at_the_ends =
        opening.until < opening.from && (at < opening.until || at >= opening.from);
    ASSERT_EQ(open, between || at_the_ends) << opening.from << ' ' << opening.until << ' ' << at;
  }
}

constexpr signals::ValveTiming identity = signals::identity_timing();

TEST(PulseTrain, MeanIsTheDuty) {
  for (int duty = 0; duty <= 100; ++duty)
    ASSERT_EQ(open_ticks(edges(std::vector<int>(12, duty), identity), 101, 1101), 10 * duty)
        << duty;
}

// The coil's times are compensated for the delays, so that the valve itself is open for the duty.
TEST(PulseTrain, CompensatedTableDeliversTheDuty) {
  constexpr Tick opening_delay = 5, closing_delay = 12;
  const signals::ValveTiming timing = signals::compensated_timing(opening_delay, closing_delay);
  for (int duty = 13; duty < 100; ++duty) {
    const Tick on = open_ticks(edges(std::vector<int>(12, duty), timing), 101, 1101);
    ASSERT_EQ(on, 10 * (duty + opening_delay - closing_delay)) << duty;
  }
}

TEST(PulseTrain, FromZeroCostsAPeriod) {
  const std::map<Tick, bool> expected = {{100, true}, {130, false}};
  EXPECT_EQ(edges({30, 30, 0}, identity),
            (std::map<Tick, bool>{{100, true}, {130, false}, {200, true}, {201, false}}));
  EXPECT_EQ(edges({30, 30}, identity), expected);
}

TEST(PulseTrain, ToZeroLeavesOneTick) {
  EXPECT_EQ(edges({30, 0, 0}, identity), (std::map<Tick, bool>{{100, true}, {101, false}}));
}

TEST(PulseTrain, FullDutyStaysOn) {
  EXPECT_EQ(edges({100, 100, 100, 40, 0}, identity),
            (std::map<Tick, bool>{{100, true}, {340, false}, {400, true}, {401, false}}));
}

TEST(PulseTrain, DisabledShutsAtOnce) {
  EXPECT_EQ(edges({60, 60, 60, 60}, identity, 2),
            (std::map<Tick, bool>{{100, true}, {160, false}, {200, true}, {201, false}}));
}

TEST(PulseTrain, DelayShiftsEverything) {
  const auto now = edges({60, 7, 0, 100, 20, 20}, identity);
  for (const int delay : {2, 50, 100}) {
    auto expected = std::map<Tick, bool>{};
    for (const auto& [at, open] : now)
      if (at + delay - 1 < 600) expected.emplace(at + delay - 1, open);
    EXPECT_EQ(edges({60, 7, 0, 100, 20, 20}, identity, -1, delay), expected);
  }
}

TEST(PulseTrain, PulseAndShutDropWhatWasToCome) {
  PulseTrain train;
  train.cycle(0, {50, 100, 100, 1}, true);
  EXPECT_EQ(train.next(), 100);
  train.pulse(20, 80);
  EXPECT_EQ(train.next(), 20);
  train.drive();
  EXPECT_EQ(train.next(), 80);
  train.pulse(30, 60);  // on already
  EXPECT_EQ(train.next(), 60);
  train.shut(40);
  EXPECT_EQ(train.next(), 40);
  train.drive();
  EXPECT_EQ(train.next(), PulseTrain::never);
}

}  // namespace
}  // namespace sinew::control::pulse_train_test
