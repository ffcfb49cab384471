// control/link/command_queue.h - commands that have come, until their period begins and as long as
// they are good.
//
//   period      0        1        2        3        4
//   command           from = 1, periods = 2: good for 1 and 2, over in 3
//
// One that is over is refused, and so is one more than `ahead` periods before its time. When one
// begins, those that began before it are over, however long they were good for: nothing goes back
// to them. Of two that begin together the one that came last is taken. Where none is good, the host
// is lost and at() says so: what then happens is the board's affair (it vents).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/link/messages.h"

namespace sinew::link {

class CommandQueue {
 public:
  static constexpr std::size_t ahead = 4;  // periods that a command may come before its time

  // `period` in ticks.
  constexpr explicit CommandQueue(std::uint16_t period) noexcept : period_(period) {}

  // `begun`: the first tick of the period that runs now, whose command is taken already. Done,
  // past, future, or period.
  constexpr Code put(const CommandFor& command, signals::Tick begun) noexcept {
    const signals::Tick before = command.from - begun;  // both are within max_tick
    if (before > signals::Tick{ahead} * period_) return Code::future;
    // It may be good for the period that runs; only what is still to come counts.
    if (before + signals::Tick{command.periods} * period_ <= period_) return Code::past;
    if (command.from < newest_) return Code::past;
    if (static_cast<std::int32_t>(before) % period_ != 0) return Code::period;
    place_for(command.from) = {command, true};
    return Code::done;
  }

  // At a period's first tick: its command, nullptr where there is none. Ticks never decrease.
  constexpr const CommandFor* at(signals::Tick begins) noexcept {
    const CommandFor* out = nullptr;
    for (const Slot& s : slot_)
      if (s.used && s.command.from <= begins && s.command.from >= newest_) {
        newest_ = s.command.from;
        out = &s.command;
      }
    for (Slot& s : slot_)
      if (s.command.from < newest_) s.used = false;
    return out && begins < out->from + signals::Tick{out->periods} * period_ ? out : nullptr;
  }

  // Forgets all of them.
  constexpr void clear() noexcept { *this = CommandQueue(period_); }

 private:
  struct Slot {
    CommandFor command;
    bool used = false;
  };

  // The place of the one that begins together with it, a free one, or the one that began first.
  constexpr Slot& place_for(signals::Tick from) noexcept {
    Slot* out = &slot_[0];
    for (Slot& s : slot_)
      if (s.used && s.command.from == from) return s;
    for (Slot& s : slot_) {
      if (!s.used) return s;
      if (s.command.from < out->command.from) out = &s;
    }
    return *out;
  }

  std::uint16_t period_;
  signals::Tick newest_ = 0;  // of those that have begun, the last
  // Those to come, and the one that holds.
  std::array<Slot, ahead + 1> slot_;
};

}  // namespace sinew::link
