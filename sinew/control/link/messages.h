// control/link/messages.h - messages of a host to a board (docs/reference/wire.md has the bytes).
//
// A message is a struct; its fields() lists what is sent, in order. encode() and decode() use that
// list, so that both ends agree. Invalid values, such as a flag of 2, a joint 9, or a gain that is
// NaN, are neither sent nor accepted.
//
//   host                                board
//   identify                            identity
//   configure_begin, _chunk..., _end    reply to each; refused as a whole
//   arm_first                           reply with a number that the board chooses
//   arm_second with that number         reply: armed
//   command, every period               telemetry, every period
//   shut_down                           reply, after it has been done
//
// Angles are in counts, stiffness in lbf in/rad, duties in percent, times in ticks of 100 us, as in
// the whole low level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sinew/control/joint/command.h"
#include "sinew/control/link/bytes.h"
#include "sinew/control/link/frame.h"
#include "sinew/signals/tick.h"
#include "sinew/signals/timing.h"

namespace sinew::link {

// Number of each message on the wire.
enum class Type : std::uint8_t {
  identify = 0x01,
  configure_begin,
  configure_chunk,
  configure_end,
  arm_first,
  arm_second,
  command,
  set_gains,
  set_feedforward,
  enable,
  read_sensors,
  edges_wanted,
  read_fault_log,
  clear_fault,
  heartbeat,
  thesis_words,
  shut_down,

