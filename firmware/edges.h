// firmware/edges.h - valves switch at one instant of a tick, however long the tick has worked and
// whatever has interrupted it: the tick leaves the word for the pins here, and a timer's compare
// fetches it, by a short interrupt above all others.
//
//   the tick's interrupt:       forget(), then the pins; or leave() and the compare's instant
//   the compare's interrupt:    take(), and what it took goes to the pins
//
// Whoever puts a word by himself forgets the waiting one first. From then on nothing older reaches
// the pins: the interrupt came before, and is overwritten, or finds nothing.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/board.h"

namespace sinew::firmware {

inline constexpr std::uint32_t edge_delay = 20;  // [us] from a tick's beginning to its edges
inline constexpr std::uint32_t edge_margin = 1;  // [us] the compare may miss what is nearer

// A run's switching waits for its instant. All else acts at once: coils without current, a dump of
// the supply, a board at rest.
constexpr bool waits(const hardware::Drive& drive) {
  return drive.tick >= 0 && drive.current && drive.supply;
}

// Is it too late to wait for `instant`? Both are counts of a timer that runs for ever.
constexpr bool is_late(std::uint32_t now, std::uint32_t instant, std::uint32_t clocks_a_us) {
  return static_cast<std::int32_t>(instant - now) <
         static_cast<std::int32_t>(edge_margin * clocks_a_us);
}

template <class Word>
class WaitingWord {
 public:
  void leave(const Word& word) {
    forget();
    word_ = word;
    waits_.store(true, std::memory_order_release);
  }
  void forget() {
    waits_.store(false, std::memory_order_relaxed);
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
  // false: there is none, or somebody else had it. Where both take at a time, it is the same word.
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
