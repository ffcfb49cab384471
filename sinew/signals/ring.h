// signals/ring.h - the pipe between the loop and another thread: one puts, one takes, neither
// locks.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace sinew::signals {

template <class Item>
class Ring {
 public:
  // All memory is taken here; the size is rounded up to a power of two.
  explicit Ring(std::size_t items) : slots_(std::bit_ceil(items < 2 ? 2 : items)) {}

  // How many items can wait.
  std::size_t capacity() const { return slots_.size(); }

  // The putting thread. False: full.
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

  // The taking thread: hands to `use` what is there now, in order, and frees slots as it goes.
  template <typename Use>
  void take_all(Use&& use) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    for (const std::size_t head = head_.load(std::memory_order_acquire); tail != head;) {
      use(slots_[tail & (capacity() - 1)]);
      tail_.store(++tail, std::memory_order_release);
    }
  }

  // The taking thread: how many wait.
  std::size_t waiting() const noexcept {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_relaxed);
  }

 private:
  // The two ends count up for ever; each stands on a cache line of its own.
  static constexpr std::size_t kLine = 64;
  std::vector<Item> slots_;
  alignas(kLine) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;  // what the putting thread last knew of the other end
  alignas(kLine) std::atomic<std::size_t> tail_{0};
};

}  // namespace sinew::signals
