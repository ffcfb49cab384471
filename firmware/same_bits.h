// firmware/same_bits.h - a hash of all that was done, and dice that roll the same everywhere.
#pragma once

#include <bit>
#include <cstdint>

namespace sinew::firmware {

// Fowler-Noll-Vo, 64 bits, a word at a time.
class Hash {
 public:
  template <class Word>  // 32 bits, whatever they mean
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

// The wire's part of the test: same_bits_link.cpp.
void run_link(std::uint32_t seed, Hash& hash);

}  // namespace sinew::firmware
