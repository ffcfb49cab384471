// signals/crc.h - two checksums of bytes, for frames on a wire and for memory that must not change.
//
//   crc16  CCITT-FALSE: polynomial 0x1021, begins with 0xffff, most significant bit first, result
//   as
//          it is. "123456789" gives 0x29b1. It finds every burst of 16 bits and, up to 4 kB, every
//          three flipped bits.
//   crc32  IEEE 802.3: polynomial 0x04c11db7 reflected, begins with 0xffffffff, result inverted.
//          "123456789" gives 0xcbf43926. It finds every burst of 32 bits and, up to 11 kB, every
//          three flipped bits.
//
// Four bits at a time: a table for each of 16 entries, 96 bytes in all. Embedded core.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::signals {

namespace crc_tables {

// Returns the checksum of each half byte by the 16-bit polynomial.
constexpr std::array<std::uint16_t, 16> ccitt() noexcept {
  std::array<std::uint16_t, 16> out{};
  for (std::uint32_t i = 0; i < 16; ++i) {
    std::uint32_t r = i << 12;
    for (int bit = 0; bit < 4; ++bit) r = r & 0x8000u ? r << 1 ^ 0x1021u : r << 1;
    out[i] = static_cast<std::uint16_t>(r);
  }
  return out;
}

// Returns the checksum of each half byte by the 32-bit polynomial.
constexpr std::array<std::uint32_t, 16> ieee() noexcept {
  std::array<std::uint32_t, 16> out{};
  for (std::uint32_t i = 0; i < 16; ++i) {
    std::uint32_t r = i;
    for (int bit = 0; bit < 4; ++bit) r = r & 1u ? r >> 1 ^ 0xedb88320u : r >> 1;
    out[i] = r;
  }
  return out;
}

inline constexpr std::array<std::uint16_t, 16> of_16 = ccitt();
inline constexpr std::array<std::uint32_t, 16> of_32 = ieee();

}  // namespace crc_tables

// Returns the checksum CCITT-FALSE of the bytes.
constexpr std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
  std::uint32_t r = 0xffff;
  for (const std::uint8_t byte : bytes) {
    r = (r << 4 ^ crc_tables::of_16[(r >> 12 ^ byte >> 4) & 15u]) & 0xffffu;
    r = (r << 4 ^ crc_tables::of_16[(r >> 12 ^ byte) & 15u]) & 0xffffu;
  }
  return static_cast<std::uint16_t>(r);
}

// `before`: the sum of what came before, to go on with.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes,
                              std::uint32_t before = 0) noexcept {
  std::uint32_t r = ~before;
  for (const std::uint8_t byte : bytes) {
    r = r >> 4 ^ crc_tables::of_32[(r ^ byte) & 15u];
    r = r >> 4 ^ crc_tables::of_32[(r ^ byte >> 4) & 15u];
  }
  return ~r;
}

}  // namespace sinew::signals
