// Tests frames in a stream: all good frames are found between other bytes; a damaged one is not.
#include "sinew/control/link/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sinew/control/link/test_wire.h"
#include "sinew/signals/crc.h"

namespace sinew::link::frame_test {
namespace {

void append(Bytes& to, const Bytes& more) { to.insert(to.end(), more.begin(), more.end()); }

Bytes noise(std::mt19937& random, std::size_t most) {
  Bytes out(random() % (most + 1));
  for (std::uint8_t& b : out) {
    // Bytes with which a frame begins are frequent, so that many positions look like a frame.
    const std::uint8_t likely[] = {sync_first, sync_second, 6, 40, 255};
    b = random() % 2 ? likely[random() % 5] : static_cast<std::uint8_t>(random());
  }
  return out;
}

TEST(Frame, HasTheFormOfTheLaboratory) {
  const Bytes frame = frame_of(Identify{}, {.board = 3, .sequence = 7});
  ASSERT_EQ(frame.size(), min_frame);
  EXPECT_EQ(Bytes(frame.begin(), frame.begin() + 7),
            (Bytes{0xaa, 0x55, 1, 7, 6, protocol_version, 3}));
  const std::span<const std::uint8_t> all(frame);
  EXPECT_EQ(signals::crc16(all.subspan(2, 9)), frame[11] | frame[12] << 8);
  EXPECT_EQ(signals::crc32(all.subspan(2, 5)),
            frame[7] | frame[8] << 8 | frame[9] << 16 | std::uint32_t{frame[10]} << 24);
}

TEST(Frame, ABodyThatIsTooLongIsNotSent) {
  Bytes out(max_frame + 10);
  EXPECT_EQ(encode(1, {}, Bytes(max_body), out), max_frame);
  EXPECT_EQ(encode(1, {}, Bytes(max_body + 1), out), 0u);
  EXPECT_EQ(encode(1, {}, Bytes(10), std::span(out).first(22)), 0u);
  EXPECT_EQ(encode(1, {}, Bytes(10), std::span(out).first(23)), 23u);
}

TEST(Decoder, FindsAllFramesHoweverTheStreamIsCut) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    Bytes stream;
    std::vector<Bytes> sent;
    for (int k = 0; k < 8; ++k) {
      sent.push_back(any_frame(random, static_cast<std::uint8_t>(k)));
      append(stream, sent.back());
      append(stream, noise(random, random() % 3 ? 0 : 400));
    }
    Decoder decoder;
    std::vector<Bytes> found;
    const auto keep = [&](const Frame& f) { found.push_back(bytes_of(f)); };
    std::span<const std::uint8_t> left(stream);
    while (!left.empty()) {
      const std::size_t n = std::min<std::size_t>(left.size(), 1 + random() % 700);
      feed(decoder, left.first(n), keep);
      left = left.subspan(n);
    }
    decoder.silent();
    feed(decoder, {}, keep);
    EXPECT_EQ(found, sent);
    std::size_t bytes = decoder.line().skipped;
    for (const Bytes& b : found) bytes += b.size();
    EXPECT_EQ(bytes, stream.size()) << "each byte is of a frame, or was skipped";
  }
}

// A damaged length extends over the following frames.
TEST(Decoder, AGoodFrameBehindASpoiledOneIsNotSwallowed) {
  std::mt19937 random(2);
  for (int length = 0; length < 256; ++length) {
    const Bytes good = any_frame(random, 9), last = any_frame(random, 10);
    Bytes stream = frame_of(any<CommandFor>(random));
    if (stream[4] == length) continue;
    stream[4] = static_cast<std::uint8_t>(length);
    append(stream, good);
    append(stream, last);
    EXPECT_EQ(frames_of(stream), (std::vector<Bytes>{good, last})) << length;
  }
}

TEST(Decoder, HalfAFrameBeforeASilenceIsNone) {
  std::mt19937 random(3);
  const Bytes cut = frame_of(any<CommandFor>(random)), good = any_frame(random, 1);
  for (std::size_t n = 1; n < cut.size(); ++n) {
    Decoder decoder;
    std::vector<Bytes> found;
    const auto keep = [&](const Frame& f) { found.push_back(bytes_of(f)); };
    feed(decoder, std::span(cut).first(n), keep);
    decoder.silent();
    feed(decoder, std::span(cut).subspan(n), keep);  // the rest comes too late
    EXPECT_TRUE(found.empty()) << n;
    EXPECT_GE(decoder.line().half, 1u);
    feed(decoder, good, keep);
    decoder.silent();
    feed(decoder, {}, keep);
    EXPECT_EQ(found, std::vector<Bytes>{good}) << n;
  }
}

// The body is full of a frame's first bytes; still only one frame is found.
TEST(Decoder, SyncBytesWithinAFrameDoNotMatter) {
  Bytes out(max_frame), body(max_body);
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = i % 2 ? sync_second : sync_first;
  out.resize(encode(0x70, {}, body, out));
  EXPECT_EQ(frames_of(out), std::vector<Bytes>{out});
}

