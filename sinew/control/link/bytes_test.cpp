// Tests conversion of numbers to bytes and back; nothing is written or read beyond the end.
#include "sinew/control/link/bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace sinew::link::bytes_test {
namespace {

TEST(Bytes, AreLittleEndian) {
  std::array<std::uint8_t, 32> out{};
  Writer to(out);
  to.whole(std::uint16_t{0x1234});
  to.whole(std::int32_t{-2});
  to.whole(1.5f);
  to.whole(std::int64_t{0x0102030405060708});
  const std::vector<std::uint8_t> expected{0x34, 0x12, 0xfe, 0xff, 0xff, 0xff, 0, 0, 0xc0,
                                           0x3f, 8,    7,    6,    5,    4,    3, 2, 1};
  EXPECT_EQ(std::vector(out.begin(), out.begin() + static_cast<long>(to.size())), expected);
}

TEST(Bytes, FloatsKeepTheirBits) {
  for (const std::uint32_t bits :
       {0x80000000u, 0x7fc12345u, 0x7f812345u, 0xff800000u, 1u, 0x3f800000u}) {
    std::array<std::uint8_t, 4> bytes{};
    Writer(bytes).whole(std::bit_cast<float>(bits));
    float back = 0;
    Reader(bytes).whole(back);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back), bits);
  }
}

TEST(Bytes, AWriterStopsAtTheEnd) {
  std::array<std::uint8_t, 8> bytes{};
  Writer to{std::span<std::uint8_t>(bytes).first(5)};
  to.whole(std::uint32_t{0xffffffff});
  to.whole(std::uint16_t{0xffff});
  EXPECT_FALSE(to.ok());
  EXPECT_EQ(to.size(), 4u);
  to.whole(std::uint8_t{0xff});  // nothing is written after a refusal
  EXPECT_EQ(to.size(), 4u);
  EXPECT_EQ(bytes[4], 0);
}

TEST(Bytes, AReaderStopsAtTheEnd) {
  const std::array<std::uint8_t, 5> bytes{1, 0, 0, 0, 7};
  Reader from(bytes);
  std::uint32_t a = 0;
  std::uint16_t b = 9;
  std::uint8_t c = 9;
  from.whole(a);
  EXPECT_TRUE(from.ok());
  from.whole(b);
  from.whole(c);
  EXPECT_EQ(a, 1u);
  EXPECT_EQ(b, 9);
  EXPECT_EQ(c, 9);
  EXPECT_FALSE(from.ok());
  EXPECT_TRUE(from.too_short());
}

TEST(Bytes, WhatIsNoFlagIsRefused) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::array<std::uint8_t, 1> bytes{static_cast<std::uint8_t>(byte)};
    bool on = false;
    Reader from(bytes);
    flag(from, on);
    EXPECT_EQ(from.ok(), byte < 2) << byte;
    EXPECT_EQ(on, byte == 1) << byte;
  }
}

// A number that does not fit its bytes must not wrap around into the range.
TEST(Bytes, WhatWouldWrapIsNotWritten) {
  for (const std::int32_t duty :
       {-1, 101, 256, 257, 300, -256, 65536 + 50, std::numeric_limits<std::int32_t>::min()}) {
    std::array<std::uint8_t, 1> bytes{};
    Writer to(bytes);
    number_as<std::uint8_t>(to, duty, 0, 100);
    EXPECT_FALSE(to.ok()) << duty;
  }
}

TEST(Bytes, WhatIsNotFiniteIsRefusedBothWays) {
  for (const float x :
       {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
        std::numeric_limits<float>::quiet_NaN()}) {
    std::array<std::uint8_t, 4> bytes{};
    Writer to(bytes);
    to.finite(x);
    EXPECT_FALSE(to.ok());
    Writer(bytes).whole(x);
    float back = 3;
    Reader from(bytes);
    from.finite(back);
    EXPECT_FALSE(from.ok());
    EXPECT_EQ(back, 3);
  }
}

}  // namespace
}  // namespace sinew::link::bytes_test
