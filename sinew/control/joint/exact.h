// control/joint/exact.h - sums and products of single-precision numbers, without rounding.
//
// The thesis's program computes a law in the extended precision of its x87 and cuts the result off
// towards zero: 0.12f x 25 = 2.99999993 gives 2. A single-precision product rounds that to 3. Where
// a number is cut off the last bit counts, and no controller board has those 64 bits. So a law's
// output is a sum of two floats, the second being what rounding took from the first:
//
//   two_sum      Knuth 1969: the error of a + b is a float
//   two_product  Dekker 1971, Veltkamp's split: so is the error of a x b
//
// Both are exact for the magnitudes here (gains below 1e3, counts below 2^24); adding two such sums
// is good to about 2^-46 relative. Only + - x, so the same bits everywhere - as long as the
// compiler neither fuses nor reorders: -ffp-contract=off, never -ffast-math.
#pragma once

#include <cstdint>

namespace sinew::control {

struct Exact {
  float high = 0, low = 0;  // the value is high + low, high its nearest float
};

// Returns the sum without rounding.
constexpr Exact two_sum(float a, float b) noexcept {
  const float sum = a + b;
  const float b_part = sum - a;
  const float a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// x = high + low, 12 bits each.
constexpr Exact split(float x) noexcept {
  const float scaled = 4097.0f * x;  // 2^12 + 1
  const float high = scaled - (scaled - x);
  return {high, x - high};
}

// Returns the product without rounding, while nothing of it underflows.
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

// Into [-limit, +limit]; what is not a number becomes 0.
constexpr float clamped(float x, float limit) noexcept {
  if (x > limit) return limit;
  if (x < -limit) return -limit;
  return x == x ? x : 0.0f;
}

// Cuts x to the two bounds.
constexpr std::int32_t clamped(std::int32_t x, std::int32_t low, std::int32_t high) noexcept {
  return x < low ? low : x > high ? high : x;
}

// Beyond this a law is saturated many times over; the sum of two still fits the thesis's `short`.
inline constexpr float law_limit = 16000.0f;  // [%]

// Towards zero, as C converts a floating-point number.
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

// To the nearest whole number, halves away from zero.
constexpr std::int32_t rounded(Exact x) noexcept {
  return truncated(x + Exact{x.high < 0 ? -0.5f : 0.5f, 0});
}

}  // namespace sinew::control
