// firmware/edges.h - switching of valves at a fixed instant of a tick, independent of the tick's
// computing time and of interrupts. The tick leaves the word for the pins here; a timer's compare
// interrupt, which is short and has the highest priority, outputs it.
//
//   the tick's interrupt:       clear(), then the pins; or set() and the compare's instant
//   the compare's interrupt:    take(), and write that word to the pins
//
// Code that writes to the pins itself drops the waiting word first. After that no older word can
// reach the pins: the interrupt either came before and is overwritten, or finds no word.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/board.h"

namespace sinew::firmware {

inline constexpr std::uint32_t edge_delay = 20;  // time from a tick's beginning to its edges [us]
inline constexpr std::uint32_t edge_margin = 1;  // shortest wait that the compare can meet [us]

// Returns whether a word waits for its instant: only a run's switching does. All else is output at
// once: coils without current, a dump of the supply, a board at rest.
constexpr bool waits(const hardware::Drive& drive) {
  return drive.tick >= 0 && drive.current && drive.supply;
}

// Returns whether it is too late to wait for `instant`. Both are counts of a free-running timer.
constexpr bool is_late(std::uint32_t now, std::uint32_t instant, std::uint32_t clocks_a_us) {
  return static_cast<std::int32_t>(instant - now) <
         static_cast<std::int32_t>(edge_margin * clocks_a_us);
}

template <class Word>
class WaitingWord {
 public:
  void set(const Word& word) {
    clear();
    word_ = word;
    waits_.store(true, std::memory_order_release);
  }
  void clear() {
    waits_.store(false, std::memory_order_relaxed);
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
  // Returns false if no word waits or another caller took it. If two callers take at the same time,
  // both get the same word.
  bool take(Word& word) {
    if (!waits_.load(std::memory_order_acquire)) return false;
    word = word_;
    waits_.store(false, std::memory_order_release);
    return true;
  }

 private:
  Word word_{};
  std::atomic<bool> waits_ = false;
};

}  // namespace sinew::firmware
