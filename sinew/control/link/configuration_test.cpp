// Tests that a configuration is transferred completely and exactly, or not at all.
#include "sinew/control/link/configuration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "sinew/control/link/test_wire.h"
#include "sinew/control/supervise/test_fuzz.h"
#include "sinew/signals/crc.h"

namespace sinew::link::configuration_test {
namespace {

Configuration any_configuration(std::mt19937& random) {
  Configuration out{control::any_leg(random), {}};
  for (std::size_t s = 0; s < 7; ++s)
    out.limits.sensor[s] = {.low = 100, .high = 4000, .max_step = 50, .joint = 1};
  return out;
}

ConfigurationBytes bytes_of(const Configuration& c) {
  ConfigurationBytes out;
  EXPECT_TRUE(write(c, out));
  return out;
}

struct Board {
  ConfigurationReceiver receiver;
  Configuration has;

  Refusal receive(const ConfigurationSender& sender) {
    EXPECT_EQ(receiver.take(sender.begin()), Code::done);
    for (std::size_t i = 0; i < sender.chunks; ++i)
      EXPECT_EQ(receiver.take(sender.chunk(i)), Code::done) << i;
    return receiver.take(sender.end(), has);
  }
};

TEST(Configuration, ArrivesToTheBit) {
  std::mt19937 random(1);
  Board board;
  for (int i = 0; i < 50; ++i) {
    const Configuration sent = any_configuration(random);
    ASSERT_EQ(control::problem(sent.joint_controller), nullptr);
    EXPECT_EQ(board.receive(ConfigurationSender(sent)).code, Code::done);
    EXPECT_EQ(bytes_of(board.has), bytes_of(sent));
  }
}

// Every field of the structs is transferred, with any valid value.
TEST(Configuration, EveryFieldHasItsBytes) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const auto sent = any<Configuration>(random);
    const ConfigurationBytes bytes = bytes_of(sent);
    Configuration got;
    EXPECT_EQ(read<Configuration>(bytes, got), Code::done);
    EXPECT_EQ(bytes_of(got), bytes);
  }
}

// Bytes of a struct that no field list sets keep their default: only padding may be left. This
// would detect a field of a type that the count of members does not include.
TEST(Configuration, NothingButHolesIsLeftOut) {
  const auto unset = [](std::mt19937& random, auto default_value) {
    using M = decltype(default_value);
    std::vector<bool> changed(sizeof(M));
    for (int i = 0; i < 64; ++i) {
      M other = default_value;
      RandomFields io(random);
      fields(io, other);
      Bytes a(sizeof(M)), b(sizeof(M));
      std::memcpy(a.data(), &default_value, sizeof(M));
      std::memcpy(b.data(), &other, sizeof(M));
      for (std::size_t k = 0; k < sizeof(M); ++k)
        if (a[k] != b[k]) changed[k] = true;
    }
    return std::ranges::count(changed, false);
  };
  std::mt19937 random(3);
  EXPECT_EQ(unset(random, control::Gains{}), 0);
  EXPECT_EQ(unset(random, control::RegulatorConfig{}), 0);
  EXPECT_EQ(unset(random, signals::Conversion{}), 1);
  EXPECT_EQ(unset(random, signals::ValveTiming{}), 0);
  EXPECT_LE(unset(random, control::SensorLimits{}), 2);
  EXPECT_LE(unset(random, control::CommandLimits{}), 0);
}

