// control/link/frame.h - frames on the wire between a host and a controller board
// (docs/reference/wire.md).
//
//   AA 55  type  sequence  length  payload ...  CRC-16
//
// like the frames of a laboratory for braided actuators (Portland State's AARL-Embedded-Comms): the
// CRC-16 is over type to payload, little-endian. The payload here is
//
//   version  board  body ...  CRC-32          CRC-32 over type to body
//
// so that two different checks cover each byte after the AA 55, including the length: the CRC-16
// alone accepts one wrong frame of 65,536.
//
// Embedded core: no heap, no exceptions, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::link {

inline constexpr std::uint8_t protocol_version = 2;

inline constexpr std::uint8_t sync_first = 0xaa, sync_second = 0x55;
inline constexpr std::size_t header_size = 5, before_body = 2, crc32_size = 4, crc16_size = 2;
inline constexpr std::size_t min_payload = before_body + crc32_size;
inline constexpr std::size_t max_payload = 255;
inline constexpr std::size_t max_body = max_payload - min_payload;
inline constexpr std::size_t min_frame = header_size + min_payload + crc16_size;
inline constexpr std::size_t max_frame = header_size + max_payload + crc16_size;

// Address of every board on the line; accepted for identify and shut_down only.
inline constexpr std::uint8_t every_board = 255;

// Address and number of a frame.
struct Envelope {
  std::uint8_t board = 1;
  std::uint8_t sequence = 0;  // incremented for each frame, 0 after 255

  friend constexpr bool operator==(const Envelope&, const Envelope&) = default;
};

struct Frame {
  std::uint8_t type = 0;
  std::uint8_t version = protocol_version;
  Envelope envelope;
  std::span<const std::uint8_t> body;  // refers to the decoder's buffer, until more is pushed
};

// Returns the frame's size in `out`; 0 if the body is longer than max_body, or `out` too short.
std::size_t encode(std::uint8_t type, Envelope envelope, std::span<const std::uint8_t> body,
                   std::span<std::uint8_t> out) noexcept;

// Counts of received frames and discarded bytes. A position at which a frame could begin but none
// does is counted by the reason, then one byte is skipped.
struct LineCount {
  std::uint32_t frames = 0;  // returned frames
  std::uint32_t length = 0;  // too short for a payload
  std::uint32_t crc16 = 0;
  std::uint32_t crc32 = 0;    // with correct CRC-16
  std::uint32_t half = 0;     // silence on the line before the end
  std::uint32_t skipped = 0;  // number of bytes outside frames

  friend constexpr bool operator==(const LineCount&, const LineCount&) = default;
};

// Decoder finds frames in a stream of bytes that arrives in arbitrary pieces. A good frame is found
// even after, or within the length of, a bad one: after a failure only one byte is skipped.
//
//   decoder.push(bytes);
//   while (const Frame* f = decoder.next()) ...
class Decoder {
 public:
  // Returns the number of bytes taken: all, up to max_frame, if next() has returned nullptr before.
  std::size_t push(std::span<const std::uint8_t> bytes) noexcept;

  // Returns the next frame, or nullptr if bytes are missing. Frames of another version are returned
  // too: their receiver replies that it does not support them.
  const Frame* next() noexcept;

  // Notes that the line was silent for longer than allowed within a frame: an incomplete frame is
  // discarded.
  void silent() noexcept { silence_ = end_; }

  // Returns the counts so far.
  const LineCount& line() const noexcept { return line_; }

 private:
  enum class FrameSearch : std::uint8_t { wait, skip, frame };

  FrameSearch search() noexcept;
  FrameSearch reach(std::size_t bytes) const noexcept;
  FrameSearch check(std::span<const std::uint8_t> frame) noexcept;
  FrameSearch failed(std::uint32_t& reason) noexcept;

  std::array<std::uint8_t, 2 * max_frame> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // unprocessed bytes
  std::size_t silence_ = 0;          // no frame extends over this position
  Frame frame_;
  LineCount line_;
};

}  // namespace sinew::link
