// For any bytes on the wire: the frames that are decoded are contained in them, all of them and in
// order, however the stream is cut; a message that is decoded has the values of its bytes.
#include <algorithm>
#include <vector>

#include "sinew/control/link/telemetry.h"
#include "sinew/control/link/test_wire.h"
#include "sinew/control/link/thesis_bytes.h"
#include "sinew/signals/crc.h"
#include "tests/fuzz/law.h"

namespace sinew::fuzz {
namespace {

using link::Bytes;

// Content of a frame: type, sequence, version, board, body.
Bytes said_by(const link::Frame& f) {
  Bytes out{f.type, f.envelope.sequence, f.version, f.envelope.board};
  out.insert(out.end(), f.body.begin(), f.body.end());
  return out;
}

// The frame that begins here, empty if none does: without a decoder, by its definition.
std::span<const std::uint8_t> frame_at(std::span<const std::uint8_t> stream) {
  if (stream.size() < link::min_frame || stream[0] != 0xaa || stream[1] != 0x55) return {};
  const std::size_t size = link::header_size + stream[4] + link::crc16_size;
  if (size < link::min_frame || size > stream.size()) return {};
  const std::uint8_t* end = stream.data() + size;
  const bool good =
      signals::crc16(stream.subspan(2, size - 4)) == (end[-2] | end[-1] << 8) &&
      signals::crc32(stream.subspan(2, size - 8)) ==
          (end[-6] | end[-5] << 8 | end[-4] << 16 | static_cast<std::uint32_t>(end[-3]) << 24);
  return good ? stream.first(size) : std::span<const std::uint8_t>{};
}

std::vector<Bytes> frames_by_definition(std::span<const std::uint8_t> stream) {
  std::vector<Bytes> out;
  while (!stream.empty()) {
    const auto frame = frame_at(stream);
    if (!frame.empty()) {
      const auto said = frame.subspan(2, frame.size() - 8);
      out.push_back({said[0], said[1]});  // the length is behind them
      out.back().insert(out.back().end(), said.begin() + 3, said.end());
    }
    stream = stream.subspan(std::max<std::size_t>(frame.size(), 1));
  }
  return out;
}

void law_of_message(const link::Frame& f) {
  link::each_message([&](auto m) {
    if (link::decode(f, m) != link::Code::done) return;
    const link::Body again = link::body_of(m);
    law(again.ok && std::ranges::equal(again.span(), f.body), "a message is what its bytes say");
  });
}

// All frames that a decoder returns for a stream that arrives in pieces.
std::vector<Bytes> frames_in_pieces(std::span<const std::uint8_t> stream, std::size_t piece) {
  std::vector<Bytes> out;
  link::Decoder decoder;
  std::size_t bytes = 0;
  const auto keep = [&](const link::Frame& f) {
    bytes += link::min_frame + f.body.size();
    law_of_message(f);
    out.push_back(said_by(f));
  };
  for (std::size_t at = 0; at < stream.size(); at += piece)
    link::feed(decoder, stream.subspan(at, std::min(piece, stream.size() - at)), keep);
  decoder.silent();
  link::feed(decoder, {}, keep);
  law(bytes + decoder.line().skipped == stream.size(), "each byte is of a frame or was skipped");
  return out;
}

// Bytes that were not checked by a decoder, read as the body of each message.
void law_of_bodies(std::span<const std::uint8_t> body) {
  link::each_message([&](auto m) {
    if (link::read(body, m) != link::Code::done) return;
    const link::Body again = link::body_of(m);
    law(again.ok && std::ranges::equal(again.span(), body), "a body is read to the byte");
  });
}

// Two bytes 255 shut down, unless a frame is not over.
void law_of_words(std::span<const std::uint8_t> stream) {
  link::ThesisByteReader reader({.joint = {2, 0, 1}, .found = true});
  using What = link::ThesisByteResult::What;
  What last = What::nothing;
  for (const std::uint8_t byte : stream) last = reader.take(byte).what;
  if (last == What::frame) return;
  const bool first = reader.take(255).what == What::shut_down;
  law(first || reader.take(255).what == What::shut_down, "two bytes 255 shut down");
}

}  // namespace

void wire(std::string_view input) {
  const std::span<const std::uint8_t> stream(reinterpret_cast<const std::uint8_t*>(input.data()),
                                             input.size());
  const std::vector<Bytes> frames = frames_by_definition(stream);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{1000}})
    law(frames_in_pieces(stream, piece) == frames, "all frames of the stream are found");
  law_of_bodies(stream.first(std::min(stream.size(), link::max_body)));
  law_of_words(stream);
}

}  // namespace sinew::fuzz
