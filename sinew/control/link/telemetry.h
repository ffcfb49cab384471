// control/link/telemetry.h - state of a board at a period's start, split into messages and joined
// again, bit for bit.
//
// Part 0 is the state, then follow readings, counters and joints. They are sent in that
// order, which a line preserves: if one is missing, its period is lost and counted. Missing data
// are not replaced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/link/reports.h"

namespace sinew::link {

struct Telemetry {
  signals::Tick tick = 0;  // first tick of a period
  control::BoardState state = control::BoardState::fault;
  control::BoardFault fault = control::BoardFault::none;
  std::uint8_t joints = 0, channels = 0;  // numbers of the board; only these are sent
  control::ControllerState controller;
  control::Supervised supervised;
  LinkStatistics link;
};

// Returns the highest converted channel plus one.
std::uint8_t channels_of(const control::JointControllerConfig& config) noexcept;

// Returns the number of messages for that many items.
constexpr std::size_t messages_for(std::size_t things, std::size_t in_message) noexcept {
  return (things + in_message - 1) / in_message;
}
// Returns the number of telemetry messages of a period.
constexpr std::size_t parts_of(std::size_t joints, std::size_t channels) noexcept {
  return 2 + messages_for(channels, counters_in_message) + messages_for(joints, joints_in_message);
}
static_assert(parts_of(control::max_joints, control::max_channels) <= max_parts);

// Message of a part; its body is not ok if the part does not exist or a value is invalid.
struct TelemetryMessage {
  Type type = Type::state;
  Body body;
};
TelemetryMessage part_of(const Telemetry& telemetry, std::uint8_t part) noexcept;

// Returns the readings alone, for a request of them.
Readings readings_alone(const Telemetry& telemetry) noexcept;

// Receiver of the host.
class TelemetryJoiner {
 public:
  // `period` is in ticks.
  explicit TelemetryJoiner(std::uint16_t period) noexcept : period_(period) {}

  // Takes a message of a board, of any type. Returns the period's telemetry if this was its last
  // part, valid until the next call; else nullptr.
  const Telemetry* take(std::uint8_t type, std::span<const std::uint8_t> body) noexcept;

  // Returns the periods with a missing part between the first and the last complete one.
  std::uint32_t lost() const noexcept { return lost_; }

 private:
  bool begin(std::span<const std::uint8_t> body) noexcept;
  bool add(std::uint8_t type, std::span<const std::uint8_t> body) noexcept;
  bool add_readings(std::span<const std::uint8_t> body) noexcept;
  bool add_counters(std::span<const std::uint8_t> body) noexcept;
  bool add_joints(std::span<const std::uint8_t> body) noexcept;
  bool continues(const Part& part) const noexcept;
  void count_lost() noexcept;

  Telemetry now_;
  std::uint8_t next_ = 0;  // next expected part; 0: first part of the next period
  std::uint16_t period_;
  signals::Tick last_ = -1;  // last complete one
  std::uint32_t lost_ = 0;
};

}  // namespace sinew::link
