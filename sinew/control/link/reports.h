// control/link/reports.h - reports of a board to a host (docs/reference/wire.md has the bytes).
//
// The telemetry of a period is several messages with the same tick and numbered parts: together
// they contain all of control::ControllerState and control::Supervised, bit for bit, for the
// board's joints and channels (telemetry.h splits and joins them). A lost message leaves a gap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sinew/control/joint/state.h"
#include "sinew/control/link/messages.h"
#include "sinew/control/supervise/safety.h"

namespace sinew::link {

inline constexpr std::size_t name_size = 16;
using Name = std::array<char, name_size>;  // padded with zeros

// Identity and state of the board.
struct Identity {
  static constexpr Type type = Type::identity;
  std::uint8_t protocol = protocol_version;
  control::BoardState state = control::BoardState::fault;
  Name firmware{}, board{};
  std::uint32_t configuration = 0;  // crc32 of the current one; 0: none
  std::uint16_t configuration_bytes = 0;
  std::uint8_t joints = 0, channels = 0, conversions = 0;  // largest numbers
  signals::Tick tick = 0;
  control::BoardFault fault = control::BoardFault::none;  // reason for its state
  bool active_low = false;                                // level 0 gives current in a coil
};

inline constexpr std::size_t max_text = 100;
// Reply to a message.
struct Reply {
  static constexpr Type type = Type::answer;
  std::uint8_t to = 0, sequence = 0;  // type and sequence of the message
  Code code = Code::done;
  std::uint32_t value = 0;  // arm_first: the board's number
  std::uint8_t letters = 0;
  std::array<char, max_text> text{};  // reason for a refusal
};

// Counts of frames that the board has discarded.
struct LinkStatistics {
  LineCount line;
  std::uint32_t refused = 0;   // messages that were refused with a code
  std::uint32_t lost = 0;      // frames, by gaps in the sequence
  std::uint32_t repeated = 0;  // repeated frames
  std::uint32_t late = 0;      // commands that came too late