TEST(Decoder, OtherVersionsAreHandedOutAndNotObeyed) {
  for (int version = 0; version < 256; ++version) {
    Bytes frame = frame_of(ShutDown{});
    frame[5] = static_cast<std::uint8_t>(version);
    const std::span<std::uint8_t> all(frame);
    Writer(all.subspan(7)).whole(signals::crc32(all.subspan(2, 5)));
    Writer(all.subspan(11)).whole(signals::crc16(all.subspan(2, 9)));
    Decoder decoder;
    decoder.push(frame);
    const Frame* found = decoder.next();
    ASSERT_NE(found, nullptr);
    ShutDown message;
    EXPECT_EQ(decode(*found, message), version == protocol_version ? Code::done : Code::version);
  }
}

// --- damaged frames are never accepted ----------------------------------------------------------

// The bytes before and after stay unchanged, so that a longer length includes some of them.
struct Among {
  Among() {
    std::mt19937 random(4);
    behind = frame_of(any<Joints>(random, true));
    append(behind, frame_of(any<Joints>(random, true)));
  }
  Bytes behind;
};

// Returns whether only the frame after the damaged one is found.
bool spoiled_is_lost(const Bytes& spoiled, const Bytes& behind) {
  Decoder decoder;
  std::size_t found = 0;
  bool as_sent = true;
  const auto look = [&](const Frame& f) {
    const std::size_t size = min_frame + f.body.size();
    as_sent = as_sent && (found + 1) * size <= behind.size() &&
              bytes_of(f) == Bytes(behind.begin() + static_cast<long>(found * size),
                                   behind.begin() + static_cast<long>((found + 1) * size));
    ++found;
  };
  feed(decoder, spoiled, look);
  feed(decoder, behind, look);
  decoder.silent();
  feed(decoder, {}, look);
  return as_sent && found == 2;
}

// Without following frames: faster, for many cases.
bool nothing_passes(Decoder& decoder, std::span<const std::uint8_t> spoiled) {
  std::size_t found = 0;
  decoder.push(spoiled);
  decoder.silent();
  while (decoder.next()) ++found;
  return found == 0;
}

TEST(Spoiled, ThreeFlippedBitsOfTheShortestFramesNeverPass) {
  Decoder decoder;
  std::size_t tried = 0;
  each_message([&](auto m) {
    Bytes frame = frame_of(m);
    const std::size_t bits = 8 * frame.size();
    if (frame.size() > 22) return;
    for (std::size_t a = 0; a < bits; ++a) {
      flip(frame, a);
      for (std::size_t b = a; b < bits; ++b) {  // b = a: one bit
        if (b > a) flip(frame, b);
        for (std::size_t c = b; c < bits; ++c) {  // c = b: two bits
          if (c > b) flip(frame, c);
          if (!nothing_passes(decoder, frame))
            ADD_FAILURE() << int{frame[2]} << ": " << a << ' ' << b << ' ' << c;
          if (c > b) flip(frame, c);
          ++tried;
        }
        if (b > a) flip(frame, b);
      }
      flip(frame, a);
    }
  });
  EXPECT_GT(tried, 3'000'000u);
}

TEST(Spoiled, OneAndTwoFlippedBitsBeforeOtherFramesNeverPass) {
  const Among among;
  Bytes frame = frame_of(Enable{.joints = 7, .enabled = true});
  const std::size_t bits = 8 * frame.size();
  for (std::size_t a = 0; a < bits; ++a)
    for (std::size_t b = a; b < bits; ++b) {
      Bytes spoiled = frame;
      flip(spoiled, a);
      if (b > a) flip(spoiled, b);
      ASSERT_TRUE(spoiled_is_lost(spoiled, among.behind)) << a << ' ' << b;
    }
}

// Every burst of up to 16 bits, at every position of a frame. The effect of a burst after the
// length on the sums does not depend on the rest of the frame; the guard tests bursts over sync and
// length for all types.
TEST(Spoiled, BurstsOfSixteenBitsNeverPass) {
  Decoder decoder;
  Bytes frame = frame_of(ShutDown{});
  const std::size_t bits = 8 * frame.size();
  for (std::size_t at = 0; at < bits; ++at)
    for (std::uint32_t pattern = 1; pattern < 0x10000; pattern += 2) {
      if (at + static_cast<unsigned>(std::bit_width(pattern)) > bits) break;
      burst(frame, at, pattern);
      if (!nothing_passes(decoder, frame)) ADD_FAILURE() << at << ' ' << pattern;
      burst(frame, at, pattern);
    }
}

// The same for samples of all types, short and long.
TEST(Spoiled, SamplesOfEveryTypeNeverPass) {
  std::mt19937 random(6);
  const Among among;
  for (int i = 0; i < 400; ++i)
    each_message([&](auto m) {
      Bytes frame = frame_of(any<decltype(m)>(random, i % 8 == 0));
      const std::size_t bits = 8 * frame.size();
      if (i % 2) {
        std::set<std::size_t> places;
        while (places.size() < 3) places.insert(random() % bits);
        for (const std::size_t p : places) flip(frame, p);
      } else {
        burst(frame, random() % (bits - 15), (random() & 0xffffu) | 1u);
      }
      ASSERT_TRUE(spoiled_is_lost(frame, among.behind)) << int{frame[2]};
    });
}

}  // namespace
}  // namespace sinew::link::frame_test
