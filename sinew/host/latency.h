// host/latency.h - how late this computer wakes a program that sleeps to a tick, measured.
//
// A valve's edge and a conversion are as late as the wake-up before them. A kernel without a
// promise is late by tens of microseconds as a rule, and by milliseconds now and then.
#pragma once

#include <string>
#include <vector>

#include "sinew/signals/tick.h"

namespace sinew::host {

// Of so many wake-ups  [s].
struct Latency {
  double median = 0, most = 0, worst = 0;  // most: 99.9 % are no later
  std::size_t count = 0;
};

// What a loop at that tick may expect.
enum class LatencyClass {
  real_time,  // never later than half a tick: an edge stands in its own tick
  usual,      // 99.9 % within a tick: an edge is late now and then, and counted
  unfit       // later than a tick more often than that
};

// Sleeps from tick to tick for that long. Takes its memory before.
Latency measure_latency(double seconds, double tick = signals::tick_seconds);

// Of wake-ups that were that late; any order. Empty: all 0.
Latency latency_of(std::vector<double> late);

// Returns what a computer that wakes so late may drive, in ticks of that many seconds.
LatencyClass class_of(const Latency& latency, double tick = signals::tick_seconds);

// "real-time: 10000 wake-ups, worst 31 us, 99.9 % within 12 us".
std::string in_words(const Latency& latency, double tick = signals::tick_seconds);

}  // namespace sinew::host
