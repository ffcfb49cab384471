// units/mix.h - bits that look random, from a number: the same on every machine.
#pragma once

#include <cstdint>

namespace sinew::units {

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
