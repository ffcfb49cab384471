#include "sinew/control/link/frame.h"

#include "sinew/control/link/bytes.h"
#include "sinew/signals/crc.h"

namespace sinew::link {
namespace {

template <class T>
T number_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  T out = 0;
  Reader(bytes.subspan(at, sizeof(T))).whole(out);
  return out;
}

}  // namespace

std::size_t encode(std::uint8_t type, Envelope envelope, std::span<const std::uint8_t> body,
                   std::span<std::uint8_t> out) noexcept {
  if (body.size() > max_body || out.size() < min_frame + body.size()) return 0;
  Writer to(out);
  for (const std::uint8_t byte :
       {sync_first, sync_second, type, envelope.sequence,
        static_cast<std::uint8_t>(min_payload + body.size()), protocol_version, envelope.board})
    to.whole(byte);
  for (const std::uint8_t byte : body) to.whole(byte);
  to.whole(signals::crc32(out.subspan(2, to.size() - 2)));
  to.whole(signals::crc16(out.subspan(2, to.size() - 2)));
  return to.size();
}

std::size_t Decoder::push(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() > buffer_.size() - end_) {  // moves the rest to the start of the buffer
    for (std::size_t i = begin_; i < end_; ++i) buffer_[i - begin_] = buffer_[i];
    silence_ = silence_ > begin_ ? silence_ - begin_ : 0;
    end_ -= begin_;
    begin_ = 0;
  }
  const std::size_t room = buffer_.size() - end_;
  const std::size_t taken = bytes.size() < room ? bytes.size() : room;
  for (std::size_t i = 0; i < taken; ++i) buffer_[end_ + i] = bytes[i];
  end_ += taken;
  return taken;
}

const Frame* Decoder::next() noexcept {
  while (begin_ < end_) switch (search()) {
      case FrameSearch::wait:
        return nullptr;
      case FrameSearch::skip:
        ++begin_;
        ++line_.skipped;
        break;
      case FrameSearch::frame:
        ++line_.frames;
        begin_ += header_size + buffer_[begin_ + 4] + crc16_size;
        return &frame_;
    }
  return nullptr;
}

// Checks the position at which the next frame may begin.
Decoder::FrameSearch Decoder::search() noexcept {
  const std::uint8_t* at = buffer_.data() + begin_;
  if (at[0] != sync_first) return FrameSearch::skip;
  if (const FrameSearch l = reach(2); l != FrameSearch::frame)
    return l == FrameSearch::skip ? failed(line_.half) : l;
  if (at[1] != sync_second) return FrameSearch::skip;
  if (const FrameSearch l = reach(header_size); l != FrameSearch::frame)
    return l == FrameSearch::skip ? failed(line_.half) : l;
  if (at[4] < min_payload) return failed(line_.length);
  const std::size_t size = header_size + at[4] + crc16_size;
  if (const FrameSearch l = reach(size); l != FrameSearch::frame)
    return l == FrameSearch::skip ? failed(line_.half) : l;
  return check({at, size});
}

// Checks whether that many bytes are present without a silence between them.
Decoder::FrameSearch Decoder::reach(std::size_t bytes) const noexcept {
  if (begin_ < silence_ && begin_ + bytes > silence_) return FrameSearch::skip;
  return end_ - begin_ < bytes ? FrameSearch::wait : FrameSearch::frame;
}

Decoder::FrameSearch Decoder::check(std::span<const std::uint8_t> frame) noexcept {
  const std::size_t body_end = frame.size() - crc32_size - crc16_size;
  if (signals::crc16(frame.subspan(2, frame.size() - 4)) !=
      number_at<std::uint16_t>(frame, frame.size() - crc16_size))
    return failed(line_.crc16);
  if (signals::crc32(frame.subspan(2, body_end - 2)) != number_at<std::uint32_t>(frame, body_end))
    return failed(line_.crc32);
  constexpr std::size_t body_at = header_size + before_body;
  frame_ = {.type = frame[2],
            .version = frame[5],
            .envelope = {.board = frame[6], .sequence = frame[3]},
            .body = frame.subspan(body_at, body_end - body_at)};
  return FrameSearch::frame;
}

Decoder::FrameSearch Decoder::failed(std::uint32_t& reason) noexcept {
  ++reason;
  return FrameSearch::skip;
}

}  // namespace sinew::link
