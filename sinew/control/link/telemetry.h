// control/link/telemetry.h - all that a board knows at a period's start, cut into messages and
// joined again, bit for bit.
//
// part 0 is the state, then come readings, counters and joints. They are sent in that order, and a
// line keeps the order: where one is missing, its period is lost and is counted. Nothing is made up
// for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/link/reports.h"

namespace sinew::link {

struct Telemetry {
  signals::Tick tick = 0;  // the first of a period
  control::BoardState state = control::BoardState::fault;
  control::BoardFault fault = control::BoardFault::none;
  std::uint8_t joints = 0, channels = 0;  // the board's: what is beyond is not sent
  control::Seen seen;
  control::Supervised supervised;
  LinkSeen link;
};

// One more than the last channel that is converted.
std::uint8_t channels_of(const control::JointControllerConfig& config) noexcept;

// Returns how many messages so many things take.
constexpr std::size_t messages_for(std::size_t things, std::size_t in_message) noexcept {
  return (things + in_message - 1) / in_message;
}
// Returns how many messages the telemetry of a period has.
constexpr std::size_t parts_of(std::size_t joints, std::size_t channels) noexcept {
  return 2 + messages_for(channels, counters_in_message) + messages_for(joints, joints_in_message);
}
static_assert(parts_of(control::max_joints, control::max_channels) <= max_parts);

// A part's message; not ok where there is no such part, or a value cannot be.
struct TelemetryMessage {
  Type type = Type::state;
  Body body;
};
TelemetryMessage part_of(const Telemetry& telemetry, std::uint8_t part) noexcept;

// The readings without the rest, for who asks for them.
Readings readings_alone(const Telemetry& telemetry) noexcept;

// A host's side.
class TelemetryJoiner {
 public:
  // `period` in ticks.
  explicit TelemetryJoiner(std::uint16_t period) noexcept : period_(period) {}

  // A message of a board, of any type. The telemetry of a period whose last part this was, until
  // the next call; else nullptr.
  const Telemetry* take(std::uint8_t type, std::span<const std::uint8_t> body) noexcept;

  // Periods of which a part is missing, between the first and the last whole one.
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
  std::uint8_t next_ = 0;  // the part that is waited for; 0: the next period's first
  std::uint16_t period_;
  signals::Tick last_ = -1;  // the last whole one
  std::uint32_t lost_ = 0;
};

}  // namespace sinew::link
