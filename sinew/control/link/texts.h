// control/link/texts.h - texts for refusals and for faults of a board, for a host's messages.
#pragma once

#include "sinew/control/link/messages.h"
#include "sinew/control/supervise/safety.h"

namespace sinew::link {

// Returns the meaning of a code that a board replies with.
constexpr const char* to_text(Code code) noexcept {
  switch (code) {
    case Code::done:
      return "nothing is wrong";
    case Code::version:
      return "it uses another version of the protocol";
    case Code::type:
      return "it has no such message";
    case Code::length:
      return "the message has not the length of its type";
    case Code::value:
      return "a number in it cannot be";
    case Code::state:
      return "not in the state that it is in now";
    case Code::sequence:
      return "it has seen this frame before";
    case Code::past:
      return "the command came after its time";
    case Code::future:
      return "the command is more than 4 periods ahead";
    case Code::period:
      return "the command does not begin with a period";
    case Code::order:
      return "a part of the configuration came before its beginning, or that twice";
    case Code::gap:
      return "a part of the configuration is missing";
    case Code::size:
      return "the configuration has another number of bytes than its firmware expects";
    case Code::checksum:
      return "the configuration's checksum does not fit";
    case Code::layout:
      return "the configuration has another layout, or a number that cannot be";
    case Code::configuration:
      return "parts of the configuration contradict each other";
    case Code::nonce:
      return "it has another configuration, or has been reset since";
  }
  return "an unknown reply";
}

// Returns what a fault of a board is.
constexpr const char* to_text(control::BoardFault fault) noexcept {
  using control::BoardFault;
  switch (fault) {
    case BoardFault::none:
      return "nothing is wrong";
    case BoardFault::power_up:
      return "it was switched on or reset";
    case BoardFault::watchdog:
      return "its watchdog has reset it";
    case BoardFault::supervisor:
      return "a reading, a command or its clock was not to be believed";
    case BoardFault::controller:
      return "readings did not come";
    case BoardFault::host_silent:
      return "it did not hear the host";
    case BoardFault::held_too_long:
      return "its valves were shut for as long as they may be";
    case BoardFault::parameters:
      return "the constants in its memory have changed";
    case BoardFault::state:
      return "the state in its memory has changed";
    case BoardFault::not_empty:
      return "something was still under pressure after the longest vent";
    case BoardFault::requested:
      return "a host has requested it";
  }
  return "an unknown reason";
}

}  // namespace sinew::link
