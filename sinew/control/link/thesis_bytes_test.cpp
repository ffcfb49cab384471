// Tests that the bytes of B.2 have the effects of its table, and that two bytes 255 always shut
// down.
#include "sinew/control/link/thesis_bytes.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "sinew/control/joint/test_leg.h"
#include "sinew/control/link/test_wire.h"

namespace sinew::link::thesis_words_test {
namespace {

using What = ThesisByteResult::What;
using control::cylinder, control::hip, control::knee;

const control::JointControllerConfig leg = control::test_leg();

struct Words : ::testing::Test {
  ThesisByteResult take(std::initializer_list<int> bytes) {
    ThesisByteResult out;
    for (const int b : bytes) out = reader.take(static_cast<std::uint8_t>(b));
    return out;
  }
  const ThesisJoints joints = thesis_joints(leg);
  ThesisByteReader reader{joints};
};

TEST_F(Words, JointsAreCylinderHipAndKnee) {
  EXPECT_TRUE(joints.found);
  EXPECT_EQ(joints.joint, (std::array<std::uint8_t, 3>{cylinder, hip, knee}));
  control::JointControllerConfig other = leg;
  std::swap(other.joint[0], other.joint[2]);
  EXPECT_EQ(thesis_joints(other).joint[0], 2 - cylinder);
  other.joints = 2;
  EXPECT_FALSE(thesis_joints(other).found);
}

// {program, first byte, last byte} of B.2; all other bytes are bad commands.
TEST_F(Words, AreThoseOfTheTable) {
  const struct {
    int first, last;
    What what;
  } table[] = {{0, 2, What::readings},  {3, 3, What::readings},     {5, 8, What::readings},
               {9, 9, What::readings},  {10, 10, What::readings},   {20, 22, What::enable},
               {23, 23, What::enable},  {24, 24, What::enable},     {25, 25, What::ready},
               {30, 32, What::ready},   {41, 42, What::ready},      {50, 50, What::ready},
               {170, 170, What::frame}, {255, 255, What::shut_down}};
  for (int byte = 0; byte < 256; ++byte) {
    What expected = What::bad;
    for (const auto& row : table)
      if (byte >= row.first && byte <= row.last) expected = row.what;
    EXPECT_EQ(ThesisByteReader(joints).take(static_cast<std::uint8_t>(byte)).what, expected)
        << byte;
  }
}

TEST_F(Words, SensorsAreSentLowByteFirst) {
  control::ControllerState state;
  for (std::uint16_t i = 0; i < 7; ++i)
    state.reading[i].counts = static_cast<std::uint16_t>(0x100 + i);
  const auto sent = [&](int word) {
    Bytes out(20);
    const ThesisByteResult step = take({word});
    EXPECT_EQ(step.what, What::readings);
    out.resize(write_readings(step, joints, leg, state, out));
    return out;
  };
  const auto low = [](const control::JointConfig& j) { return j.angle.index; };
  for (int pot = 0; pot < 3; ++pot)
    EXPECT_EQ(sent(pot),
              (Bytes{low(leg.joint[joints.joint[static_cast<std::size_t>(pot)]]), 1, 'F'}));
  EXPECT_EQ(sent(3), (Bytes{0, 1, 1, 1, 2, 1, 'F'}));
  EXPECT_EQ(sent(6), (Bytes{4, 1, 'F'}));
  EXPECT_EQ(sent(9), (Bytes{3, 1, 4, 1, 5, 1, 6, 1, 'F'}));
  EXPECT_EQ(sent(10), (Bytes{0, 1, 1, 1, 2, 1, 3, 1, 4, 1, 5, 1, 6, 1, 'F'}));
  EXPECT_EQ(write_readings(take({10}), joints, leg, state, std::span<std::uint8_t>{}), 0u);
}

TEST_F(Words, JointsAreEnabledAndDisabled) {
  EXPECT_EQ(take({21}).enable.joints, 1u << hip);
  EXPECT_TRUE(take({21}).enable.enabled);
  EXPECT_EQ(take({23}).enable.joints, 7);
  EXPECT_TRUE(take({23}).enable.enabled);
  EXPECT_EQ(take({24}).enable.joints, 7);
  EXPECT_FALSE(take({24}).enable.enabled);
}

TEST_F(Words, ValuesChangeWhatTheyNameAndNothingElse) {
  control::Command command = control::rest_command(leg);
  ThesisByteResult step = take({31, 0x34, 0x02});
  ASSERT_EQ(step.what, What::desired);
  step.apply(command);
  EXPECT_EQ(command.joint[hip].angle, 0x234);
  EXPECT_EQ(command.joint[knee].angle, leg.joint[knee].angle_at_rest);

  step = take({42, 0xe8, 0x03});  // 1000 hundredths
  ASSERT_EQ(step.what, What::desired);
  step.apply(command);
  EXPECT_EQ(command.joint[knee].stiffness, 10.0f);
  EXPECT_EQ(command.joint[hip].stiffness, 0.0f);
  EXPECT_EQ(command.joint[hip].angle, 0x234);

  EXPECT_EQ(take({50, 1, 0}).what, What::ready);
  step = take({2, 0, 3, 0, 100, 0, 200, 0});
  ASSERT_EQ(step.what, What::desired);
  step.apply(command);
  EXPECT_EQ(command.joint[cylinder].angle, 1);
  EXPECT_EQ(command.joint[hip].angle, 2);
  EXPECT_EQ(command.joint[knee].angle, 3);
  EXPECT_EQ(command.joint[hip].stiffness, 1.0f);
  EXPECT_EQ(command.joint[knee].stiffness, 2.0f);
}

TEST_F(Words, FeedforwardIsTheCylinders) {
  const ThesisByteResult step = take({25, 55, 0, 56, 0, 45, 0, 46, 0});
  ASSERT_EQ(step.what, What::feedforward);
  EXPECT_EQ(step.feedforward.joint, cylinder);
  EXPECT_EQ(step.feedforward.duties, (control::Duties{55, 56, 45, 46}));
}

TEST_F(Words, ValuesThatCannotBeAreBad) {
  EXPECT_EQ(take({30, 0x00, 0x10}).what, What::bad);  // 4096 counts
  EXPECT_EQ(take({41, 0x00, 0x80}).what, What::bad);
  EXPECT_EQ(take({25, 101, 0}).what, What::bad);
  EXPECT_EQ(take({50, 0, 0, 0, 0, 0, 0xf0}).what, What::bad);
  EXPECT_EQ(take({3}).what, What::readings) << "and words go on";
}

TEST_F(Words, ASilenceEndsAValue) {
  EXPECT_FALSE(reader.silent());
  take({30, 1});
  EXPECT_TRUE(reader.silent());
  EXPECT_EQ(take({3}).what, What::readings);
  take({0xaa, 0x55, 1});
  EXPECT_FALSE(reader.silent());
  EXPECT_EQ(take({3}).what, What::readings);
}

// In every state except an unfinished frame.
TEST_F(Words, TwoBytes255ShutDown) {
  std::mt19937 random(1);
  constexpr std::uint8_t words[] = {0, 3, 10, 21, 25, 30, 31, 32, 41, 42, 50, 77, 255};
  int within_values = 0;
  for (int i = 0; i < 100'000; ++i) {
    ThesisByteReader any(joints);
    bool framed = false, waits = false;
    for (unsigned k = random() % 12; k > 0; --k) {
      const std::uint8_t byte =
          random() % 2 ? words[random() % 13] : static_cast<std::uint8_t>(random() % 170);
      const What what = any.take(byte).what;
      framed = what == What::frame;
      waits = what == What::ready || what == What::nothing;
    }
    if (framed) continue;
    within_values += waits;
    const bool first = any.take(255).what == What::shut_down;
    EXPECT_TRUE(first || any.take(255).what == What::shut_down);
  }
  EXPECT_GT(within_values, 10'000);
}

TEST_F(Words, AFrameBetweenWordsGoesToTheDecoder) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Bytes frame = any_frame(random, static_cast<std::uint8_t>(i));
    Decoder decoder;
    std::size_t found = 0;
    EXPECT_EQ(take({3}).what, What::readings);
    for (const std::uint8_t byte : frame) {
      EXPECT_EQ(reader.take(byte).what, What::frame);
      feed(decoder, Bytes{byte}, [&](const Frame& f) { found += bytes_of(f) == frame; });
    }
    EXPECT_EQ(found, 1u);
    EXPECT_EQ(take({255}).what, What::shut_down) << "the word behind a frame is a word";
  }
}

TEST_F(Words, AByteThatOnlyLooksLikeAFrameEndsNoWord) {
  EXPECT_EQ(take({0xaa, 255}).what, What::shut_down);
  EXPECT_EQ(take({0xaa, 3}).what, What::readings);
}

}  // namespace
}  // namespace sinew::link::thesis_words_test