  // sent by a board
  identity = 0x81,
  answer,
  state,
  readings,
  counters,
  joints,
  event,
  edges,
  fault_log,
};

// Result of a message, in a board's reply.
enum class Code : std::uint8_t {
  done,
  version,        // a frame of another protocol version
  type,           // unknown to a board
  length,         // wrong length for this type
  value,          // invalid number
  state,          // not permitted now: joints run, or none is configured
  sequence,       // frame was received before
  past,           // a command whose periods are over
  future,         // a command too far ahead
  period,         // a command that does not begin at a period's start
  order,          // configure: begin is missing or repeated
  gap,            // configure: a chunk does not follow the last one
  size,           // configure: wrong number of bytes
  checksum,       // configure: wrong CRC
  layout,         // configure: another layout, or an invalid number
  configuration,  // configure: the parts contradict each other; the reply's text has the reason
  nonce,          // arm: not the board's number, or another configuration
};
inline constexpr Code last_code = Code::nonce;

// Ticks on the wire are between -1, never, and 3,600 years.
inline constexpr signals::Tick max_tick = signals::Tick{1} << 60;

// --- a host's messages --------------------------------------------------------------------------

// Requests the board's identity.
struct Identify {
  static constexpr Type type = Type::identify;
};
// Announces a configuration, which is followed by chunks and an end.
struct ConfigureBegin {
  static constexpr Type type = Type::configure_begin;
  std::uint16_t bytes = 0;  // size of the configuration
  std::uint32_t crc = 0;    // crc32 of these bytes
};
inline constexpr std::size_t max_chunk = 200;
// Carries a part of a configuration.
struct ConfigureChunk {
  static constexpr Type type = Type::configure_chunk;
  std::uint16_t offset = 0;
  std::uint8_t count = 0;  // 1 .. max_chunk
  std::array<std::uint8_t, max_chunk> data{};
};
// Ends a configuration, which the board then accepts or refuses.
struct ConfigureEnd {
  static constexpr Type type = Type::configure_end;
  std::uint32_t crc = 0;  // equal to that in ConfigureBegin
};

// Arming takes two different frames, the second of which repeats a number from the board's reply to
// the first. No air is let in before.
struct ArmFirst {
  static constexpr Type type = Type::arm_first;
  std::uint32_t configuration = 0;  // crc32 of the configuration that the host has sent
};
struct ArmSecond {
  static constexpr Type type = Type::arm_second;
  std::uint32_t nonce = 0;  // number in the reply to the first frame
  std::uint32_t configuration = 0;
};

// Sets the command from a period on. Joints that are not included keep their last command.
struct CommandFor {
  static constexpr Type type = Type::command;
  signals::Tick from = 0;    // first tick of a period
  std::uint8_t periods = 1;  // number of valid periods, 1 .. 100; then the host is lost
  bool ends = false;         // ends the run: the joints are vented as at a plan's end
  std::uint8_t joints = 0;   // number of joints that follow, the board's first ones
  std::array<control::JointCommand, control::max_joints> joint;
};

// These change the current command between a host's commands.
struct SetGains {
  static constexpr Type type = Type::set_gains;
  std::uint8_t joint = 0;
  control::Gains gains;
};
struct SetFeedforward {
  static constexpr Type type = Type::set_feedforward;
  std::uint8_t joint = 0;
  control::Duties duties;
};
struct Enable {
  static constexpr Type type = Type::enable;
  std::uint8_t joints = 0;  // a bit for each joint
  bool enabled = false;
};

// Requests all readings.
struct ReadSensors {  // replied to by readings
  static constexpr Type type = Type::read_sensors;
};
// Requests that edges are reported, or not.
struct EdgesWanted {
  static constexpr Type type = Type::edges_wanted;
  bool wanted = false;
};
// Requests the telemetry before a fault.
struct ReadFaultLog {  // replied to by fault_log, from that part on
  static constexpr Type type = Type::read_fault_log;
  std::uint16_t from = 0;
};
// Clears a fault whose cause has been found.
struct ClearFault {
  static constexpr Type type = Type::clear_fault;
};
// Keeps the board armed while no command is sent.
struct Heartbeat {
  static constexpr Type type = Type::heartbeat;
};
// Switches the byte protocol of the thesis's computers on or off.
struct ThesisWords {  // thesis_bytes.h
  static constexpr Type type = Type::thesis_words;
  bool on = false;
};
// Vents and ends the run, at once and in every state.
struct ShutDown {  // at once, in every state
  static constexpr Type type = Type::shut_down;
};

// --- their fields -------------------------------------------------------------------------------

// Converts a tick of a run.
template <class Io, class M>
constexpr void tick(Io& io, M& t) noexcept {
  io.limited(t, signals::Tick{-1}, max_tick);
}

template <class Io, Is<control::Duties> M>
constexpr void fields(Io& io, M& d) noexcept {
  number_as<std::uint8_t>(io, d.flexor_inlet, 0, signals::max_duty);
  number_as<std::uint8_t>(io, d.flexor_exhaust, 0, signals::max_duty);
  number_as<std::uint8_t>(io, d.extensor_inlet, 0, signals::max_duty);
  number_as<std::uint8_t>(io, d.extensor_exhaust, 0, signals::max_duty);
}
template <class Io, Is<control::Opening> M>
constexpr void fields(Io& io, M& o) noexcept {
  io.whole(o.from);
  io.whole(o.until);
}
template <class Io, Is<control::Gains> M>
constexpr void fields(Io& io, M& g) noexcept {
  io.finite(g.angle);
  io.finite(g.stiffness);
  io.finite(g.velocity);
}
// A joint is driven by its law, by duties or, if it is timed, by openings. Openings use the
// bytes of the angle (inlet) and of the duties (exhaust).
template <class Io, Is<control::JointCommand> M>
constexpr void fields(Io& io, M& c) noexcept {
  std::int32_t angle = c.angle;
  if constexpr (!Io::reads)
    if (c.timed) angle = c.openings.inlet.until << 16 | c.openings.inlet.from;
  io.whole(angle);
  io.finite(c.stiffness);
  fields(io, c.gains);
  flag(io, c.enabled);
  auto by = static_cast<std::uint8_t>(c.timed ? 2 : c.open_loop ? 1 : 0);
  io.limited(by, std::uint8_t{0}, std::uint8_t{2});
  if constexpr (Io::reads) {
    c.timed = by == 2;
    c.open_loop = by == 1;
    const auto both = static_cast<std::uint32_t>(angle);
    if (c.timed)
      c.openings = {{static_cast<std::uint16_t>(both), static_cast<std::uint16_t>(both >> 16)}, {}};
    else
      c.angle = angle;
  }
  c.timed ? fields(io, c.openings.exhaust) : fields(io, c.duties);
}

template <class Io, class M>
requires(Is<M, Identify> || Is<M, ReadSensors> || Is<M, ClearFault> || Is<M, Heartbeat> ||
         Is<M, ShutDown>) constexpr void fields(Io&, M&) noexcept {}

template <class Io, Is<ConfigureBegin> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.bytes);
  io.whole(m.crc);
}
template <class Io, Is<ConfigureChunk> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.offset);
  io.limited(m.count, std::uint8_t{1}, std::uint8_t{max_chunk});
  first_of(m.data, m.count, [&](auto& x) { io.whole(x); });
}
template <class Io, Is<ConfigureEnd> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.crc);
}
template <class Io, Is<ArmFirst> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.configuration);
}
template <class Io, Is<ArmSecond> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.nonce);
  io.whole(m.configuration);
}
template <class Io, Is<CommandFor> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.limited(m.from, signals::Tick{0}, max_tick);
  io.limited(m.periods, std::uint8_t{1}, std::uint8_t{100});
  flag(io, m.ends);
  count(io, m.joints, control::max_joints);
  first_of(m.joint, m.joints, [&](auto& x) { fields(io, x); });
}
// Converts the number of a joint.
template <class Io, class M>
constexpr void joint_number(Io& io, M& joint) noexcept {
  count(io, joint, control::max_joints - 1);
}
template <class Io, Is<SetGains> M>
constexpr void fields(Io& io, M& m) noexcept {
  joint_number(io, m.joint);
  fields(io, m.gains);
}
template <class Io, Is<SetFeedforward> M>
constexpr void fields(Io& io, M& m) noexcept {
  joint_number(io, m.joint);
  fields(io, m.duties);
}
template <class Io, Is<Enable> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.joints);
  flag(io, m.enabled);
}
template <class Io, Is<EdgesWanted> M>
constexpr void fields(Io& io, M& m) noexcept {
  flag(io, m.wanted);
}
template <class Io, Is<ReadFaultLog> M>
constexpr void fields(Io& io, M& m) noexcept {
  io.whole(m.from);
}
template <class Io, Is<ThesisWords> M>
constexpr void fields(Io& io, M& m) noexcept {
  flag(io, m.on);
}

