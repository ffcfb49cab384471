// units/math.h - sine, cosine, logarithm, exponential and power, made only of + - x /.
//
// C libraries differ in the last bit of these functions. The physics uses the ones here, so that a
// run has the same bits on every computer and in every lane. Errors, tested against long double in
// math_test.cpp:
//
//   sin, cos   1.8e-16 absolute      |x| < 1e6, no reduction for more
//   log        3.5e-16 relative      positive, normal numbers
//   exp        2e-16 relative        |x| < 700
//   power      2e-16 + 4e-16 |log result| relative: 1e-15 for a gas, 1e-14 at 1e12
//
// sin and cos also accept packs (pack.h).
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

#include "sinew/units/pack.h"

namespace sinew::units {

// Sine and cosine of one angle.
template <class S>
struct SinCosOf {
  S sin, cos;
};
using SinCos = SinCosOf<double>;

// Computes sin and cos by reduction to |r| <= pi/4 (pi/2 in two parts) and their Taylor series: the
// first omitted terms are 5e-17 and 2e-18.
template <class S>
constexpr SinCosOf<S> sin_cos(const S& x) {
  constexpr double half_pi_high = 1.57079632673412561417e+00;  // 33 bits of pi/2
  constexpr double half_pi_low = 6.07710050650619224932e-11;   // pi/2 - half_pi_high

  // Nearest multiple of pi/2, from the rounding of a large addition.
  constexpr double round_magic = 6755399441055744.0;  // 1.5 * 2^52
  const S shifted = x * (2.0 / std::numbers::pi) + round_magic;
  const S quarter = shifted - round_magic;
  const S r = (x - quarter * half_pi_high) - quarter * half_pi_low;
  const S z = r * r;

  // Taylor series, with terms in pairs: shorter dependency chains than Horner's scheme.
  const S z2 = z * z, z4 = z2 * z2;
  const S s_low = -1.0 / 6 + z * (1.0 / 120);
  const S s_middle = -1.0 / 5040 + z * (1.0 / 362880);
  const S s_high = (-1.0 / 39916800 + z * (1.0 / 6227020800)) + z2 * (-1.0 / 1307674368000);
  const S s = r + (r * z) * ((s_low + z2 * s_middle) + z4 * s_high);

  const S c_low = 1.0 / 24 + z * (-1.0 / 720);
  const S c_middle = 1.0 / 40320 + z * (-1.0 / 3628800);
  const S c_high = (1.0 / 479001600 + z * (-1.0 / 87178291200)) + z2 * (1.0 / 20922789888000);
  const S c = (1.0 - 0.5 * z) + z2 * ((c_low + z2 * c_middle) + z4 * c_high);

  // sin(r + q pi/2), cos(r + q pi/2), selected by the last two bits of q.
  const auto odd = bit(shifted, 0), second = bit(shifted, 1);
  const S sine = select(odd, c, s), cosine = select(odd, s, c);
  return {select(second, -sine, sine), select(odd ^ second, -cosine, cosine)};
}

// Returns the natural logarithm of a positive, normal number: x = 2^k f,
// log f = 2 atanh((f - 1)/(f + 1)).
constexpr double log(double x) {
  constexpr double ln2_high = 6.93147180369123816490e-01;  // 32 bits of ln 2
  constexpr double ln2_low = 1.90821492927058770002e-10;

  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto k = static_cast<std::int64_t>(bits >> 52) - 1023;
  double f = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
  if (f > std::numbers::sqrt2) {
    f *= 0.5;
    k += 1;
  }
  const double s = (f - 1.0) / (f + 1.0);
  const double z = s * s;
  double series = 0;
  for (int i = 23; i >= 3; i -= 2) series = z * (1.0 / i + series);
  const double kd = static_cast<double>(k);
  return kd * ln2_high + (2.0 * s + (2.0 * s * series + kd * ln2_low));
}

// Returns e^x for |x| < 700: x = k ln 2 + r, series for |r| <= ln(2)/2.
constexpr double exp(double x) {
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double round_magic = 6755399441055744.0;

  const double kd = (x * std::numbers::log2e + round_magic) - round_magic;
  const double r = (x - kd * ln2_high) - kd * ln2_low;
  double series = 0;
  for (int i = 14; i >= 1; --i) series = (1.0 + series) * (r / i);
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(kd) + 1023) << 52;
  return (1.0 + series) * std::bit_cast<double>(exponent);
}

// Returns base^exponent for a positive base.
constexpr double power(double base, double exponent) { return exp(exponent * log(base)); }

}  // namespace sinew::units
