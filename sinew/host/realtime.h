// host/realtime.h - time on this computer: a thread that comes before all others, a beat that it
// keeps, and how late it wakes.
//
// For as long as a Realtime lives the calling thread comes before all others and its
// memory stays where it is, as far as this user may ask for that.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/signals/tick.h"

namespace sinew::host {

// Above a kernel's threads of interrupts (50), below those that keep the kernel itself alive.
inline constexpr int priority = 80;

// Puts the thread first when it is made, and back when it ends.
class RealTime {
 public:
  // Take memory before: what comes later is not locked. Never throws: what is not permitted is
  // left out.
  RealTime() noexcept;
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  bool first() const noexcept { return first_; }    // SCHED_FIFO
  bool locked() const noexcept { return locked_; }  // what it has of memory

 private:
  bool first_ = false, locked_ = false;
};

// What was not permitted, and what to do about it; empty where all was.
std::vector<std::string> problems(const RealTime& real_time);

// How late this computer wakes a program that sleeps to a tick, measured.
//
// A valve's edge and a conversion are as late as the wake-up before them. A kernel without a
// promise is late by tens of microseconds as a rule, and by milliseconds now and then.

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

// The wall's clock in ticks: who drives a machine that does not wait for him sleeps
// from tick to tick by it.

// Of the clock that no one sets  [ns].
std::int64_t now_ns() noexcept;
// Returns at once where the instant has passed. A signal's handler does not end it.
void sleep_until_ns(std::int64_t instant) noexcept;

// Gives the ticks of a machine by the clock of this computer.
class Beat {
 public:
  // Tick 0 is at the first wait_until, or from here on.
  void start() noexcept;

  // Sleeps to that tick. False where it is later than a tick by then.
  bool wait_until(signals::Tick tick) noexcept;

  // By how much the last wait ended too late  [ticks], 0 where it did not.
  signals::Tick behind() const noexcept { return behind_; }

 private:
  std::int64_t start_ = -1;  // [ns]
  signals::Tick behind_ = 0;
};

}  // namespace sinew::host
