// control/link/test_wire.h - random messages of all types, and damaged lines: for the folder's
// tests, the guard and the fuzzer.
#pragma once

#include <bit>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "sinew/control/link/reports.h"

namespace sinew::link {

using Bytes = std::vector<std::uint8_t>;

// Calls `use` with a message of each type.
template <class Use>
void each_host_message(Use use) {
  use(Identify{}), use(ConfigureBegin{}), use(ConfigureChunk{}), use(ConfigureEnd{});
  use(ArmFirst{}), use(ArmSecond{}), use(CommandFor{}), use(SetGains{}), use(SetFeedforward{});
  use(Enable{}), use(ReadSensors{}), use(EdgesWanted{}), use(ReadFaultLog{}), use(ClearFault{});
  use(Heartbeat{}), use(ThesisWords{}), use(ShutDown{});
}
template <class Use>
void each_board_message(Use use) {
  use(Identity{}), use(Reply{}), use(State{}), use(Readings{}), use(Counters{}), use(Joints{});
  use(Event{}), use(Edges{}), use(FaultLog{});
}
template <class Use>
void each_message(Use use) {
  each_host_message(use);
  each_board_message(use);
}

// Visitor that fills a message with random valid values; floats that need not be finite have any
// bits.
class RandomFields {
 public:
  static constexpr bool reads = true;

  explicit RandomFields(std::mt19937& random, bool most = false) : random_(&random), most_(most) {}

  template <class T>
  void whole(T& x) {
    std::uint64_t bits = (std::uint64_t{(*random_)()} << 32) | (*random_)();
    x = std::bit_cast<T>(static_cast<as_bits::Of<T>>(bits));
  }
  template <class T>
  void limited(T& x, T low, T high) {
    x = most_ ? high : std::uniform_int_distribution<std::int64_t>(low, high)(*random_);
  }
  void finite(float& x) {
    do whole(x);
    while (!is_finite(x));
  }

 private:
  std::mt19937* random_;
  bool most_;  // limited numbers have the upper limit: the longest message
};

template <class M>
M any(std::mt19937& random, bool most = false) {
  M out;
  RandomFields io(random, most);
  fields(io, out);
  return out;
}

template <class M>
Bytes frame_of(const M& message, Envelope envelope = {}) {
  Bytes out(max_frame);
  out.resize(encode(message, envelope, out));
  return out;
}

// Returns a frame of any type, or of any type that a host sends.
inline Bytes any_frame(std::mt19937& random, std::uint8_t sequence, bool host_only = false) {
  std::size_t types = 0;
  each_message([&](auto) { ++types; });
  std::size_t host_types = 0;
  each_host_message([&](auto) { ++host_types; });
  const std::size_t wanted = random() % (host_only ? host_types : types);
  Bytes out;
  std::size_t at = 0;
  each_message([&](auto m) {
    if (at++ == wanted)
      out = frame_of(any<decltype(m)>(random),
                     {.board = static_cast<std::uint8_t>(random() % 4), .sequence = sequence});
  });
  return out;
}

// Returns a decoded frame as bytes, which should equal those of the stream.
inline Bytes bytes_of(const Frame& frame) {
  Bytes out(max_frame);
  out.resize(encode(frame.type, frame.envelope, frame.body, out));
  return out;
}

template <class Use>
void feed(Decoder& decoder, std::span<const std::uint8_t> bytes, Use use) {
  do {
    bytes = bytes.subspan(decoder.push(bytes));
    while (const Frame* f = decoder.next()) use(*f);
  } while (!bytes.empty());
}

// Returns all frames of a stream that ends.
inline std::vector<Bytes> frames_of(std::span<const std::uint8_t> stream) {
  std::vector<Bytes> out;
  Decoder decoder;
  const auto keep = [&](const Frame& f) { out.push_back(bytes_of(f)); };
  feed(decoder, stream, keep);
  decoder.silent();
  feed(decoder, {}, keep);
  return out;
}

// --- a line that damages data -------------------------------------------------------------------

inline void flip(std::span<std::uint8_t> bytes, std::size_t bit) {
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << bit % 8));
}

// Flips the bits of a pattern that starts at `bit`, in the order in which a line sends them.
inline void burst(std::span<std::uint8_t> bytes, std::size_t bit, std::uint32_t pattern) {
  for (std::size_t i = bit; pattern != 0; ++i, pattern >>= 1)
    if (pattern & 1u) flip(bytes, i);
}

}  // namespace sinew::link
