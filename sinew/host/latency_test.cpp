// Statistics of given wake-up delays, and the ticks of a loop.
#include "sinew/host/realtime.h"

#include <gtest/gtest.h>

namespace sinew::host::latency_test {
namespace {

TEST(Latency, OfAThousandTheLastButOneIsWhatMostKeep) {
  std::vector<double> late(1000, 5e-6);
  late[17] = 3e-4;
  const Latency one = latency_of(late);
  EXPECT_EQ(one.median, 5e-6);
  EXPECT_EQ(one.most, 5e-6);
  EXPECT_EQ(one.worst, 3e-4);
  EXPECT_EQ(one.count, 1000u);
  late[500] = 2e-4;
  EXPECT_EQ(latency_of(late).most, 2e-4);
}

TEST(Latency, OfNoneIsZeroAndOfOneIsThatOne) {
  EXPECT_EQ(latency_of({}).worst, 0);
  const Latency one = latency_of({7e-6});
  EXPECT_EQ(one.median, 7e-6);
  EXPECT_EQ(one.most, 7e-6);
}

TEST(Latency, AClassIsAPromiseOfATick) {
  EXPECT_EQ(class_of({.most = 1e-5, .worst = 5e-5}), LatencyClass::real_time);
  EXPECT_EQ(class_of({.most = 1e-5, .worst = 5.1e-5}), LatencyClass::usual);
  EXPECT_EQ(class_of({.most = 1e-4, .worst = 1}), LatencyClass::usual);
  EXPECT_EQ(class_of({.most = 1.1e-4, .worst = 1}), LatencyClass::unfit);
  EXPECT_EQ(describe_latency({1e-6, 12e-6, 31e-6, 10'000}),
            "real-time: 10000 wake-ups, worst 31 us, 99.9 % within 12 us");
}

// Independent of the load: no thread wakes early.
TEST(TickTimer, NoTickComesBeforeItsTime) {
  TickTimer beat;
  beat.start();
  const std::int64_t start = now_ns();
  for (signals::Tick t = 0; t <= 20; t += 5) {
    const bool on_time = beat.wait_until(t);
    EXPECT_GE(now_ns() - start + 100'000, t * 100'000);
    EXPECT_EQ(on_time, beat.behind() == 0);
  }
}

TEST(TickTimer, WhatHasPassedIsReportedAsTicksBehind) {
  TickTimer beat;
  beat.start();
  sleep_until_ns(now_ns() + 3'000'000);
  EXPECT_FALSE(beat.wait_until(10));
  EXPECT_GE(beat.behind(), 20);
}

}  // namespace
}  // namespace sinew::host::latency_test
