// firmware/tick_count.h - number of ticks since the timer's last interrupt, measured by a second
// timer that runs freely.
//
//   an interrupt    on time      late by 0.9        one was lost, late by 0.2
//   clocks          1.0 ticks    1.9                2.2
//   passed          1            1, and 1 after it  2
//
// An interrupt may be late but never early, so parts of a tick are not counted. If they were
// rounded up, one late tick would be counted twice and the next lost one would not be noticed.
#pragma once

#include <cstdint>

namespace sinew::firmware {

class TickCount {
 public:
  // `now` is a count of clocks that increases and wraps round.
  void start(std::uint32_t clocks_a_tick, std::uint32_t now) {
    clocks_a_tick_ = clocks_a_tick;
    last_ = now;
  }

  // Returns the ticks since the last call. 0: the previous call already counted this tick, since it
  // began before that call read the clock.
  std::uint32_t passed(std::uint32_t now) {
    const std::uint32_t early = clocks_a_tick_ / 64;  // largest difference of the two timers
    const std::uint32_t ticks = (now - last_ + early) / clocks_a_tick_;
    last_ += ticks * clocks_a_tick_;
    return ticks;
  }

  // Returns the time at which the last counted tick began [clocks].
  std::uint32_t began() const { return last_; }

 private:
  std::uint32_t clocks_a_tick_ = 1, last_ = 0;
};

}  // namespace sinew::firmware
