// units/hash.h - a pseudo-random number from a number, and a hash of bytes (FNV-1a of 64 bits), the
// same on every computer. They protect against mistakes, not against attacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace sinew::units {

inline std::uint64_t hash(std::span<const std::byte> bytes, std::uint64_t h = 0xcbf29ce484222325) {
  for (const std::byte b : bytes) {
    h ^= std::to_integer<std::uint64_t>(b);
    h *= 0x100000001b3;
  }
  return h;
}

inline std::uint64_t hash(std::string_view text, std::uint64_t h = 0xcbf29ce484222325) {
  return hash(std::as_bytes(std::span(text.data(), text.size())), h);
}

// Pseudo-random bits from a number: the same on every computer.

// Returns a bijection of x with full avalanche: every input bit flips half of the output's.
constexpr std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93ull;
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93ull;
  x ^= x >> 32;
  return x;
}

}  // namespace sinew::units