  friend constexpr bool operator==(const LinkStatistics&, const LinkStatistics&) = default;
};

// Part of the telemetry of one tick: 0 .. parts - 1.
struct Part {
  signals::Tick tick = 0;  // first tick of a period, as for the gait controller
  std::uint8_t part = 0, parts = 1;
};
inline constexpr std::size_t max_parts = 8;

// ControllerState and Supervised without their arrays.
struct State {
  static constexpr Type type = Type::state;
  Part of;
  control::BoardState state = control::BoardState::fault;
  control::BoardFault fault = control::BoardFault::none;
  std::uint8_t joints = 0, channels = 0;
  control::ControllerState controller;  // without joints and readings
  control::Supervised supervised;       // without sensors
  LinkStatistics link;
};
// A State that refers to its parts, since a board's stack has no room for copies.
struct StateView {
  Part of;
  control::BoardState state;
  control::BoardFault fault;
  std::uint8_t joints, channels;
  const control::ControllerState& controller;
  const control::Supervised& supervised;
  const LinkStatistics& link;
};

// A channel of a board.
struct ChannelReading {
  signals::Reading reading;
  std::uint16_t counts = 0;  // last conversion, accepted or not
};
// Readings of all channels.
struct Readings {
  static constexpr Type type = Type::readings;
  Part of;
  std::uint8_t count = 0;
  std::array<ChannelReading, control::max_channels> channel;
};

inline constexpr std::size_t counters_in_message = 16;
// Counts of rejected readings of some channels.
struct Counters {
  static constexpr Type type = Type::counters;
  Part of;
  std::uint8_t first = 0, count = 0;
  std::array<control::SensorStatistics, counters_in_message> sensor;  // without counts
};

inline constexpr std::size_t joints_in_message = 4;
// Laws of some joints.
struct Joints {
  static constexpr Type type = Type::joints;
  Part of;
  std::uint8_t first = 0, count = 0;
  std::array<control::JointState, joints_in_message> joint;
};

// A start of the board or a change of its state.
struct Event {
  static constexpr Type type = Type::event;
  enum class What : std::uint8_t {
    started,  // after a reset
    state,    // it has entered another state
  };
  signals::Tick tick = 0;
  What what = What::started;
  control::BoardState state = control::BoardState::fault;
  control::BoardFault fault = control::BoardFault::none;  // reason for the state
};

// A driven edge of a valve.
struct ReportedEdge {
  std::uint16_t offset = 0;  // since `tick` [ticks]
  std::uint8_t valve = 0;
  bool open = false;
  std::uint16_t level = 0;
};
inline constexpr std::size_t max_edges = 32;
// Edges of a period.
struct Edges {
  static constexpr Type type = Type::edges;
  signals::Tick tick = 0;
  std::uint8_t count = 0;
  std::array<ReportedEdge, max_edges> edge;
};

// A message of the telemetry of the last 200 ms before a fault: its type and its body.
inline constexpr std::size_t max_logged = 240;
struct FaultLog {
  static constexpr Type type = Type::fault_log;
  std::uint16_t part = 0, parts = 0;
  std::uint8_t kind = 0;
  std::uint8_t count = 0;
  std::array<std::uint8_t, max_logged> data{};
};

// --- their fields -------------------------------------------------------------------------------

template <class Io, Is<Identity> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.protocol);
  choice(io, m.state, control::BoardState::dump);
  letters(io, m.firmware);
  letters(io, m.board);
  io.whole(m.configuration);
  io.whole(m.configuration_bytes);
  count(io, m.joints, 254);
  count(io, m.channels, 254);
  count(io, m.conversions, 254);
  tick(io, m.tick);
  choice(io, m.fault, control::BoardFault::requested);
  flag(io, m.active_low);
}
template <class Io, Is<Reply> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.to);
  io.whole(m.sequence);
  choice(io, m.code, last_code);
  io.whole(m.value);
  count(io, m.letters, max_text);
  first_of(m.text, m.letters, [&](auto& x) { number_as<std::uint8_t>(io, x, 1, 126); });
}
template <class Io, Is<LinkStatistics> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.line.frames);
  io.whole(m.line.length);
  io.whole(m.line.crc16);
  io.whole(m.line.crc32);
  io.whole(m.line.half);
  io.whole(m.line.skipped);
  io.whole(m.refused);
  io.whole(m.lost);
  io.whole(m.repeated);
  io.whole(m.late);
}
template <class Io, Is<Part> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.limited(m.tick, signals::Tick{0}, max_tick);
  io.limited(m.part, std::uint8_t{0}, std::uint8_t{max_parts - 1});
  io.limited(m.parts, std::uint8_t{1}, std::uint8_t{max_parts});
}
template <class Io, Is<control::Trip> M>
constexpr void fields(Io& io, M& m) noexcept {
  choice(io, m.cause, control::Trip::Cause::requested);
  tick(io, m.at);
  io.whole(m.channel.index);
  io.whole(m.counts);
  io.whole(m.before);
  io.whole(m.low);
  io.whole(m.high);
  io.whole(m.joint);
}
template <class Io, class M>
requires(Is<M, State> || Is<M, StateView>) constexpr void fields(Io& io, M& m) noexcept {
  fields(io, m.of);
  choice(io, m.state, control::BoardState::dump);
  choice(io, m.fault, control::BoardFault::requested);
  count(io, m.joints, control::max_joints);
  count(io, m.channels, control::max_channels);
  choice(io, m.controller.phase, control::Phase::off);
  io.whole(m.controller.late);
  io.whole(m.controller.invalid);
  io.whole(m.controller.missed);
  io.whole(m.controller.overruns);
  choice(io, m.controller.fault, signals::Status::fault);
  io.whole(m.controller.fault_channel.index);
  io.whole(m.supervised.rejected);
  io.whole(m.supervised.rejected_commands);
  io.whole(m.supervised.gaps);
  io.whole(m.supervised.worst_gap);
  flag(io, m.supervised.holding);
  io.whole(m.supervised.holds);
  fields(io, m.supervised.trip);
  fields(io, m.link);
}
template <class Io, Is<ChannelReading> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.reading.counts);
  choice(io, m.reading.status, signals::Status::fault);
  io.whole(m.counts);
}
template <class Io, Is<Readings> M>
constexpr void fields(Io& io, M& m) noexcept {
  fields(io, m.of);
  count(io, m.count, control::max_channels);
  first_of(m.channel, m.count, [&](auto& x) { fields(io, x); });
}
// `counts` is sent with the readings.
template <class Io, Is<control::SensorStatistics> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.rejected);
  io.whole(m.frozen);
  io.whole(m.longest);
}
template <class Io, Is<Counters> M>
constexpr void fields(Io& io, M& m) noexcept {
  fields(io, m.of);
  count(io, m.first, control::max_channels - 1);
  count(io, m.count, counters_in_message);
  first_of(m.sensor, m.count, [&](auto& x) { fields(io, x); });
}
template <class Io, Is<control::JointState> M>
constexpr void fields(Io& io, M& m) noexcept {
  tick(io, m.law_at);
  io.whole(m.stiffness);
  io.whole(m.stiffness_output);
  io.whole(m.angle_output);
  io.whole(m.velocity);
  fields(io, m.duties);
  io.whole(m.levels.flexor);
  io.whole(m.levels.extensor);
  flag(io, m.enabled);
  flag(io, m.pole_held);
  io.whole(m.pole_holds);
}
template <class Io, Is<Joints> M>
constexpr void fields(Io& io, M& m) noexcept {
  fields(io, m.of);
  joint_number(io, m.first);
  count(io, m.count, joints_in_message);
  first_of(m.joint, m.count, [&](auto& x) { fields(io, x); });
}
template <class Io, Is<Event> M>
constexpr void fields(Io& io, M& m) noexcept {
  tick(io, m.tick);
  choice(io, m.what, Event::What::state);
  choice(io, m.state, control::BoardState::dump);
  choice(io, m.fault, control::BoardFault::requested);
}
template <class Io, Is<ReportedEdge> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.offset);
  io.whole(m.valve);
  flag(io, m.open);
  io.limited(m.level, std::uint16_t{0}, signals::max_level);
}
template <class Io, Is<Edges> M>
constexpr void fields(Io& io, M& m) noexcept {
  tick(io, m.tick);
  count(io, m.count, max_edges);
  first_of(m.edge, m.count, [&](auto& x) { fields(io, x); });
}
template <class Io, Is<FaultLog> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.part);
  io.whole(m.parts);
  io.whole(m.kind);
  count(io, m.count, max_logged);
  first_of(m.data, m.count, [&](auto& x) { io.whole(x); });
}

}  // namespace sinew::link
