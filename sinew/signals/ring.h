// signals/ring.h - lock-free queue between the loop and another thread: one writer, one reader.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace sinew::signals {

template <class Item>
class Ring {
 public:
  // Allocates all memory; the size is rounded up to a power of two.
  explicit Ring(std::size_t items) : slots_(std::bit_ceil(items < 2 ? 2 : items)) {}

  // Returns the number of items that can wait.
  std::size_t capacity() const { return slots_.size(); }

  // For the writer. Returns false if the queue is full.
  bool put(const Item& item) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_seen_ == capacity()) {
      tail_seen_ = tail_.load(std::memory_order_acquire);
      if (head - tail_seen_ == capacity()) return false;
    }
    slots_[head & (capacity() - 1)] = item;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // For the reader: calls `use` with all present items in order, and frees each slot after its use.
  template <typename Use>
  void take_all(Use&& use) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    for (const std::size_t head = head_.load(std::memory_order_acquire); tail != head;) {
      use(slots_[tail & (capacity() - 1)]);
      tail_.store(++tail, std::memory_order_release);
    }
  }

  // For the reader: returns the number of items that wait.
  std::size_t waiting() const noexcept {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_relaxed);
  }

 private:
  // The two ends count up without wrapping; each has its own cache line.
  static constexpr std::size_t kLine = 64;
  std::vector<Item> slots_;
  alignas(kLine) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;  // tail as last read by the writer
  alignas(kLine) std::atomic<std::size_t> tail_{0};
};

}  // namespace sinew::signals
