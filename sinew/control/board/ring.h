// control/board/ring.h - a ring of waiting bytes, oldest first; and a log of records that drops old
// ones.
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
  // Returns the number of bytes that can be added.
  std::size_t room() const noexcept { return Size - size_; }

  // Adds all bytes, or none and returns false.
  bool push(std::span<const std::uint8_t> bytes) noexcept {
    if (bytes.size() > room()) return false;
    for (const std::uint8_t byte : bytes) bytes_[(first_ + size_++) % Size] = byte;
    return true;
  }

  // Removes up to out.size() bytes. Returns their number.
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

  // Returns the byte at that distance from the oldest; place < size().
  std::uint8_t at(std::size_t place) const noexcept { return bytes_[(first_ + place) % Size]; }

 private:
  std::array<std::uint8_t, Size> bytes_{};
  std::size_t first_ = 0, size_ = 0;
};

// Records of the last periods, each with a kind and up to 255 bytes.
template <std::size_t Size>
class Log {
 public:
  // A stored record.
  struct Record {
    std::uint8_t kind = 0, size = 0;
    std::size_t place = 0;  // place of its first byte, for byte()
  };

  // Begins a period with the next record; only the last `periods` periods are kept.
  void begin_period(std::size_t periods) noexcept {
    while (periods_ >= periods && periods_ > 0) drop_period();
    ++periods_;
    opens_ = true;
  }

  // Adds a record and drops old periods if necessary. Records of a period that does not fit are
  // left out.
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

  // Removes all records.
  void clear() noexcept {
    bytes_.drop(bytes_.size());
    records_ = periods_ = 0;
    opens_ = false;
  }

  // Return the number of records and of their periods.
  std::size_t records() const noexcept { return records_; }
  std::size_t periods() const noexcept { return periods_; }
  // Returns a record, i < records().
  Record record(std::size_t i) const noexcept {
    std::size_t place = 0;
    for (; i > 0; --i) place += head + bytes_.at(place + 1);
    return {bytes_.at(place), bytes_.at(place + 1), place + head};
  }
  std::uint8_t byte(std::size_t place) const noexcept { return bytes_.at(place); }

 private:
  static constexpr std::size_t head = 3;  // kind, size, whether a period begins here

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
