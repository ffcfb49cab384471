// units/pack.h - packs of W doubles with the arithmetic of one, and the functions that allow a law
// to be written once for a double and for a pack.
//
//   template <class S> S law(const S& x) {
//     return units::select(x > 1.0, units::sqrt(x), 0.5 * x);
//   }
//
// A lane of law(pack) has the bits of law(double): the operations are the same, each is rounded
// separately, and lanes do not affect each other. Where lanes take different branches, both are
// computed and one is selected; with `any` a law can skip what no lane needs.
//
//            one number   packed
//   S        double       Pack<W>
//   mask     bool         PackMask<W>     from comparisons; joined by & | ^, negated by !
//
// All functions are always inlined, also without optimisation: the calling convention of a wide
// vector depends on the instruction set that a function is compiled for.
//
// Packs are vectors of GCC and Clang: one lane is a number, for code that takes packs; two lanes
// are native to every x86-64, four to AVX2, eight to AVX-512. If a pack is wider than the
// registers, GCC splits comparisons lane by lane: correct and slow.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace sinew::units {

// Returns `a` where the mask is set, else `b`.
constexpr double select(bool mask, double a, double b) { return mask ? a : b; }

// Return whether the mask is set for any lane, and for all lanes. A double is a single lane.
constexpr bool any(bool mask) { return mask; }
constexpr bool all(bool mask) { return mask; }

// The functions of the same name, for a double as for a pack.
inline double abs(double x) { return std::fabs(x); }
inline double sqrt(double x) { return std::sqrt(x); }

// Returns whether bit k of the number's pattern is set; 0 is the last of the mantissa.
constexpr bool bit(double x, int k) { return (std::bit_cast<std::uint64_t>(x) >> k & 1u) != 0; }

namespace detail {

template <int W>
struct Vector;
template <>
struct Vector<1> {
  using Doubles = double __attribute__((vector_size(8)));
  using Bits = std::int64_t __attribute__((vector_size(8)));
};
template <>
struct Vector<2> {
  using Doubles = double __attribute__((vector_size(16)));
  using Bits = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct Vector<4> {
  using Doubles = double __attribute__((vector_size(32)));
  using Bits = std::int64_t __attribute__((vector_size(32)));
};
template <>
struct Vector<8> {
  using Doubles = double __attribute__((vector_size(64)));
  using Bits = std::int64_t __attribute__((vector_size(64)));
};

}  // namespace detail

template <int W>
struct PackMask {
  using Bits = typename detail::Vector<W>::Bits;

  Bits bits;  // all or none are set in a lane

  [[gnu::always_inline]] bool operator[](int lane) const { return bits[lane] != 0; }
  // Sets one lane.
  [[gnu::always_inline]] void set(int lane, bool to) { bits[lane] = to ? -1 : 0; }

  [[gnu::always_inline]] friend PackMask operator&(const PackMask& a, const PackMask& b) {
    return {a.bits & b.bits};
  }
  [[gnu::always_inline]] friend PackMask operator|(const PackMask& a, const PackMask& b) {
    return {a.bits | b.bits};
  }
  [[gnu::always_inline]] friend PackMask operator^(const PackMask& a, const PackMask& b) {
    return {a.bits ^ b.bits};
  }
  [[gnu::always_inline]] friend PackMask operator!(const PackMask& a) { return {~a.bits}; }
};

template <int W>
struct Pack {
  using Lanes = typename detail::Vector<W>::Doubles;
  using Mask = PackMask<W>;

  static constexpr int width = W;

  Lanes lanes;

  // Uninitialised by default, as a double; `Pack x{}` is zero.
  Pack() = default;
  // Sets every lane to x. Subtracting zero keeps the sign of a zero, which adding would lose.
  [[gnu::always_inline]] Pack(double x) : lanes(x - Lanes{}) {}
  [[gnu::always_inline]] explicit Pack(const Lanes& of) : lanes(of) {}

  [[gnu::always_inline]] double operator[](int lane) const { return lanes[lane]; }
  // Sets one lane.
  [[gnu::always_inline]] void set(int lane, double to) { lanes[lane] = to; }

