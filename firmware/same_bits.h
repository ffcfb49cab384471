// firmware/same_bits.h - a hash of results and a random generator that are the same on all
// machines.
#pragma once

#include <bit>
#include <cstdint>

namespace sinew::firmware {

// Fowler-Noll-Vo hash, 64 bits, one word of 32 bits at a time.
class Hash {
 public:
  template <class Word>  // any type of 32 bits
  void add(Word word) {
    value_ = (value_ ^ std::bit_cast<std::uint32_t>(word)) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// xorshift32 (Marsaglia 2003)
class Random {
 public:
  constexpr explicit Random(std::uint32_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t n) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return (state_ >> 8) % n;
  }
  float unit() { return static_cast<float>(below(1u << 24)) / static_cast<float>(1u << 24); }

 private:
  std::uint32_t state_;
};

// Runs the wire's part of the test (same_bits_link.cpp).
void run_link(std::uint32_t seed, Hash& hash);

}  // namespace sinew::firmware
