// units/pack.h - W doubles side by side that are calculated with like one, and the functions of
// which a law is written so that it holds for a double and for a pack alike.
//
//   template <class S> S law(const S& x) {
//     return units::select(x > 1.0, units::sqrt(x), 0.5 * x);
//   }
//
// A lane of law(pack) has the bits of law(double): the operations are the same, each is rounded by
// itself, and nothing in one lane touches another. Where lanes differ in what they do, both are
// calculated and one is selected; `any` lets a law leave out what no lane needs.
//
//            one number   packed
//   S        double       Pack<W>
//   mask     bool         PackMask<W>     of comparisons; joined by & | ^, negated by !
//
// All functions are inlined, also where nothing is optimised: how a wide vector is handed over
// depends on what a function is compiled for.
//
// Packs are GCC's and Clang's vectors, as wide as the machine has them: two lanes are native to
// every x86-64, four to AVX2, eight to AVX-512. Where they are wider than its registers GCC takes
// comparisons apart lane by lane: correct and slow.
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

// Does it hold for any lane, for all of them? A double is its own only one.
constexpr bool any(bool mask) { return mask; }
constexpr bool all(bool mask) { return mask; }

// Each is the function of that name, of a double as of every lane of a pack.
inline double abs(double x) { return std::fabs(x); }
inline double sqrt(double x) { return std::sqrt(x); }

// Is bit k of the number's pattern set? 0 is the last of the mantissa.
constexpr bool bit(double x, int k) { return (std::bit_cast<std::uint64_t>(x) >> k & 1u) != 0; }

namespace detail {

template <int W>
struct Vector;
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

  Bits bits;  // of a lane all are set, or none

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

  // Not set when made, as a double is not; `Pack x{}` is zero.
  Pack() = default;
  // Every lane gets the number. Less nothing: plus nothing would lose the sign of a zero.
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

// Either may be a double, for all lanes.
template <int W>
[[gnu::always_inline]] inline Pack<W> select(const PackMask<W>& mask,
                                             const std::type_identity_t<Pack<W>>& a,
                                             const std::type_identity_t<Pack<W>>& b) {
  return Pack<W>(mask.bits ? a.lanes : b.lanes);
}

// Is bit k of each lane's pattern set?
template <int W>
[[gnu::always_inline]] inline PackMask<W> bit(const Pack<W>& x, int k) {
  const auto bits = reinterpret_cast<typename PackMask<W>::Bits>(x.lanes);
  return {-(bits >> k & 1)};
}

// Does it hold for any lane?
template <int W>
[[gnu::always_inline]] inline bool any(const PackMask<W>& mask) {
// One instruction, which GCC does not find.
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

// Does it hold for all lanes?
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

// The greater and the lesser; `a` if neither is, as std::max and std::min.
template <class S>
[[gnu::always_inline]] inline S max(const S& a, const std::type_identity_t<S>& b) {
  return units::select(a < b, b, a);
}
template <class S>
[[gnu::always_inline]] inline S min(const S& a, const std::type_identity_t<S>& b) {
  return units::select(b < a, b, a);
}

// Returns structs of doubles side by side, in a struct of as many packs: the same members in the
// same order, and nothing else.
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
  // Number by number: a copy of all lanes would cost more than what is asked for.
  const auto* from = reinterpret_cast<const std::byte*>(&packed) + sizeof(double) * lane;
  std::array<double, count> one;
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&one[i], from + i * width * sizeof(double), sizeof(double));
  return std::bit_cast<One>(one);
}

// Puts a struct of doubles into one lane of a struct of packs.
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
