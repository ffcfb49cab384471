// firmware/line_ring.h - ring of bytes between an interrupt and the program that it interrupts: one
// puts, the other takes, and neither waits.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace sinew::firmware {

template <std::size_t Size>
class LineRing {
  static_assert((Size & (Size - 1)) == 0, "a power of two");

 public:
  // Returns false if the ring is full.
  bool put(std::uint8_t byte) {
    const std::uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == Size) return false;
    bytes_[end % Size] = byte;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  // Returns false if the ring is empty.
  bool take(std::uint8_t& byte) {
    const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    byte = bytes_[begin % Size];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }
  // Returns the number of bytes that can be put at least; for the side that puts.
  std::size_t room() const {
    return Size - (end_.load(std::memory_order_relaxed) - begin_.load(std::memory_order_acquire));
  }

 private:
  std::array<std::uint8_t, Size> bytes_{};
  std::atomic<std::uint32_t> begin_ = 0, end_ = 0;
};

}  // namespace sinew::firmware