// --- messages in frames -------------------------------------------------------------------------

// Body of a message; empty if the message has an invalid value.
struct Body {
  std::array<std::uint8_t, max_body> bytes{};
  std::size_t size = 0;
  bool ok = false;

  // Returns the bytes in use.
  std::span<const std::uint8_t> span() const noexcept { return {bytes.data(), size}; }
};

// Returns a message as bytes; `ok` is false if one of its values is invalid.
template <class M>
Body body_of(const M& message) noexcept {
  Body out;
  Writer to(out.bytes);
  fields(to, message);
  out.ok = to.ok();
  out.size = out.ok ? to.size() : 0;
  return out;
}

// Returns the frame's size in `out`; 0 if the message has an invalid value or does not fit.
template <class M>
std::size_t encode(const M& message, Envelope envelope, std::span<std::uint8_t> out) noexcept {
  const Body body = body_of(message);
  return body.ok ? encode(static_cast<std::uint8_t>(M::type), envelope, body.span(), out) : 0;
}

// Reads the fields of a body, which must have no further bytes. Returns done, or the reason for a
// refusal; then `out` is incomplete.
template <class M>
Code read(std::span<const std::uint8_t> body, M& out) noexcept {
  Reader from(body);
  fields(from, out);
  if (from.too_short()) return Code::length;
  if (!from.ok()) return Code::value;
  return from.left() == 0 ? Code::done : Code::length;
}

// Reads the message of a frame. Returns done, or the reason for a refusal.
template <class M>
Code decode(const Frame& frame, M& out) noexcept {
  if (frame.version != protocol_version) return Code::version;
  if (frame.type != static_cast<std::uint8_t>(M::type)) return Code::type;
  return read(frame.body, out);
}

}  // namespace sinew::link
