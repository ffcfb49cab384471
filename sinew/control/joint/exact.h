// control/joint/exact.h - sums and products of single-precision numbers without rounding.
//
// The thesis's program computes a law in the extended precision of the x87 and truncates the result
// towards zero: 0.12f x 25 = 2.99999993 gives 2. A single-precision product rounds that to 3.
// Truncation depends on the last bit, and controller boards have no 64-bit mantissa. So a law's
// output is a sum of two floats, the second being the rounding error of the first:
//
//   two_sum      Knuth 1969: the error of a + b is a float
//   two_product  Dekker 1971, Veltkamp's split: the error of a x b is a float
//
// Both are exact for the magnitudes here (gains below 1e3, counts below 2^24); the sum of two such
// results has a relative error of about 2^-46. Only + - x are used, so results are bit-identical
// everywhere if the compiler neither fuses nor reorders operations: -ffp-contract=off, never
// -ffast-math.
#pragma once

#include <cstdint>

namespace sinew::control {

struct Exact {
  float high = 0, low = 0;  // the value is high + low; high is the nearest float
};

// Returns the sum without rounding.
constexpr Exact two_sum(float a, float b) noexcept {
  const float sum = a + b;
  const float b_part = sum - a;
  const float a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// Splits x into high + low with 12 bits each.
constexpr Exact split(float x) noexcept {
  const float scaled = 4097.0f * x;  // 2^12 + 1
  const float high = scaled - (scaled - x);
  return {high, x - high};
}

// Returns the product without rounding, provided that no part underflows.
constexpr Exact two_product(float a, float b) noexcept {
  const float product = a * b;
  const Exact x = split(a), y = split(b);
  const float error =
      ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low;
  return {product, error};
}

constexpr Exact operator-(Exact x) noexcept { return {-x.high, -x.low}; }

constexpr Exact operator+(Exact x, Exact y) noexcept {
  const Exact high = two_sum(x.high, y.high);
  return two_sum(high.high, high.low + (x.low + y.low));
}

constexpr Exact operator-(Exact x, Exact y) noexcept { return x + -y; }

constexpr Exact operator*(float a, Exact x) noexcept {
  return two_product(a, x.high) + Exact{a * x.low, 0};
}

// Clamps x to [-limit, +limit]; NaN becomes 0.
constexpr float clamped(float x, float limit) noexcept {
  if (x > limit) return limit;
  if (x < -limit) return -limit;
  return x == x ? x : 0.0f;
}

// Clamps x to the two bounds.
constexpr std::int32_t clamped(std::int32_t x, std::int32_t low, std::int32_t high) noexcept {
  return x < low ? low : x > high ? high : x;
}

// Limit of a law's output, far beyond saturation; the sum of two still fits the thesis's `short`.
inline constexpr float law_limit = 16000.0f;  // [%]

// Truncates towards zero, as C converts a floating-point number.
constexpr std::int32_t truncated(Exact x) noexcept {
  if (!(x.high > -law_limit && x.high < law_limit)) {
    return static_cast<std::int32_t>(clamped(x.high, law_limit));
  }
  const std::int32_t whole = static_cast<std::int32_t>(x.high);
  const float rest = x.high - static_cast<float>(whole);
  if (whole > 0 && rest + x.low < 0) return whole - 1;
  if (whole < 0 && rest + x.low > 0) return whole + 1;
  return whole;
}

// Rounds to the nearest whole number, halves away from zero.
constexpr std::int32_t rounded(Exact x) noexcept {
  return truncated(x + Exact{x.high < 0 ? -0.5f : 0.5f, 0});
}

}  // namespace sinew::control