TEST(Configuration, ValuesThatCannotBeAreNotSent) {
  Configuration c{control::test_leg(), {}};
  EXPECT_TRUE(ConfigurationSender(c).ok());
  c.joint_controller.joint[1].flexor.effectiveness[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(ConfigurationSender(c).ok());
  c = {control::test_leg(), {}};
  c.joint_controller.joints = 9;
  EXPECT_FALSE(ConfigurationSender(c).ok());
  c = {control::test_leg(), {}};
  c.limits.sensor[31].joint = 8;
  EXPECT_FALSE(ConfigurationSender(c).ok());
}

TEST(Configuration, PartsThatContradictEachOtherAreRefusedInWords) {
  Board board;
  const Configuration good{control::test_leg(), {}};
  EXPECT_EQ(board.receive(ConfigurationSender(good)).code, Code::done);

  Configuration bad = good;
  bad.joint_controller.joint[control::hip].law_tick = 8;
  Refusal refusal = board.receive(ConfigurationSender(bad));
  EXPECT_EQ(refusal.code, Code::configuration);
  EXPECT_STREQ(refusal.words, control::problem(bad.joint_controller));

  bad = good;
  bad.limits.gap_shut = 0;
  refusal = board.receive(ConfigurationSender(bad));
  EXPECT_EQ(refusal.code, Code::configuration);
  EXPECT_STREQ(refusal.words, control::problem(bad.limits));

  bad = good;
  bad.safety.host_vent = 1;
  refusal = board.receive(ConfigurationSender(bad));
  EXPECT_EQ(refusal.code, Code::configuration);
  EXPECT_STREQ(refusal.words, control::problem(bad.safety));

  bad = good;
  bad.joint_controller.timing.closing[50] = 2;
  refusal = board.receive(ConfigurationSender(bad));
  EXPECT_EQ(refusal.code, Code::configuration);
  EXPECT_STREQ(refusal.words, control::safety_problem(bad.joint_controller));
}

TEST(Configuration, EachProblemFitsAnAnswer) {
  Configuration bad{control::test_leg(), {}};
  bad.joint_controller.joint[control::hip].flexor.exhaust_inverted = true;  // the longest text
  ASSERT_NE(control::problem(bad.joint_controller), nullptr);
  EXPECT_LE(std::string(control::problem(bad.joint_controller)).size(), max_text);
}

TEST(Configuration, AnotherLayoutIsRefused) {
  ConfigurationBytes bytes = bytes_of({control::test_leg(), {}});
  Configuration out;
  EXPECT_EQ(read(bytes, out).code, Code::done);
  EXPECT_EQ(read(std::span(bytes).first(configuration_size - 1), out).code, Code::size);
  bytes[0] = static_cast<std::uint8_t>(configuration_layout + 1);
  EXPECT_EQ(read(bytes, out).code, Code::layout);
}

// --- failed transfers ---------------------------------------------------------------------------

class Transfer : public ::testing::Test {
 protected:
  void begin_and_chunks(std::size_t n) {
    ASSERT_EQ(board.receiver.take(sender.begin()), Code::done);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(board.receiver.take(sender.chunk(i)), Code::done);
  }
  // A new transfer succeeds.
  void expect_refused_as_a_whole() {
    EXPECT_EQ(board.receiver.take(sender.end(), board.has).code, Code::order);
    EXPECT_EQ(bytes_of(board.has), bytes_of({}));
    EXPECT_EQ(board.receive(sender).code, Code::done);
  }

  const ConfigurationSender sender{Configuration{control::test_leg(), {}}};
  Board board;
};

TEST_F(Transfer, NeedsABegin) {
  EXPECT_EQ(board.receiver.take(sender.chunk(0)), Code::order);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, ASecondBeginEndsIt) {
  begin_and_chunks(3);
  EXPECT_EQ(board.receiver.take(sender.begin()), Code::order);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, AGapEndsIt) {
  begin_and_chunks(3);
  EXPECT_EQ(board.receiver.take(sender.chunk(4)), Code::gap);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, AnOverlapEndsIt) {
  begin_and_chunks(3);
  EXPECT_EQ(board.receiver.take(sender.chunk(2)), Code::gap);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, TooFewBytesEndIt) {
  begin_and_chunks(sender.chunks - 1);
  EXPECT_EQ(board.receiver.take(sender.end(), board.has).code, Code::size);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, TooManyBytesEndIt) {
  begin_and_chunks(sender.chunks);
  EXPECT_EQ(board.receiver.take(ConfigureChunk{.offset = configuration_size, .count = 1}),
            Code::size);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, AnotherSizeIsRefusedAtOnce) {
  EXPECT_EQ(board.receiver.take(ConfigureBegin{configuration_size - 1, sender.crc()}), Code::size);
  EXPECT_EQ(board.receiver.take(ConfigureBegin{65535, sender.crc()}), Code::size);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, OneWrongByteEndsIt) {
  ASSERT_EQ(board.receiver.take(sender.begin()), Code::done);
  for (std::size_t i = 0; i < sender.chunks; ++i) {
    ConfigureChunk chunk = sender.chunk(i);
    if (i == 5) chunk.data[7] ^= 1u;
    ASSERT_EQ(board.receiver.take(chunk), Code::done);
  }
  EXPECT_EQ(board.receiver.take(sender.end(), board.has).code, Code::checksum);
  expect_refused_as_a_whole();
}
TEST_F(Transfer, AnEndOfAnotherOneEndsIt) {
  begin_and_chunks(sender.chunks);
  EXPECT_EQ(board.receiver.take(ConfigureEnd{sender.crc() ^ 1u}, board.has).code, Code::checksum);
  expect_refused_as_a_whole();
}

}  // namespace
}  // namespace sinew::link::configuration_test
