// Edges that are pending until their instant, with a signal in place of the compare's interrupt: it
// arrives between any two instructions of the "tick", as on a board.
#include "firmware/edges.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/time.h>

namespace sinew::firmware {
namespace {

struct Pins {
  std::uint32_t a = 0, b = 0;
};
constinit WaitingWord<Pins> waiting;
volatile std::uint32_t pin_a = 0, pin_b = 0;
volatile std::uint32_t came = 0, found = 0;

void put(const Pins& p) {
  pin_a = p.a;
  pin_b = p.b;
}
void edge_due(int) {
  came = came + 1;
  Pins p;
  if (!waiting.take(p)) return;
  found = found + 1;
  put(p);
}

void spend(std::uint32_t steps) {
  for (std::uint32_t i = 0; i < steps; ++i) asm volatile("");
}

class Interrupts {
 public:
  explicit Interrupts(int microseconds) {
    signal(SIGALRM, edge_due);
    const itimerval every{{0, microseconds}, {0, microseconds}};
    setitimer(ITIMER_REAL, &every, nullptr);
  }
  ~Interrupts() {
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    signal(SIGALRM, SIG_DFL);
  }
};

TEST(Edges, NothingOlderReachesThePinsOnceTheyAreOff) {
  const Interrupts interrupts(30);
  for (std::uint32_t n = 1; found < 2'000; ++n) {
    waiting.set({n, n});
    spend(n % 512);
    waiting.clear();
    put({});
    spend(n % 64);
    ASSERT_EQ(pin_a, 0u) << n;
    ASSERT_EQ(pin_b, 0u) << n;
  }
}

TEST(Edges, AWordReachesThePinsOnceWholeAndIsTheNewest) {
  const Interrupts interrupts(30);
  const std::uint32_t begin = found;
  for (std::uint32_t n = 1; found < begin + 2'000; ++n) {
    waiting.set({n, ~n});
    spend(n % 256);
    Pins late;
    if (waiting.take(late)) put(late);
    ASSERT_EQ(pin_a, n);
    ASSERT_EQ(pin_b, ~n);
    EXPECT_FALSE(waiting.take(late));
  }
}

TEST(Edges, OnlyARunsSwitchingWaits) {
  const hardware::Drive of_a_run{.tick = 7, .open = 1, .coils = 1, .current = true, .supply = true};
  EXPECT_TRUE(waits(of_a_run));
  hardware::Drive d = of_a_run;
  d.current = false;
  EXPECT_FALSE(waits(d)) << "dump";
  d = of_a_run;
  d.supply = false;
  EXPECT_FALSE(waits(d)) << "fault";
  d = of_a_run;
  d.tick = -1;
  EXPECT_FALSE(waits(d)) << "at rest";
}

TEST(Edges, ALateWordIsKnownAlsoWhereTheTimerWrapsRound) {
  constexpr std::uint32_t clocks = 84;
  for (const std::uint32_t instant : {100'000u, 5u, 0xFFFFFFF0u}) {
    EXPECT_FALSE(is_late(instant - 20 * clocks, instant, clocks));
    EXPECT_FALSE(is_late(instant - clocks, instant, clocks));
    EXPECT_TRUE(is_late(instant - clocks + 1, instant, clocks)) << "too near to be met for sure";
    EXPECT_TRUE(is_late(instant, instant, clocks));
    EXPECT_TRUE(is_late(instant + 50 * clocks, instant, clocks));
  }
}

}  // namespace
}  // namespace sinew::firmware
