// The shutter against a clock that counts microseconds, and against the thesis's duty cycles.

#include "sinew/gas/delay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sinew::gas::delay_test {
namespace {

constexpr double us = 1e-6;
const double never = std::numeric_limits<double>::infinity();

Valve valve(Valve::Profile profile, int opening, int closing, int opening_ramp = 0,
            int closing_ramp = 0) {
  return {.profile = profile,
          .opening_delay = opening * us,
          .closing_delay = closing * us,
          .opening_ramp = opening_ramp * us,
          .closing_ramp = closing_ramp * us};
}

// Edges at these microseconds; the first opens.
using Train = std::vector<int>;

Train any_train(std::mt19937_64& random, int edges, int longest) {
  Train train{std::uniform_int_distribution<>(1, longest)(random)};
  while (static_cast<int>(train.size()) < edges)
    train.push_back(train.back() + std::uniform_int_distribution<>(1, longest)(random));
  return train;
}

// Counts the microseconds open. The shutter moves once the coil has been against it for longer than
// the delay without interruption: a definition without events and queue.
int count_open(const Train& train, int opening, int closing) {
  bool command = false, open = false;
  int since = 0, total = 0;
  std::size_t edge = 0;
  for (int now = 0; now <= train.back() + 100000; ++now) {
    while (edge < train.size() && train[edge] == now) {
      command = !command;
      since = now;
      ++edge;
    }
    if (command != open && now - since >= (command ? opening : closing)) open = command;
    if (open) ++total;
    if (edge == train.size() && open == command) return open ? -1 : total;
  }
  return total;
}

// Counts the same with the shutter, with each edge given at its time.
double open_time(const Valve& v, const Train& train, int told_ahead = 0) {
  Shutter shutter(v);
  double total = 0, last = 0;
  const auto go = [&](double until) {
    while (shutter.next() <= until) {
      const double node = shutter.next();
      total += (shutter.fraction(last) + shutter.fraction(node)) / 2 * (node - last);
      shutter.advance(node);
      last = node;
    }
  };
  bool open = false;
  for (std::size_t i = 0; i < train.size(); ++i) {
    const auto due = static_cast<int>(i) - told_ahead;
    // An edge may still cancel a change at its own instant.
    if (due >= 0) go(train[static_cast<std::size_t>(due)] * us - 2 * Shutter::simultaneous);
    shutter.electrical(train[i] * us, open = !open);
  }
  go(train.back() * us + 1);
  EXPECT_EQ(shutter.fraction(last), 0);
  EXPECT_FALSE(shutter.overrun());
  return total;
}

TEST(Shutter, OnePulseInClosedForm) {
  const Valve v = valve(Valve::Profile::dead_time, 4000, 1000);
  for (int pulse : {1, 500, 3999, 4000, 4001, 5000, 20000}) {
    const int delivered = pulse > 4000 ? pulse - 4000 + 1000 : 0;
    EXPECT_NEAR(open_time(v, {100, 100 + pulse}), delivered * us, 1e-12) << pulse;
  }
}

TEST(Shutter, OneGapInClosedForm) {
  const Valve v = valve(Valve::Profile::dead_time, 4000, 1000);
  for (int gap : {1, 999, 1000, 1001, 3000, 9000}) {
    const int delivered_gap = gap > 1000 ? gap - 1000 + 4000 : 0;
    const int all = 20000 + gap + 20000 - 4000 + 1000;
    EXPECT_NEAR(open_time(v, {0, 20000, 20000 + gap, 40000 + gap}), (all - delivered_gap) * us,
                1e-12)
        << gap;
  }
}

TEST(Shutter, RandomTrainsDeliverWhatTheClockCounts) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 400; ++i) {
    const int opening = std::uniform_int_distribution<>(0, 600)(random);
    const int closing = std::uniform_int_distribution<>(0, 600)(random);
    const Train train = any_train(random, 40, 900);
    EXPECT_NEAR(open_time(valve(Valve::Profile::dead_time, opening, closing), train),
                count_open(train, opening, closing) * us, 1e-10);
  }
}

TEST(Shutter, DoesNotDependOnHowFarAheadEdgesAreGiven) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const Valve v =
        valve(i % 2 ? Valve::Profile::dead_time : Valve::Profile::ramp, 300, 400, 250, 90);
    const Train train = any_train(random, 40, 900);
    const double at_once = open_time(v, train);
    for (int ahead : {1, 3, 5}) EXPECT_EQ(open_time(v, train, ahead), at_once);
  }
}

