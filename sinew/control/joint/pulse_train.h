// control/joint/pulse_train.h - edges of one valve: pulse width modulation as in appendix B.
//
// The thesis's interrupt routine checks each valve in every tick, by the valve's state and the
// number of ticks since the law, which is 1 in the law's own tick:
//
//   on       switched off at the first count >= closing[duty]; checked again in the next tick
//   off      switched on at the first count >= opening[duty], then not checked until the next law
//   disabled switched off in the law's tick, otherwise not changed
//
// So the duty of one period decides at its end whether the valve opens, and the duty of the next
// one when it closes: a change from 0 to d is delayed by a period, one from d to 0 leaves a
// pulse of a tick. All this is determined when the law runs, so a train stores future edges
// instead of a state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sinew/control/joint/command.h"
#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::control {

// Parameters of a pulse, from its law's duty.
struct Pulse {
  std::int32_t closing = 0, opening = 0;  // counts of ticks, from the timing table
  std::int32_t period = 100;              // [ticks]
  std::int32_t delay = 1;                 // from decision to edge, 1 .. period [ticks]
};

class PulseTrain {
 public:
  static constexpr signals::Tick never = std::numeric_limits<signals::Tick>::max();

  // Plans all edges until the next law, when a law has run at tick `law`.
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

  // Opens the valve in [from, until) and drops all other future edges.
  constexpr void pulse(signals::Tick from, signals::Tick until) noexcept {
    if (until <= from) return shut(from);
    drop_future_edges();
    if (!on_) toggle_at(from);
    toggle_at(until);
  }

  // Opens the valve for this opening of the period that starts now. All earlier edges must have
  // been driven.
  constexpr void open(signals::Tick start, std::int32_t period, const Opening& opening) noexcept {
    const std::int32_t from = opening.from, until = opening.until;
    const bool at_both_ends = until < from;
    turn(start, at_both_ends ? until > 0 : from == 0 && until > 0);
    if (at_both_ends) turn(start + until, false);
    if (from != until && from < period) turn(start + from, true);
    if (!at_both_ends && until < period) turn(start + until, false);
  }

  // Shuts the valve from `at` on.
  constexpr void shut(signals::Tick at) noexcept {
    drop_future_edges();
    if (on_) toggle_at(at);
  }

  // Return the tick of the next edge, and whether that edge opens the valve.
  constexpr signals::Tick next() const noexcept { return waiting_ ? edge_[first_] : never; }
  constexpr bool next_opens() const noexcept { return !driven_; }

  // Marks the next edge as driven.
  constexpr void drive() noexcept {
    driven_ = !driven_;
    first_ = static_cast<std::uint8_t>((first_ + 1) % capacity);
    --waiting_;
  }

 private:
  // two edges of this period and, with a delay, two of the last one
  static constexpr std::uint8_t capacity = 4;

  constexpr void drop_future_edges() noexcept {
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

  std::array<signals::Tick, capacity> edge_{};  // future edges, ascending, starting at first_
  std::uint8_t first_ = 0, waiting_ = 0;
  bool on_ = false;      // state after all future edges
  bool driven_ = false;  // state after the driven edges
};

}  // namespace sinew::control
