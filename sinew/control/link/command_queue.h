// control/link/command_queue.h - received commands, from their arrival until their last period.
//
//   period      0        1        2        3        4
//   command           from = 1, periods = 2: valid in 1 and 2, expired in 3
//
// An expired command is refused, and so is one more than `ahead` periods before its time. When a
// command begins, those that began before it expire, even if they were valid for longer. Of
// two that begin together the later received one is used. If no command is valid, at() returns
// nullptr: the host is lost, and the board has to react (it vents).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/link/messages.h"

namespace sinew::link {

class CommandQueue {
 public:
  static constexpr std::size_t ahead = 4;  // periods that a command may arrive before its time

  // `period` is in ticks.
  constexpr explicit CommandQueue(std::uint16_t period) noexcept : period_(period) {}

  // Adds a command. `begun` is the first tick of the current period, whose command is in use
  // already. Returns done, past, future, or period.
  constexpr Code put(const CommandFor& command, signals::Tick begun) noexcept {
    const signals::Tick before = command.from - begun;  // both are within max_tick
    if (before > signals::Tick{ahead} * period_) return Code::future;
    // It may be valid in the current period already; it has to be valid in a later one too.
    if (before + signals::Tick{command.periods} * period_ <= period_) return Code::past;
    if (command.from < newest_) return Code::past;
    if (static_cast<std::int32_t>(before) % period_ != 0) return Code::period;
    place_for(command.from) = {command, true};
    return Code::done;
  }

  // Returns the command for the period that begins at this tick, or nullptr. Ticks must not
  // decrease.
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

  // Removes all commands.
  constexpr void clear() noexcept { *this = CommandQueue(period_); }

 private:
  struct Slot {
    CommandFor command;
    bool used = false;
  };

  // Returns the slot of a command that begins at the same time, a free slot, or the oldest one.
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
  signals::Tick newest_ = 0;  // begin of the last command that has begun
  // future commands, and the current one
  std::array<Slot, ahead + 1> slot_;
};

}  // namespace sinew::link
