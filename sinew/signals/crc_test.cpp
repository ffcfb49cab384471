#include "sinew/signals/crc.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace sinew::signals::crc_test {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

// One bit at a time, as the polynomials are defined.
std::uint16_t slow_crc16(std::span<const std::uint8_t> bytes) {
  std::uint32_t r = 0xffff;
  for (const std::uint8_t b : bytes)
    for (int bit = 7; bit >= 0; --bit) {
      const bool out = (r >> 15 ^ b >> bit) & 1u;
      r = (r << 1 ^ (out ? 0x1021u : 0u)) & 0xffffu;
    }
  return static_cast<std::uint16_t>(r);
}
std::uint32_t slow_crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t r = 0xffffffff;
  for (const std::uint8_t b : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool out = (r ^ static_cast<std::uint32_t>(b >> bit)) & 1u;
      r = r >> 1 ^ (out ? 0xedb88320u : 0u);
    }
  return ~r;
}

// The check values of the catalogue of parametrised CRC algorithms.
TEST(Crc, GivesTheCheckValues) {
  EXPECT_EQ(crc16(bytes_of("123456789")), 0x29b1);
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xcbf43926u);
  EXPECT_EQ(crc16({}), 0xffff);
  EXPECT_EQ(crc32({}), 0u);
}

TEST(Crc, TablesAgreeWithBitByBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 300);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
    EXPECT_EQ(crc16(bytes), slow_crc16(bytes));
    EXPECT_EQ(crc32(bytes), slow_crc32(bytes));
    const std::span<const std::uint8_t> all(bytes);
    const std::size_t cut = random() % (bytes.size() + 1);
    EXPECT_EQ(crc32(all.subspan(cut), crc32(all.first(cut))), crc32(bytes));
  }
}

}  // namespace
}  // namespace sinew::signals::crc_test
