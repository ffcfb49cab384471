// Tests that a received message equals the sent one, bit for bit; invalid values are neither sent
// nor accepted.
#include "sinew/control/link/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "sinew/control/link/test_wire.h"

namespace sinew::link::messages_test {
namespace {

template <class M>
Code decoded(const Bytes& frame, M& out) {
  Decoder decoder;
  decoder.push(frame);
  const Frame* f = decoder.next();
  return f ? decode(*f, out) : Code::checksum;
}

TEST(Messages, GoThereAndBackToTheBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i)
    each_message([&](auto m) {
      const auto sent = any<decltype(m)>(random);
      const Bytes frame = frame_of(sent);
      ASSERT_GE(frame.size(), min_frame) << int{frame[2]};
      decltype(m) got;
      ASSERT_EQ(decoded(frame, got), Code::done);
      EXPECT_EQ(frame_of(got), frame);
    });
}

TEST(Messages, EachFitsAFrameAtItsLongest) {
  std::mt19937 random(2);
  std::set<std::uint8_t> types;
  each_message([&](auto m) {
    const Bytes frame = frame_of(any<decltype(m)>(random, true));
    EXPECT_GE(frame.size(), min_frame) << int{static_cast<std::uint8_t>(m.type)};
    types.insert(static_cast<std::uint8_t>(m.type));
  });
  EXPECT_EQ(types.size(), 26u) << "each has a type of its own";
}

TEST(Messages, ABodyOfAnyOtherLengthIsRefused) {
  std::mt19937 random(3);
  each_message([&](auto m) {
    const Body body = body_of(any<decltype(m)>(random));
    Bytes bytes(body.bytes.begin(), body.bytes.end());
    bytes.resize(max_body + 1);
    for (std::size_t n = 0; n <= bytes.size(); ++n) {
      decltype(m) out;
      EXPECT_EQ(read(std::span<const std::uint8_t>(bytes).first(n), out) == Code::done,
                n == body.size)
          << int{static_cast<std::uint8_t>(m.type)} << ' ' << n;
    }
  });
}

// For random bytes: an accepted message has exactly these bytes, and all its values are valid.
TEST(Messages, AnyBodyIsRefusedOrReadToTheByte) {
  std::mt19937 random(4);
  int taken = 0;
  for (int i = 0; i < 5'000; ++i)
    each_message([&](auto m) {
      const Body body = body_of(any<decltype(m)>(random));
      Bytes bytes(body.bytes.begin(), body.bytes.begin() + static_cast<long>(body.size));
      for (unsigned k = random() % 3; k > 0 && !bytes.empty(); --k)
        bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      decltype(m) out;
      if (read(std::span<const std::uint8_t>(bytes), out) != Code::done) return;
      ++taken;
      const Body again = body_of(out);
      ASSERT_TRUE(again.ok);
      EXPECT_EQ(Bytes(again.bytes.begin(), again.bytes.begin() + static_cast<long>(again.size)),
                bytes);
    });
  EXPECT_GT(taken, 50'000);
}

TEST(Messages, OneTypeIsNotReadAsAnother) {
  std::mt19937 random(5);
  each_message([&](auto sent) {
    const Bytes frame = frame_of(any<decltype(sent)>(random));
    each_message([&](auto other) {
      const Code code = decoded(frame, other);
      EXPECT_EQ(code == Code::type, sent.type != other.type);
    });
  });
}

TEST(Messages, CommandsThatCannotBeAreNotSent) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::function<void(CommandFor&)> wrong[] = {
      [](CommandFor& c) { c.joints = 9; },
      [](CommandFor& c) { c.periods = 0; },
      [](CommandFor& c) { c.periods = 101; },
      [](CommandFor& c) { c.from = -1; },
      [](CommandFor& c) { c.from = std::numeric_limits<signals::Tick>::max(); },
      [](CommandFor& c) { c.joint[2].stiffness = nan; },
      [](CommandFor& c) { c.joint[2].gains.angle = infinity; },
      [](CommandFor& c) { c.joint[2].gains.velocity = -infinity; },
      [](CommandFor& c) { c.joint[2].duties.extensor_exhaust = 101; },
      [](CommandFor& c) { c.joint[2].duties.flexor_inlet = -1; },
      [](CommandFor& c) { c.joint[2].duties.flexor_exhaust = 256; },
  };
  for (const auto& spoil : wrong) {
    CommandFor c{.joints = 3};
    EXPECT_FALSE(frame_of(c).empty());
    spoil(c);
    EXPECT_TRUE(frame_of(c).empty());
  }
}

// Nothing is read after the last place either: the sanitizers would report it.
TEST(Messages, CountsBeyondTheRoomAreNotSent) {
  EXPECT_TRUE(frame_of(CommandFor{.joints = 255}).empty());
  EXPECT_TRUE(frame_of(ConfigureChunk{.count = 255}).empty());
  EXPECT_TRUE(frame_of(ConfigureChunk{.count = 0}).empty());
  EXPECT_TRUE(frame_of(Reply{.letters = 255}).empty());
  EXPECT_TRUE(frame_of(Readings{.count = 255}).empty());
  EXPECT_TRUE(frame_of(Counters{.count = 255}).empty());
  EXPECT_TRUE(frame_of(Joints{.count = 255}).empty());
  EXPECT_TRUE(frame_of(Edges{.count = 255}).empty());
  EXPECT_TRUE(frame_of(FaultLog{.count = 255}).empty());
}

TEST(Messages, ACommandOfALegIsShort) {
  EXPECT_EQ(frame_of(CommandFor{.joints = 3}).size(), 13u + 11u + 3u * 26u);
}

}  // namespace
}  // namespace sinew::link::messages_test
