// firmware/tick_count.h - how many ticks have passed since the last interrupt of the timer, by a
// second timer that never stops.
//
//   an interrupt    on time      late by 0.9        one was lost, late by 0.2
//   clocks          1.0 ticks    1.9                2.2
//   passed          1            1, and 1 after it  2
//
// It may come as late as it likes, it never comes early: parts of a tick are not counted yet. A
// board that rounded them up would count one late tick twice, and see the next one that is lost no
// more.
#pragma once

#include <cstdint>

namespace sinew::firmware {

class TickCount {
 public:
  // `now` counts the clocks up and wraps round.
  void start(std::uint32_t clocks_a_tick, std::uint32_t now) {
    clocks_a_tick_ = clocks_a_tick;
    last_ = now;
  }

  // At least 1: who asks is in a tick. One that was counted before, as it came while the one before
  // it was looking at the clock, is not taken off again.
  std::uint32_t passed(std::uint32_t now) {
    const std::uint32_t early = clocks_a_tick_ / 64;  // between the two timers, at most
    const std::uint32_t ticks = (now - last_ + early) / clocks_a_tick_;
    last_ += ticks * clocks_a_tick_;
    return ticks > 0 ? ticks : 1;
  }

  // When the tick began that was counted last, by the clocks.
  std::uint32_t began() const { return last_; }

 private:
  std::uint32_t clocks_a_tick_ = 1, last_ = 0;
};

}  // namespace sinew::firmware
