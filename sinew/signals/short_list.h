// signals/short_list.h - a list of few items, copied as bytes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace sinew::signals {

// At most `most` items; the caller checks that there are no more.
template <class T, std::size_t most>
class ShortList {
 public:
  static constexpr std::size_t capacity = most;

  constexpr ShortList() = default;
  constexpr explicit ShortList(std::span<const T> items) {
    for (const T& item : items) push_back(item);
  }

  // Appends an item.
  constexpr void push_back(const T& item) { of_[size_++] = item; }

  // The functions of std::vector.
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr T& operator[](std::size_t i) noexcept { return of_[i]; }
  constexpr const T& operator[](std::size_t i) const noexcept { return of_[i]; }
  constexpr const T* data() const noexcept { return of_.data(); }
  constexpr const T* begin() const noexcept { return of_.data(); }
  constexpr const T* end() const noexcept { return of_.data() + size_; }

 private:
  std::array<T, most> of_{};
  std::size_t size_ = 0;
};

}  // namespace sinew::signals