TEST(Shutter, InstantsNeverGoBack) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    Shutter shutter(valve(Valve::Profile::ramp, 500, 100, 300, 200));
    double last = 0;
    bool open = false;
    for (int edge : any_train(random, 60, 400)) {
      const double t = edge * us;
      while (shutter.next() < t) {
        EXPECT_GE(shutter.next(), last);
        last = shutter.next();
        shutter.advance(last);
      }
      shutter.electrical(t, open = !open);
      EXPECT_GT(shutter.next(), t - Shutter::simultaneous);
    }
  }
}

// Ramps against a shutter that is moved microsecond by microsecond.
TEST(Shutter, RampsMoveAtTheirOwnRates) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 30; ++i) {
    const int opening = 300, closing = 200, up = 350, down = 240;
    const Train train = any_train(random, 20, 1200);
    Shutter shutter(valve(Valve::Profile::ramp, opening, closing, up, down));

    bool command = false, moving_open = false;
    int since = 0;
    std::size_t edge = 0;
    double area = 0;
    for (int now = 0; now < train.back() + 2000; ++now) {
      while (edge < train.size() && train[edge] == now) {
        command = !command;
        since = now;
        shutter.electrical(now * us, command);
        ++edge;
      }
      if (command != moving_open && now - since >= (command ? opening : closing))
        moving_open = command;
      shutter.advance(now * us + Shutter::simultaneous);
      ASSERT_NEAR(shutter.fraction(now * us), area, 1e-5) << now;
      area += moving_open ? 1.0 / up : -1.0 / down;
      area = std::min(1.0, std::max(0.0, area));
    }
    EXPECT_EQ(shutter.next(), never);
  }
}

TEST(Shutter, RampHasNodesWhereItStartsAndEnds) {
  Shutter shutter(valve(Valve::Profile::ramp, 300, 40, 100, 50));
  shutter.electrical(0, true);
  EXPECT_NEAR(shutter.next(), 300 * us, 1e-15);
  shutter.advance(shutter.next());
  EXPECT_NEAR(shutter.next(), 400 * us, 1e-15);
  EXPECT_NEAR(shutter.fraction(350 * us), 0.5, 1e-12);

  // Shut while it still opens: it reverses at its position.
  shutter.electrical(340 * us, false);
  EXPECT_NEAR(shutter.next(), 380 * us, 1e-15);
  shutter.advance(shutter.next());
  EXPECT_NEAR(shutter.fraction(380 * us), 0.8, 1e-12);
  EXPECT_NEAR(shutter.next(), (380 + 0.8 * 50) * us, 1e-15);
  shutter.advance(shutter.next());
  EXPECT_EQ(shutter.fraction(1), 0);
  EXPECT_EQ(shutter.next(), never);
}

TEST(Shutter, DeadTimeHoldsTheOldShareUpToTheNode) {
  Shutter shutter(valve(Valve::Profile::dead_time, 300, 200));
  shutter.electrical(0, true);
  const double node = shutter.next();
  EXPECT_EQ(shutter.fraction(node), 0);
  shutter.advance(node);
  EXPECT_EQ(shutter.fraction(node), 1);
}

TEST(Shutter, IdealValveFollowsTheCoil) {
  Shutter shutter(valve(Valve::Profile::ideal, 300, 200));
  shutter.electrical(0.5, true);
  EXPECT_EQ(shutter.next(), 0.5);
  shutter.advance(0.5);
  EXPECT_EQ(shutter.fraction(0.5), 1);
  shutter.electrical(0.6, true);  // no effect
  EXPECT_EQ(shutter.next(), never);
}

TEST(Shutter, APulseOfJustTheDelayNeverOpensWhateverWasAdvanced) {
  for (bool advanced : {false, true}) {
    for (int start = 1; start < 5000; start += 7) {  // sums that round up and down
      Shutter shutter(valve(Valve::Profile::dead_time, 400, 100));
      shutter.electrical(start * 1e-4, true);
      const double end = (start + 4) * 1e-4;
      if (advanced) shutter.advance(end);
      shutter.electrical(end, false);
      shutter.advance(end + 1);
      EXPECT_EQ(shutter.next(), never);
      EXPECT_EQ(shutter.fraction(end + 1), 0);
    }
  }
}

