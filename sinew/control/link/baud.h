// control/link/baud.h - rate of a line that carries all messages of each period.
//
// A byte takes ten bits on a serial line. At most 90 % of each direction is used, since senders
// start late and clocks differ.
//
//   to the host    all parts of the telemetry; edges if they are requested, at most four of a valve
//                  in a period (pulse_train.h: two of a law, two of the law before it); a reply
//                  without text; an event
//   to the board   a command for all joints, gains of one joint
//
// Configuration and the fault log are sent outside runs and may take longer than a period.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/control/joint/config.h"

namespace sinew::link {

struct LineLoad {
  std::uint32_t to_host = 0, to_board = 0;  // largest number in a period [bytes]
};

// Returns the bytes that a board of this configuration sends and receives.
LineLoad load_of(const control::JointControllerConfig& config, bool edges_wanted) noexcept;

// Returns whether a line of that rate [bits/s] carries the load.
bool carries(std::uint32_t baud, const LineLoad& load, std::uint16_t period) noexcept;

// Rate of firmware/application.cpp [bits/s].
inline constexpr std::uint32_t firmware_baud = 921'600;

// Returns the slowest of the choices that carries all messages, or 0 if none does.
std::uint32_t choose_baud(const control::JointControllerConfig& config, bool edges_wanted,
                          std::span<const std::uint32_t> choices) noexcept;

}  // namespace sinew::link
