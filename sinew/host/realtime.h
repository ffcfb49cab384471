// host/realtime.h - real time on this computer: thread priority, locked memory, periodic ticks, and
// wake-up latency.
//
// While a RealTime exists, the calling thread has priority over ordinary threads, and the memory of
// its process is locked, as far as the user's limits permit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/signals/tick.h"

namespace sinew::host {

// Above the kernel's interrupt threads (50), below the threads that keep the kernel itself running.
inline constexpr int priority = 80;

// Raises the thread's priority on construction and resets it on destruction.
class RealTime {
 public:
  // Allocate memory before: later allocations are not locked. Never throws; skips what is not
  // permitted.
  RealTime() noexcept;
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  bool has_priority() const noexcept { return has_priority_; }  // SCHED_FIFO
  bool locked() const noexcept { return locked_; }              // present memory is locked

 private:
  bool has_priority_ = false, locked_ = false;
};

// Returns what was not permitted, with advice; empty if everything was.
std::vector<std::string> problems(const RealTime& real_time);

// Measured latency of wake-ups of a program that sleeps until a tick.
//
// A valve's edge and a conversion are as late as the preceding wake-up. A kernel without real-time
// guarantees is usually late by tens of microseconds, and occasionally by milliseconds.

// Latency of `count` wake-ups [s].
struct Latency {
  double median = 0, most = 0, worst = 0;  // most: exceeded by 0.1 %
  std::size_t count = 0;
};

// Suitability for a loop with that tick.
enum class LatencyClass {
  real_time,  // never later than half a tick: edges are in their own tick
  usual,      // 99.9 % within a tick: an edge is late occasionally, and counted
  unfit       // more often later than a tick
};

// Sleeps from tick to tick for `seconds`. Allocates its memory first.
Latency measure_latency(double seconds, double tick = signals::tick_seconds);

// Returns the statistics of wake-ups from their delays in any order [s]. Empty: all 0.
Latency latency_of(std::vector<double> late);

// Returns the suitability of a computer with that latency for ticks of `tick` seconds.
LatencyClass class_of(const Latency& latency, double tick = signals::tick_seconds);

// Returns the latency as text: "real-time: 10000 wake-ups, worst 31 us, 99.9 % within 12 us".
std::string describe_latency(const Latency& latency, double tick = signals::tick_seconds);

// Monotonic clock in ticks, for a loop that drives hardware and sleeps from tick to tick.

// Returns the time of the monotonic clock [ns].
std::int64_t now_ns() noexcept;
// Sleeps until an instant; returns at once if it has passed. Signals do not interrupt it.
void sleep_until_ns(std::int64_t instant) noexcept;

// Waits for the ticks of a machine by this computer's clock.
class TickTimer {
 public:
  // Sets tick 0 to now; without a call it is at the first wait_until().
  void start() noexcept;

  // Sleeps until the tick. Returns false if it is then more than a tick late.
  bool wait_until(signals::Tick tick) noexcept;

  // Returns the delay of the last wait [ticks], 0 if it was in time.
  signals::Tick behind() const noexcept { return behind_; }

 private:
  std::int64_t start_ = -1;  // [ns]
  signals::Tick behind_ = 0;
};

}  // namespace sinew::host
