// control/link/baud.h - how fast a line must be for what a board says and is told in each period.
//
// A byte takes ten bits on a serial line. Of each direction at most 90 % is used: senders start
// late, and clocks differ.
//
//   to the host    all parts of the telemetry; edges where they are wanted, at most four of a valve
//                  in a period (pulse_train.h: two of a law, two of the law before it); an answer
//                  without text; an event
//   to the board   a command for all joints, gains of one joint
//
// Configuring and reading the fault log happen while no joint runs, and take as long as they take.
#pragma once

#include <cstdint>
#include <span>

#include "sinew/control/joint/config.h"

namespace sinew::link {

struct Load {
  std::uint32_t to_host = 0, to_board = 0;  // [bytes] in a period, at most
};

// Returns the bytes that a board of this configuration says and is told.
Load load_of(const control::JointControllerConfig& config, bool edges_wanted) noexcept;

// Does a line of so many bits a second carry it?
bool carries(std::uint32_t baud, const Load& load, std::uint16_t period) noexcept;

// The rate of firmware/application.cpp  [bits/s].
inline constexpr std::uint32_t firmware_baud = 921'600;

// The slowest of the choices that carries all, 0 where none does.
std::uint32_t choose_baud(const control::JointControllerConfig& config, bool edges_wanted,
                          std::span<const std::uint32_t> choices) noexcept;

}  // namespace sinew::link
