// control/joint/pulse_train.h - one valve's edges: pulse width modulation as in appendix B.
//
// The interrupt routine of the thesis looks at each valve in every tick; its state and the count of
// ticks since the law, 1 in the law's own tick, decide:
//
//   on       switched off at the first count >= closing[duty]; looked at again in the next tick
//   off      switched on at the first count >= opening[duty], and then let alone until the next law
//   disabled switched off in the law's tick, let alone otherwise
//
// So the duty of one period decides at its end whether the valve goes on, and the duty of the next
// one when it goes off: from 0 to d costs a period, from d to 0 leaves a pulse of a tick. All that
// is known when the law runs. A train therefore keeps the edges to come, not the state to poll.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sinew/control/joint/command.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

// What the train needs to know of its law's duty.
struct Pulse {
  std::int32_t closing = 0, opening = 0;  // counts of ticks, from the timing table
  std::int32_t period = 100;              // [ticks]
  std::int32_t delay = 1;                 // [ticks] from decision to edge, 1 .. period
};

class PulseTrain {
 public:
  static constexpr signals::Tick never = std::numeric_limits<signals::Tick>::max();

  // The law has run at tick `law`: all edges until the next law.
  constexpr void cycle(signals::Tick law, const Pulse& pulse, bool enabled) noexcept {
    const signals::Tick before_first = law - 1 + pulse.delay;  // edge of a decision at count 0
    std::int32_t count = 1;
    if (on_) {
      const std::int32_t close = !enabled || pulse.closing < 1 ? 1 : pulse.closing;
      if (close > pulse.period) return;
      toggle_at(before_first + close);
      count = close + 1;
    }
    if (!enabled) return;
    const std::int32_t open = pulse.opening < count ? count : pulse.opening;
    if (open <= pulse.period) toggle_at(before_first + open);
  }

  // On in [from, until), off after; whatever was to come is dropped.
  constexpr void pulse(signals::Tick from, signals::Tick until) noexcept {
    if (until <= from) return shut(from);
    forget();
    if (!on_) toggle_at(from);
    toggle_at(until);
  }

  // Turns the valve on in this opening of the period that starts now. All earlier edges were
  // driven.
  constexpr void open(signals::Tick start, std::int32_t period, const Opening& opening) noexcept {
    const std::int32_t from = opening.from, until = opening.until;
    const bool at_both_ends = until < from;
    turn(start, at_both_ends ? until > 0 : from == 0 && until > 0);
    if (at_both_ends) turn(start + until, false);
    if (from != until && from < period) turn(start + from, true);
    if (!at_both_ends && until < period) turn(start + until, false);
  }

  // Off from `at` on.
  constexpr void shut(signals::Tick at) noexcept {
    forget();
    if (on_) toggle_at(at);
  }

  // Returns when the next edge is due, and whether it opens the valve.
  constexpr signals::Tick next() const noexcept { return waiting_ ? edge_[first_] : never; }
  constexpr bool next_opens() const noexcept { return !driven_; }

  // The next edge has been driven.
  constexpr void drive() noexcept {
    driven_ = !driven_;
    first_ = static_cast<std::uint8_t>((first_ + 1) % capacity);
    --waiting_;
  }

 private:
  // Two of this period and, with a delay, two of the last one.
  static constexpr std::uint8_t capacity = 4;

  constexpr void forget() noexcept {
    waiting_ = 0;
    on_ = driven_;
  }

  constexpr void turn(signals::Tick at, bool on) noexcept {
    if (on_ != on) toggle_at(at);
  }

  constexpr void toggle_at(signals::Tick at) noexcept {
    edge_[(first_ + waiting_) % capacity] = at;
    ++waiting_;
    on_ = !on_;
  }

  std::array<signals::Tick, capacity> edge_{};  // to come, ascending, from first_ on
  std::uint8_t first_ = 0, waiting_ = 0;
  bool on_ = false;      // after the edges to come
  bool driven_ = false;  // after the edges driven
};

}  // namespace sinew::control