// 3.4 and figure 3-13: air delivered at a 50 % duty cycle with delays of 4 ms and 1 ms.
TEST(Shutter, DeliversTheDutyCyclesOfTheThesis) {
  const auto delivered = [](double frequency, double duty) {
    Shutter shutter(valve(Valve::Profile::dead_time, 4000, 1000));
    const double period = 1 / frequency;
    double total = 0, last = 0;
    const int periods = 10;
    const auto go = [&](double until) {
      for (;;) {
        const double to = std::min(shutter.next(), until);
        total += shutter.fraction(last) * (to - last);
        last = to;
        if (!(shutter.next() <= until)) return;
        shutter.advance(to);
      }
    };
    for (int i = 0; i < periods; ++i) {
      go(i * period);
      shutter.electrical(i * period, true);
      go((i + duty) * period);
      shutter.electrical((i + duty) * period, false);
    }
    go((periods + 1) * period);
    return total / (periods * period);
  };
  EXPECT_NEAR(delivered(25, 0.5), 0.425, 1e-12);
  EXPECT_NEAR(delivered(50, 0.5), 0.35, 1e-12);
  // D - .003 f in between, nothing below 4 ms, everything but the first opening above T - 1 ms.
  EXPECT_NEAR(delivered(25, 0.3), 0.3 - 0.003 * 25, 1e-12);
  EXPECT_EQ(delivered(25, 0.0999), 0);
  EXPECT_NEAR(delivered(25, 0.98), (10 * 40e-3 - 4e-3 - 0.8e-3 + 1e-3) / 0.4, 1e-12);
}

// Held at `share` from one microsecond to another; then the delays start again. Counts the open
// time without events and queue.
double held_open(const Train& train, int opening, int closing, int from, int to, double share) {
  bool command = false, open = false;
  int since = 0;
  double total = 0;
  std::size_t edge = 0;
  for (int now = 0; now < train.back() + 100000; ++now) {
    for (; edge < train.size() && train[edge] == now; ++edge) {
      command = !command;
      since = now;
    }
    const bool jammed = now >= from && now < to;
    if (now == to) {
      open = share > 0.5;
      since = to;
    }
    if (!jammed && command != open && now - since >= (command ? opening : closing)) open = command;
    total += jammed ? share : open ? 1.0 : 0.0;
  }
  return total * us;
}

TEST(Shutter, JammedItFollowsNoEdgeAndFreedItFollowsItsCoil) {
  std::mt19937_64 random(17);
  for (int trial = 0; trial < 400; ++trial) {
    const int opening = 50 + static_cast<int>(random() % 900),
              closing = 50 + static_cast<int>(random() % 900);
    const Train train = any_train(random, 2 * (1 + static_cast<int>(random() % 6)), 3000);
    const int from = static_cast<int>(random() % 8000),
              to = from + 1 + static_cast<int>(random() % 8000);
    const double share = random() % 2 == 0 ? 0.0 : 1.0;

    Shutter shutter(valve(Valve::Profile::dead_time, opening, closing));
    double total = 0, last = 0;
    const auto go = [&](double until) {
      while (shutter.next() <= until) {
        const double node = shutter.next();
        total += shutter.fraction(last) * (node - last);
        shutter.advance(last = node);
      }
      total += shutter.fraction(last) * (until - last);
      last = until;
    };
    std::size_t edge = 0;
    const auto edges_until = [&](int now) {
      for (; edge < train.size() && train[edge] <= now; ++edge) {
        go(train[edge] * us - 2 * Shutter::simultaneous);
        shutter.electrical(train[edge] * us, edge % 2 == 0);
      }
      go(now * us);
    };
    edges_until(from);
    shutter.jam(from * us, share);
    EXPECT_TRUE(shutter.jammed());
    edges_until(to);
    shutter.free(to * us);
    edges_until(train.back() + 100000);
    const double wanted = held_open(train, opening, closing, from, to, share);
    EXPECT_NEAR(total, wanted, 1e-8) << trial;
    EXPECT_FALSE(shutter.overrun());
  }
}

// The coil cannot open against the pressure: its command is lost, and so is its end.
TEST(Shutter, FreedWhereItsCoilCannotLiftItStaysShut) {
  Shutter shutter(valve(Valve::Profile::dead_time, 400, 100));
  shutter.jam(0, 0);
  shutter.electrical(1e-3, true);
  shutter.free(2e-3, 4e-4, false);
  EXPECT_EQ(shutter.next(), never);
  shutter.electrical(3e-3, false);
  EXPECT_EQ(shutter.next(), never);
  shutter.electrical(4e-3, true);
  EXPECT_NEAR(shutter.next(), 4.4e-3, 1e-12);
}

TEST(Shutter, ReportsWhenTooMuchWasGivenAhead) {
  Shutter shutter(valve(Valve::Profile::dead_time, 100, 100));
  for (int i = 0; i <= static_cast<int>(Shutter::capacity); ++i) {
    EXPECT_FALSE(shutter.overrun());
    shutter.electrical(i * 1e-3, i % 2 == 0);
  }
  EXPECT_TRUE(shutter.overrun());
}

}  // namespace
}  // namespace sinew::gas::delay_test
