// control/link/frame.h - frames on the wire between a host and a controller board
// (docs/reference/wire.md).
//
//   AA 55  type  sequence  length  payload ...  CRC-16
//
// as a laboratory of braided actuators frames its own (Portland State's AARL-Embedded-Comms): the
// CRC-16 is over type to payload, little-endian. A payload of ours is
//
//   version  board  body ...  CRC-32          CRC-32 over type to body
//
// so that two checks of different kind cover each byte behind the AA 55, the length among them: by
// itself the CRC-16 lets one wrong frame of 65,536 pass.
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

// A frame to every board on the line; only identify and shut_down are taken so.
inline constexpr std::uint8_t every_board = 255;

// From whom or to whom, and which one it is.
struct Envelope {
  std::uint8_t board = 1;
  std::uint8_t sequence = 0;  // one more for each frame that is sent, 0 after 255

  friend constexpr bool operator==(const Envelope&, const Envelope&) = default;
};

struct Frame {
  std::uint8_t type = 0;
  std::uint8_t version = protocol_version;
  Envelope envelope;
  std::span<const std::uint8_t> body;  // points into the decoder, until more is pushed
};

// Its size in `out`; 0 where the body is longer than max_body, or `out` too short.
std::size_t encode(std::uint8_t type, Envelope envelope, std::span<const std::uint8_t> body,
                   std::span<std::uint8_t> out) noexcept;

// What came in, and what was thrown away. A place where a frame might have begun and did not is
// counted by its reason, then passed over by one byte.
struct LineCount {
  std::uint32_t frames = 0;  // handed out
  std::uint32_t length = 0;  // too short for a payload of ours
  std::uint32_t crc16 = 0;
  std::uint32_t crc32 = 0;    // with the right CRC-16
  std::uint32_t half = 0;     // the line was silent before it ended
  std::uint32_t skipped = 0;  // bytes that are of no frame

  friend constexpr bool operator==(const LineCount&, const LineCount&) = default;
};

// Decoder finds the frames in a stream of bytes, however it is cut in pieces. A good frame is found
// also behind, or within the length of, one that failed: every byte but the first of what failed is
// looked at again.
//
//   decoder.push(bytes);
//   while (const Frame* f = decoder.next()) ...
class Decoder {
 public:
  // How many it took: all, up to max_frame, if next() has said nullptr before.
  std::size_t push(std::span<const std::uint8_t> bytes) noexcept;

  // The next frame, nullptr where bytes are missing. Frames of another version are handed out as
  // well: their reader answers that it does not know them.
  const Frame* next() noexcept;

  // The line was silent for longer than it may within a frame: what is incomplete was none.
  void silent() noexcept { silence_ = end_; }

  // Returns what the line has done to the frames so far.
  const LineCount& line() const noexcept { return line_; }

 private:
  enum class Look : std::uint8_t { wait, skip, frame };

  Look look() noexcept;
  Look reach(std::size_t bytes) const noexcept;
  Look judge(std::span<const std::uint8_t> frame) noexcept;
  Look failed(std::uint32_t& reason) noexcept;

  std::array<std::uint8_t, 2 * max_frame> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // what is not worked off yet
  std::size_t silence_ = 0;          // no frame reaches over this place
  Frame frame_;
  LineCount line_;
};

}  // namespace sinew::link
