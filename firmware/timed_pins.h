// firmware/timed_pins.h - output of a board's pins with a free-running timer that has a compare:
// the ticks that have passed, and the words that wait for their instant (edges.h).
#pragma once

#include "firmware/cortex_m.h"
#include "firmware/edges.h"
#include "firmware/level.h"
#include "firmware/tick_count.h"

namespace sinew::firmware {

// Returns the levels of the coils' pins: at rest without current, whatever the word has.
constexpr std::uint32_t coils_of(const hardware::Drive& d) {
  return d.current ? d.coils : control::rest_word(low_gives_current);
}

// Registers of the timer, which counts upwards.
struct CompareTimer {
  std::uintptr_t count, compare;
  std::uint32_t clocks_a_us;
};

// `put` writes a word to the ports.
template <class Pins, void (*put)(const Pins&), CompareTimer timer>
class TimedPins {
 public:
  // A tick begins now.
  void start() { count_.start(100 * timer.clocks_a_us, cortex_m::reg(timer.count)); }
  std::uint32_t ticks_passed() { return count_.passed(cortex_m::reg(timer.count)); }

  // Outputs the word of hardware::drive() at its instant, or at once.
  void drive(const hardware::Drive& d, const Pins& pins) {
    if (!waits(d)) {
      waiting_.clear();
      put(pins);
      return;
    }
    const std::uint32_t instant = count_.began() + edge_delay * timer.clocks_a_us;
    waiting_.set(pins);
    cortex_m::reg(timer.compare) = instant;
    if (is_late(cortex_m::reg(timer.count), instant, timer.clocks_a_us)) put_late();
  }

  // Outputs a word that is still waiting. The tick's interrupt calls it, so that none waits longer
  // than a tick even if the compare failed.
  void put_late() {
    if (put_due()) late_ = late_ + 1;
  }
  // Outputs the waiting word. The compare's interrupt calls it first: any code before it would
  // delay the edge. Returns false if no word waits.
  bool put_due() {
    Pins pins;
    if (!waiting_.take(pins)) return false;
    put(pins);
    return true;
  }

 private:
  TickCount count_;
  WaitingWord<Pins> waiting_;
  volatile std::uint32_t late_ = 0;  // words that missed their instant, for a debugger
};

}  // namespace sinew::firmware