  [[gnu::always_inline]] Pack& operator+=(const Pack& b) { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) { return *this = *this * b; }
  [[gnu::always_inline]] Pack& operator/=(const Pack& b) { return *this = *this / b; }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
    return Pack(a.lanes + b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
    return Pack(a.lanes - b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
    return Pack(a.lanes * b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    return Pack(a.lanes / b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }

  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) {
    return {a.lanes < b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) {
    return {a.lanes > b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator<=(const Pack& a, const Pack& b) {
    return {a.lanes <= b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator>=(const Pack& a, const Pack& b) {
    return {a.lanes >= b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator==(const Pack& a, const Pack& b) {
    return {a.lanes == b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator!=(const Pack& a, const Pack& b) {
    return {a.lanes != b.lanes};
  }
};

// a and b may be doubles, for all lanes.
template <int W>
[[gnu::always_inline]] inline Pack<W> select(const PackMask<W>& mask,
                                             const std::type_identity_t<Pack<W>>& a,
                                             const std::type_identity_t<Pack<W>>& b) {
  return Pack<W>(mask.bits ? a.lanes : b.lanes);
}

// Returns whether bit k of each lane's pattern is set.
template <int W>
[[gnu::always_inline]] inline PackMask<W> bit(const Pack<W>& x, int k) {
  const auto bits = reinterpret_cast<typename PackMask<W>::Bits>(x.lanes);
  return {-(bits >> k & 1)};
}

// Returns whether the mask is set for any lane.
template <int W>
[[gnu::always_inline]] inline bool any(const PackMask<W>& mask) {
// One instruction, which GCC does not generate by itself.
#if defined(__AVX2__)
  if constexpr (W == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.bits)) != 0;
#endif
#if defined(__AVX512DQ__)
  if constexpr (W == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask.bits)) != 0;
#endif
  std::int64_t some = 0;
  for (int k = 0; k < W; ++k) some |= mask.bits[k];
  return some != 0;
}

// Returns whether the mask is set for all lanes.
template <int W>
[[gnu::always_inline]] inline bool all(const PackMask<W>& mask) {
  return !any(!mask);
}

// Returns the magnitude of each lane.
template <int W>
[[gnu::always_inline]] inline Pack<W> abs(const Pack<W>& x) {
  using Bits = typename PackMask<W>::Bits;
  constexpr std::int64_t all_but_sign = ~(std::int64_t{1} << 63);
  const Bits size = reinterpret_cast<Bits>(x.lanes) & all_but_sign;
  return Pack<W>(reinterpret_cast<typename Pack<W>::Lanes>(size));
}

// Returns the square root of each lane, rounded as that of a double.
template <int W>
[[gnu::always_inline]] inline Pack<W> sqrt(const Pack<W>& x) {
  const auto each = [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
    return Pack<W>(typename Pack<W>::Lanes{std::sqrt(x.lanes[k])...});
  };
  return each(std::make_integer_sequence<int, W>{});
}

// Return the larger and the smaller value; `a` if neither is, as std::max and std::min.
template <class S>
[[gnu::always_inline]] inline S max(const S& a, const std::type_identity_t<S>& b) {
  return units::select(a < b, b, a);
}
template <class S>
[[gnu::always_inline]] inline S min(const S& a, const std::type_identity_t<S>& b) {
  return units::select(b < a, b, a);
}

// Returns a struct of packs from W structs of doubles: the same members in the same order, and
// nothing else.
template <class Packed, class One, std::size_t W>
Packed side_by_side(const std::array<One, W>& each) {
  static_assert(sizeof(Packed) == W * sizeof(One) && std::is_trivially_copyable_v<Packed>);
  constexpr std::size_t count = sizeof(One) / sizeof(double);
  std::array<std::array<double, W>, count> rows;
  for (std::size_t k = 0; k < W; ++k) {
    const auto one = std::bit_cast<std::array<double, count>>(each[k]);
    for (std::size_t i = 0; i < count; ++i) rows[i][k] = one[i];
  }
  return std::bit_cast<Packed>(rows);
}

// Returns the struct of doubles in one lane of a struct of packs.
template <class One, class Packed>
One lane_of(const Packed& packed, int lane) {
  static_assert(sizeof(Packed) % sizeof(One) == 0 && std::is_trivially_copyable_v<One>);
  constexpr std::size_t width = sizeof(Packed) / sizeof(One), count = sizeof(One) / sizeof(double);
  // Copied number by number: a copy of all lanes would be slower.
  const auto* from = reinterpret_cast<const std::byte*>(&packed) + sizeof(double) * lane;
  std::array<double, count> one;
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&one[i], from + i * width * sizeof(double), sizeof(double));
  return std::bit_cast<One>(one);
}

// Writes a struct of doubles to one lane of a struct of packs.
template <class One, class Packed>
void put_lane(const One& one, int lane, Packed& packed) {
  static_assert(sizeof(Packed) % sizeof(One) == 0 && std::is_trivially_copyable_v<Packed>);
  constexpr std::size_t width = sizeof(Packed) / sizeof(One), count = sizeof(One) / sizeof(double);
  const auto numbers = std::bit_cast<std::array<double, count>>(one);
  auto* to = reinterpret_cast<std::byte*>(&packed) + sizeof(double) * lane;
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(to + i * width * sizeof(double), &numbers[i], sizeof(double));
}

}  // namespace sinew::units
