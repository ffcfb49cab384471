// control/board/ring.h - bytes that wait, oldest first; and records of them of which old ones are
// given up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::board {

template <std::size_t Size>
class Ring {
 public:
  std::size_t size() const noexcept { return size_; }
  // How many more bytes there is room for.
  std::size_t room() const noexcept { return Size - size_; }

  // All of them or, false, none.
  bool push(std::span<const std::uint8_t> bytes) noexcept {
    if (bytes.size() > room()) return false;
    for (const std::uint8_t byte : bytes) bytes_[(first_ + size_++) % Size] = byte;
    return true;
  }

  // As many as there are and `out` holds; how many.
  std::size_t pop(std::span<std::uint8_t> out) noexcept {
    const std::size_t n = out.size() < size_ ? out.size() : size_;
    for (std::size_t i = 0; i < n; ++i) out[i] = bytes_[(first_ + i) % Size];
    drop(n);
    return n;
  }
  void drop(std::size_t n) noexcept {
    first_ = (first_ + n) % Size;
    size_ -= n;
  }

  // The byte behind so many; place < size().
  std::uint8_t at(std::size_t place) const noexcept { return bytes_[(first_ + place) % Size]; }

 private:
  std::array<std::uint8_t, Size> bytes_{};
  std::size_t first_ = 0, size_ = 0;
};

// Log keeps the records of the last periods, each a kind and up to 255 bytes.
template <std::size_t Size>
class Log {
 public:
  // One of the records that wait.
  struct Record {
    std::uint8_t kind = 0, size = 0;
    std::size_t place = 0;  // of its first byte, for byte()
  };

  // A period begins with the next record; those before the last `periods` are given up.
  void begin_period(std::size_t periods) noexcept {
    while (periods_ >= periods && periods_ > 0) drop_period();
    ++periods_;
    opens_ = true;
  }

  // Old periods make room. Records of a period that is longer than all the room are left out.
  void add(std::uint8_t kind, std::span<const std::uint8_t> data) noexcept {
    if (data.size() > 255 || data.size() + head > Size) return;
    while (bytes_.room() < data.size() + head && periods_ > 1) drop_period();
    const std::uint8_t before[head] = {kind, static_cast<std::uint8_t>(data.size()), opens_};
    if (bytes_.room() < data.size() + head) return;
    bytes_.push(before);
    bytes_.push(data);
    opens_ = false;
    ++records_;
  }

  // Gives all of them up.
  void clear() noexcept {
    bytes_.drop(bytes_.size());
    records_ = periods_ = 0;
    opens_ = false;
  }

  // How many records wait, and how many periods they are of.
  std::size_t records() const noexcept { return records_; }
  std::size_t periods() const noexcept { return periods_; }
  // i < records()
  Record record(std::size_t i) const noexcept {
    std::size_t place = 0;
    for (; i > 0; --i) place += head + bytes_.at(place + 1);
    return {bytes_.at(place), bytes_.at(place + 1), place + head};
  }
  std::uint8_t byte(std::size_t place) const noexcept { return bytes_.at(place); }

 private:
  static constexpr std::size_t head = 3;  // kind, size, does a period begin here?

  void drop_period() noexcept {
    do {
      if (records_ == 0) break;
      bytes_.drop(head + bytes_.at(1));
      --records_;
    } while (records_ > 0 && bytes_.at(2) == 0);
    --periods_;
  }

  Ring<Size> bytes_;
  std::size_t records_ = 0, periods_ = 0;
  bool opens_ = false;
};

}  // namespace sinew::board
