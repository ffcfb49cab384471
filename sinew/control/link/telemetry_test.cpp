// Tests that telemetry is transferred exactly, and that lost parts leave a gap.
#include "sinew/control/link/telemetry.h"

#include <gtest/gtest.h>

#include <cstring>

#include "sinew/control/link/test_wire.h"
#include "sinew/control/supervise/test_stand.h"

namespace sinew::link::telemetry_test {
namespace {

constexpr std::uint16_t period = 100;

// All fields of both that are sent, for any number of joints and channels.
Bytes all_of(const Telemetry& t) {
  Bytes out;
  for (std::uint8_t p = 0; p < parts_of(t.joints, t.channels); ++p) {
    const TelemetryMessage m = part_of(t, p);
    EXPECT_TRUE(m.body.ok);
    out.insert(out.end(), m.body.bytes.begin(),
               m.body.bytes.begin() + static_cast<long>(m.body.size));
  }
  return out;
}

Telemetry any_telemetry(std::mt19937& random, signals::Tick tick) {
  const auto state = any<State>(random);
  Telemetry out{.tick = tick,
                .state = state.state,
                .fault = state.fault,
                .joints = state.joints,
                .channels = state.channels,
                .controller = state.controller,
                .supervised = state.supervised,
                .link = state.link};
  RandomFields io(random);
  for (std::size_t j = 0; j < out.joints; ++j) fields(io, out.controller.joint[j]);
  for (std::size_t c = 0; c < out.channels; ++c) {
    const auto channel = any<ChannelReading>(random);
    fields(io, out.supervised.sensor[c]);
    out.controller.reading[c] = channel.reading;
    out.supervised.sensor[c].counts = channel.counts;
  }
  return out;
}

// Returns the telemetry after its transfer, without the parts whose bit is set.
const Telemetry* carry(TelemetryJoiner& joiner, const Telemetry& t, unsigned without = 0) {
  const Telemetry* out = nullptr;
  for (std::uint8_t p = 0; p < parts_of(t.joints, t.channels); ++p) {
    const TelemetryMessage m = part_of(t, p);
    if (without >> p & 1u) continue;
    const Telemetry* now = joiner.take(static_cast<std::uint8_t>(m.type), m.body.span());
    EXPECT_EQ(out, nullptr) << "nothing follows the last part";
    out = now;
  }
  return out;
}

TEST(Telemetry, ArrivesToTheBit) {
  std::mt19937 random(1);
  TelemetryJoiner joiner(period);
  for (int i = 0; i < 500; ++i) {
    const Telemetry sent = any_telemetry(random, 100 * i);
    const Telemetry* got = carry(joiner, sent);
    ASSERT_NE(got, nullptr);
    EXPECT_EQ(all_of(*got), all_of(sent));
  }
  EXPECT_EQ(joiner.lost(), 0u);
}

// A supervised leg with false readings and late ticks, compared as memory (these structs have no
// padding).
TEST(Telemetry, OfASupervisedLegIsWhatItHasSeen) {
  control::Stand stand;
  stand.replace_reading = control::constant_reading(control::hip_angle, 4095, 40, 2);
  stand.fill();
  TelemetryJoiner joiner(period);
  for (int i = 0; i < 100; ++i) {
    stand.run(1);
    const Telemetry sent{.tick = 100 * i,
                         .state = control::BoardState::armed,
                         .joints = 3,
                         .channels = channels_of(stand.supervisor.config()),
                         .controller = stand.supervisor.state(),
                         .supervised = stand.supervisor.supervised()};
    ASSERT_EQ(sent.channels, 7);
    const Telemetry* got = carry(joiner, sent);
    ASSERT_NE(got, nullptr);
    for (std::size_t j = 0; j < control::max_joints; ++j) {
      const control::JointState &a = sent.controller.joint[j], &b = got->controller.joint[j];
      EXPECT_EQ(a.law_at, b.law_at);
      EXPECT_EQ(std::memcmp(&a.stiffness, &b.stiffness, 4 * sizeof(float)), 0);
      EXPECT_EQ(a.duties, b.duties);
    }
    EXPECT_EQ(got->supervised.rejected, sent.supervised.rejected);
    EXPECT_EQ(all_of(*got), all_of(sent));
  }
  EXPECT_GT(stand.supervised().rejected, 0u);
}

TEST(Telemetry, APeriodWithoutOneOfItsPartsIsLostAndCounted) {
  std::mt19937 random(2);
  TelemetryJoiner joiner(period);
  std::uint32_t lost = 0;
  ASSERT_NE(carry(joiner, any_telemetry(random, 0)), nullptr);
  for (int i = 1; i < 2000; ++i) {
    const Telemetry sent = any_telemetry(random, 100 * i);
    const std::size_t parts = parts_of(sent.joints, sent.channels);
    const unsigned without = random() % 4 || i == 1999 ? 0 : random() & ((1u << parts) - 1);
    const Telemetry* got = carry(joiner, sent, without);
    EXPECT_EQ(got == nullptr, without != 0);
    lost += without != 0;
  }
  EXPECT_EQ(joiner.lost(), lost);
}

// Parts of two periods are never joined.
TEST(Telemetry, PartsOfDifferentPeriodsDoNotMix) {
  std::mt19937 random(3);
  Telemetry a = any_telemetry(random, 0), b = any_telemetry(random, 100);
  a.joints = b.joints = 8;
  a.channels = b.channels = 32;
  for (std::uint8_t cut = 1; cut < parts_of(8, 32); ++cut) {
    TelemetryJoiner joiner(period);
    for (std::uint8_t p = 0; p < parts_of(8, 32); ++p) {
      const TelemetryMessage m = part_of(p < cut ? a : b, p);
      EXPECT_EQ(joiner.take(static_cast<std::uint8_t>(m.type), m.body.span()), nullptr);
    }
    EXPECT_NE(carry(joiner, b), nullptr) << "and the next one is whole";
  }
}

TEST(Telemetry, OtherMessagesBetweenItsPartsDoNotDisturbIt) {
  std::mt19937 random(4);
  const Telemetry sent = any_telemetry(random, 0);
  TelemetryJoiner joiner(period);
  const Telemetry* got = nullptr;
  for (std::uint8_t p = 0; p < parts_of(sent.joints, sent.channels); ++p) {
    const TelemetryMessage m = part_of(sent, p);
    got = joiner.take(static_cast<std::uint8_t>(m.type), m.body.span());
    const Body event = body_of(any<Event>(random));
    joiner.take(static_cast<std::uint8_t>(Type::event), event.span());
  }
  EXPECT_NE(got, nullptr);
}

// The parts are logged without change.
TEST(Telemetry, EachPartFitsTheFaultLog) {
  std::mt19937 random(5);
  Telemetry t = any_telemetry(random, 0);
  t.joints = 8;
  t.channels = 32;
  for (std::uint8_t p = 0; p < parts_of(8, 32); ++p) EXPECT_LE(part_of(t, p).body.size, max_logged);
}

}  // namespace
}  // namespace sinew::link::telemetry_test
