// control/link/bytes.h - conversion of numbers to bytes, little-endian, and back, with checks of
// size and range.
//
// A message lists its fields once (messages.h); Writer and Reader use the same list, so that both
// ends agree. Both have
//
//   whole(x)               an integer, a float, all of its bits
//   limited(x, low, high)  the same, refused outside the range
//   finite(x)              a float, refused if it is infinite or NaN
//
// and the functions below for other types. After a refusal ok() is false, and nothing more is
// written or read.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace sinew::link {

namespace as_bits {

// Unsigned integer of the size of a type.
template <class T>
using Of = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

}  // namespace as_bits

// Returns whether x is finite: infinity and NaN have all bits of the exponent set.
constexpr bool is_finite(float x) noexcept {
  return (std::bit_cast<std::uint32_t>(x) & 0x7f800000u) != 0x7f800000u;
}

// Writes numbers as consecutive bytes.
class Writer {
 public:
  static constexpr bool reads = false;

  // Starts at the front of `out`.
  constexpr explicit Writer(std::span<std::uint8_t> out) noexcept : out_(out) {}

  // Return whether all numbers fitted and were in range, and the number of bytes so far.
  constexpr bool ok() const noexcept { return ok_; }
  constexpr std::size_t size() const noexcept { return size_; }

  // Writes the bytes of a number, lowest first.
  template <class T>
  constexpr void whole(const T& x) noexcept {
    require(out_.size() - size_ >= sizeof(T));
    if (!ok_) return;
    as_bits::Of<T> bits = std::bit_cast<as_bits::Of<T>>(x);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      out_[size_++] = static_cast<std::uint8_t>(bits & 0xffu);
      if constexpr (sizeof(T) > 1) bits = static_cast<as_bits::Of<T>>(bits >> 8);
    }
  }

  // Write a number that has to be within the bounds, or finite.
  template <class T>
  constexpr void limited(const T& x, T low, T high) noexcept {
    require(x >= low && x <= high);
    whole(x);
  }
  constexpr void finite(const float& x) noexcept {
    require(is_finite(x));
    whole(x);
  }

 private:
  constexpr void require(bool holds) noexcept { ok_ = ok_ && holds; }

  std::span<std::uint8_t> out_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

// Reads numbers. A number that is missing or out of range leaves its variable unchanged.
class Reader {
 public:
  static constexpr bool reads = true;

  // Starts at the front of `in`.
  constexpr explicit Reader(std::span<const std::uint8_t> in) noexcept : in_(in) {}

  // Returns whether all numbers were present and in range.
  constexpr bool ok() const noexcept { return ok_; }
  // Returns whether bytes were missing; otherwise a refusal is due to a value.
  constexpr bool too_short() const noexcept { return too_short_; }
  constexpr std::size_t left() const noexcept { return in_.size() - size_; }

  // Reads a number.
  template <class T>
  constexpr void whole(T& x) noexcept {
    if (!ok_) return;
    if (left() < sizeof(T)) {
      ok_ = false;
      too_short_ = true;
      return;
    }
    as_bits::Of<T> bits = 0;
    for (std::size_t i = sizeof(T); i-- > 0;) {
      if constexpr (sizeof(T) > 1) bits = static_cast<as_bits::Of<T>>(bits << 8);
      bits = static_cast<as_bits::Of<T>>(bits | in_[size_ + i]);
    }
    size_ += sizeof(T);
    x = std::bit_cast<T>(bits);
  }

  // Read a number that has to be within the bounds, or finite; otherwise `x` is unchanged.
  template <class T>
  constexpr void limited(T& x, T low, T high) noexcept {
    T found = low;
    whole(found);
    if (found < low || found > high) ok_ = false;
    if (ok_) x = found;
  }
  constexpr void finite(float& x) noexcept {
    float found = 0;
    whole(found);
    if (!is_finite(found)) ok_ = false;
    if (ok_) x = found;
  }

 private:
  std::span<const std::uint8_t> in_;
  std::size_t size_ = 0;
  bool ok_ = true, too_short_ = false;
};

// Counts the bytes that a Writer would write.
class Sizer {
 public:
  static constexpr bool reads = false;

  constexpr std::size_t size() const noexcept { return size_; }

  // Counts the bytes that a Writer would write.
  template <class T>
  constexpr void whole(const T&) noexcept {
    size_ += sizeof(T);
  }
  template <class T>
  constexpr void limited(const T& x, T, T) noexcept {
    whole(x);
  }
  constexpr void finite(const float& x) noexcept { whole(x); }

 private:
  std::size_t size_ = 0;
};

// --- other types than numbers, for both directions ----------------------------------------------

// Converts `x` as a number of type T between low and high.
template <class T, class Io, class X>
constexpr void number_as(Io& io, X& x, T low, T high) noexcept {
  T value = low;
  if constexpr (Io::reads) {
    io.limited(value, low, high);
    x = static_cast<X>(value);
  } else {
    // A value that does not fit the smaller type must not wrap into the range.
    const bool fits = static_cast<X>(static_cast<T>(x)) == x;
    value = fits ? static_cast<T>(x) : static_cast<T>(high + 1);
    io.limited(value, low, high);
  }
}

// Converts a bool: one byte, 0 or 1.
template <class Io, class X>
constexpr void flag(Io& io, X& x) noexcept {
  number_as<std::uint8_t>(io, x, 0, 1);
}

// Converts an enumerator between 0 and `last`.
template <class Io, class X>
constexpr void choice(Io& io, X& x, std::remove_const_t<X> last) noexcept {
  number_as<std::uint8_t>(io, x, 0, static_cast<std::uint8_t>(last));
}

// Converts a number or an index as a byte up to `most`; most < 255.
template <class Io, class X>
constexpr void count(Io& io, X& x, std::size_t most) noexcept {
  number_as<std::uint8_t>(io, x, 0, static_cast<std::uint8_t>(most));
}

// Calls `use` for the first `n` items, at most for all of them, even if the number was refused.
template <class Items, class Use>
constexpr void first_of(Items& items, std::size_t n, Use use) noexcept {
  for (std::size_t i = 0; i < n && i < items.size(); ++i) use(items[i]);
}

// Converts letters of ASCII; after the last one are zeros.
template <class Io, class X>
constexpr void letters(Io& io, X& x) noexcept {
  for (auto& c : x) number_as<std::uint8_t>(io, c, 0, 126);
}

// Matches M = X and M = const X, so that one list of fields serves both directions.
template <class M, class X>
concept Is = std::same_as<std::remove_const_t<M>, X>;

// Counts the members of an aggregate, so that a list of its fields detects an added one:
// static_assert(members<Gains>() == 3).

// Takes the place of a member: it converts to any type.
struct AnyMember {
  template <class T>
  operator T() const;  // never defined, used in a requires expression only
};

// Returns the number of members of an aggregate.
template <class T, class... Before>
consteval std::size_t members() {
  if constexpr (requires { T{Before{}..., AnyMember{}}; })
    return members<T, Before..., AnyMember>();
  else
    return sizeof...(Before);
}

}  // namespace sinew::link
