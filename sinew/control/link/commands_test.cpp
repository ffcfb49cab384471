// Tests that a frame is accepted once, and a command in its periods only.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "sinew/control/link/command_queue.h"
#include "sinew/control/link/sequence.h"

namespace sinew::link::commands_test {
namespace {

using signals::Tick;

constexpr Tick period = 100;

// --- sequence -----------------------------------------------------------------------------------

TEST(Sequence, EveryFrameIsTakenOnceRoundAndRound) {
  SequenceWindow window;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(window.take(static_cast<std::uint8_t>(i + 77))) << i;
    EXPECT_FALSE(window.take(static_cast<std::uint8_t>(i + 77))) << i;
  }
  EXPECT_EQ(window.lost(), 0u);
  EXPECT_EQ(window.repeated(), 1000u);
}

TEST(Sequence, WhatIsBetweenWasLost) {
  for (unsigned gap = 1; gap < 256; ++gap) {
    SequenceWindow window;
    ASSERT_TRUE(window.take(200));
    const bool taken = window.take(static_cast<std::uint8_t>(200 + gap));
    EXPECT_EQ(taken, gap <= 127) << gap;
    EXPECT_EQ(window.lost(), taken ? gap - 1 : 0) << gap;
  }
}

TEST(Sequence, OldOnesAreNotTakenAgain) {
  std::mt19937 random(1);
  SequenceWindow window;
  unsigned last = 1000;
  ASSERT_TRUE(window.take(static_cast<std::uint8_t>(last)));
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_FALSE(window.take(static_cast<std::uint8_t>(last - random() % 128)));
    last += 1 + random() % 127;
    EXPECT_TRUE(window.take(static_cast<std::uint8_t>(last)));
  }
}

TEST(Sequence, AnewAnyNumberIsTaken) {
  SequenceWindow window;
  EXPECT_TRUE(window.take(100));
  EXPECT_FALSE(window.take(10));
  window.restart();
  EXPECT_TRUE(window.take(10));
  EXPECT_EQ(window.lost(), 0u);
}

// --- a command's time ---------------------------------------------------------------------------

CommandFor command(Tick from, int periods, int angle = 0) {
  CommandFor out{.from = from, .periods = static_cast<std::uint8_t>(periods), .joints = 1};
  out.joint[0].angle = angle;
  return out;
}

TEST(CommandQueue, TakesWhatIsForNowAndAWhileAhead) {
  for (Tick from = -1000; from <= 1000; from += 10)
    for (int periods = 1; periods < 5; ++periods) {
      CommandQueue queue(period);
      const Tick begun = 5000;
      const Code code = queue.put(command(begun + from, periods), begun);
      const bool is_over = from + periods * period <= period;
      const Code expected = from > 4 * period    ? Code::future
                            : is_over            ? Code::past
                            : from % period != 0 ? Code::period
                                                 : Code::done;
      EXPECT_EQ(code, expected) << from << ' ' << periods;
    }
}

TEST(CommandQueue, ACommandHoldsForItsPeriodsAndNoLonger) {
  for (int periods = 1; periods <= 100; ++periods) {
    CommandQueue queue(period);
    ASSERT_EQ(queue.put(command(300, periods), 0), Code::done);
    for (Tick t = period; t < 20'000; t += period)
      EXPECT_EQ(queue.at(t) != nullptr, t >= 300 && t < 300 + periods * period) << t;
  }
}

TEST(CommandQueue, TicksFarAwayAreRefusedNotMistaken) {
  for (const Tick from : {Tick{0}, max_tick, max_tick - 1, Tick{1} << 33, (Tick{1} << 32) + 100})
    for (const Tick begun : {Tick{0}, Tick{1'000'000}, max_tick}) {
      if (from == begun || (from == 0 && begun == 0)) continue;
      CommandQueue queue(period);
      if (from == max_tick - 1 && begun == max_tick) continue;
      EXPECT_NE(queue.put(command(from, 1), begun), Code::done) << from << ' ' << begun;
    }
}

// Compares with the whole history: of all accepted commands that have begun the latest one is in
// effect, as long as it is valid.
TEST(CommandQueue, IsTheHistoryLookedAtAnew) {
  std::mt19937 random(2);
  CommandQueue queue(period);
  std::map<Tick, CommandFor> history;
  int held = 0, lost = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Tick begun = i * period;
    for (unsigned k = random() % 3; k > 0; --k) {
      const Tick from = begun + (static_cast<Tick>(random() % 9) - 2) * period;
      const CommandFor c = command(std::max<Tick>(from, 0), 1 + static_cast<int>(random() % 6),
                                   static_cast<int>(random() % 1000));
      if (queue.put(c, begun) == Code::done) history[c.from] = c;
    }
    const Tick next = begun + period;
    const auto behind = history.upper_bound(next);
    const CommandFor* newest = behind == history.begin() ? nullptr : &std::prev(behind)->second;
    const bool good = newest && next < newest->from + newest->periods * period;
    const CommandFor* found = queue.at(next);
    ASSERT_EQ(found != nullptr, good) << next;
    (good ? held : lost) += 1;
    if (!found) continue;
    EXPECT_EQ(found->from, newest->from);
    EXPECT_EQ(found->joint[0].angle, newest->joint[0].angle);
  }
  EXPECT_GT(held, 10'000);
  EXPECT_GT(lost, 1000);
}

TEST(CommandQueue, NothingGoesBackToACommandThatWasSucceeded) {
  CommandQueue queue(period);
  EXPECT_EQ(queue.put(command(100, 50, 1), 0), Code::done);
  EXPECT_EQ(queue.put(command(200, 1, 2), 0), Code::done);
  EXPECT_EQ(queue.at(100)->joint[0].angle, 1);
  EXPECT_EQ(queue.at(200)->joint[0].angle, 2);
  EXPECT_EQ(queue.at(300), nullptr);
  EXPECT_EQ(queue.put(command(100, 50, 1), 300), Code::past) << "nor when it comes again";
  EXPECT_EQ(queue.at(400), nullptr);
}

}  // namespace
}  // namespace sinew::link::commands_test
