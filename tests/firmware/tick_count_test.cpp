// A timer of 100 us and one that never stops, as a processor has them: an interrupt waits while
// another one is served, and two that wait are one.
#include "firmware/tick_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sinew::firmware {
namespace {

constexpr std::uint32_t tick = 2'500;  // [clocks]

// Also across the end of the counter's 32 bits.
struct Clock {
  explicit Clock(std::uint32_t from = 0xffffff00) : from_(from) { count.start(tick, from); }
  // The tick count that an interrupt reports when it is served so many ticks after the start.
  std::uint32_t at(double ticks) {
    return count.passed(from_ + static_cast<std::uint32_t>(ticks * tick));
  }
  // The beginning of the current tick.
  double began() const { return (count.began() - from_) / double{tick}; }
  TickCount count;

 private:
  std::uint32_t from_;
};

TEST(TickCount, InterruptsThatAreOnTimeAreOneEach) {
  Clock clock;
  for (int i = 1; i < 10'000; ++i) ASSERT_EQ(clock.at(i + 0.01), 1u);
}

TEST(TickCount, ALateOneIsNoMissedOneAndTheNextOneCounts) {
  for (const double late : {0.3, 0.5, 0.6, 0.8}) {
    Clock clock;
    EXPECT_EQ(clock.at(1 + late), 1u) << late;
    for (int i = 2; i < 10; ++i) EXPECT_EQ(clock.at(i), 1u) << late;
    EXPECT_EQ(clock.began(), 9.0) << late;
    EXPECT_EQ(clock.at(11), 2u) << "tick 10 was lost, after one that was late by " << late;
  }
}

TEST(TickCount, EachThatIsLostIsCountedOnce) {
  for (const std::uint32_t lost : {1u, 2u, 7u, 30u, 100u}) {
    Clock clock;
    EXPECT_EQ(clock.at(1), 1u);
    EXPECT_EQ(clock.at(2 + lost + 0.2), 1 + lost);
    EXPECT_EQ(clock.at(3 + lost), 1u);
  }
}

// Two timers that were started one after the other: the interrupts come a little early or late.
TEST(TickCount, TimersThatStartOneAfterTheOtherAreTheSameClock) {
  for (const double shift : {-0.01, 0.1}) {
    Clock clock;
    for (int i = 1; i < 1'000; ++i) ASSERT_EQ(clock.at(i + shift), 1u);
    EXPECT_EQ(clock.at(1'002 + shift), 3u);
  }
}

TEST(TickCount, OneThatIsServedJustBeforeTheNextIsNotCountedTwice) {
  Clock clock;
  EXPECT_EQ(clock.at(1.99), 2u);
  EXPECT_EQ(clock.at(2.05), 0u);
  for (int i = 3; i < 10; ++i) EXPECT_EQ(clock.at(i), 1u);
  EXPECT_EQ(clock.began(), 9.0);
}

// Work of any length in each tick; the next one is served when that is done. One that is served
// within a 64th of the tick after it counts that one as well, whose own interrupt then counts none.
TEST(TickCount, WhateverIsLateNoTickIsLostOrTwice) {
  std::mt19937 random(1);
  std::exponential_distribution<double> work(2.0);  // [ticks]
  for (int run = 0; run < 200; ++run) {
    Clock clock(static_cast<std::uint32_t>(random()));
    double now = 1;
    std::uint64_t told = 0;
    for (int i = 0; i < 1'000; ++i) {
      told += clock.at(now);
      const double served = now + 1.0 / 64;
      if (served - std::floor(served) > 1e-3) {  // else rounding to clocks decides
        ASSERT_EQ(told, static_cast<std::uint64_t>(served)) << "run " << run << ", tick " << i;
      }
      now = std::max(now + work(random), std::floor(now) + 1);
    }
  }
}

}  // namespace
}  // namespace sinew::firmware
