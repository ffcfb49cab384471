// gas/power_series.h - powers of numbers near one without exp and log:
//
//   (1 + x)^e = 1 + e x + e (e - 1)/2 x^2 + ...   six terms
//
// The relative error is 2e-11 for |x| <= 0.05 and 0 <= e <= 1. The code uses only + - x: a number
// and a vector of numbers have the same bits.
//
// To follow a quantity q, a caller expands about a base, x = q/base - 1, and takes a new base when
// q has drifted. `Base` holds the base and the root there: y = y_base (1 + x)^e.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "sinew/units/math.h"

namespace sinew::gas {

// S is a double, or a pack of doubles (units/pack.h) over several machines.
template <class S>
class PowerSeriesOf {
 public:
  static constexpr double reach = 0.05;   // largest |x| for which six terms suffice
  static constexpr double rebase = 0.02;  // |x| from which a new base is taken

  constexpr PowerSeriesOf() = default;
  // Computes the terms of the exponent.
  constexpr explicit PowerSeriesOf(const S& exponent) : exponent_(exponent) {
    term_[0] = 1.0;
    for (int k = 1; k < 7; ++k) term_[k] = term_[k - 1] * (exponent - (k - 1)) / k;
  }

  // Returns the exponent.
  constexpr S exponent() const { return exponent_; }

  // Writes (1 + x)^e to `power`, for a number or a vector. The terms are summed in pairs, which has
  // shorter dependency chains than Horner's scheme.
  template <class T>
  constexpr void raise(const T& x, T& power) const {
    const auto& c = term_;
    const T x2 = x * x, low = 1.0 + c[1] * x, middle = c[2] + c[3] * x;
    const T high = (c[4] + c[5] * x) + c[6] * x2;
    power = (low + x2 * middle) + (x2 * x2) * high;
  }

 private:
  S exponent_ = 1;
  std::array<S, 7> term_{};
};
using PowerSeries = PowerSeriesOf<double>;

// Base of the series: y there, and the inverse of the quantity there. A default-constructed one is
// no valid base: the first evaluation then uses the power.
struct Base {
  double y = 1, inverse = 0;
};

// Returns y of a quantity that is `at_one` where y is one, by the series or, outside its range, by
// the power [-].
inline double root(const PowerSeries& series, const Base& base, double quantity, double at_one) {
  const double x = quantity * base.inverse - 1.0;
  if (x < PowerSeries::reach && x > -PowerSeries::reach) {
    double power = 1;
    series.raise(x, power);
    return base.y * power;
  }
  return units::power(quantity / at_one, series.exponent());
}

// Takes a new base if the quantity has drifted from the old one.
inline void update_base(const PowerSeries& series, Base& base, double quantity, double at_one) {
  const double x = quantity * base.inverse - 1.0;
  if (x < PowerSeries::rebase && x > -PowerSeries::rebase) return;
  base = {units::power(quantity / at_one, series.exponent()), 1.0 / quantity};
}

// Powers of any positive number without exp and log, from a table:
//
//   q = 2^k c_i (1 + x),   q^e = 2^(k e) c_i^e (1 + x)^e,   |x| <= 1/128
//
// The octave k and c_i, the middle of one of its 64 parts, come from the bits of q; the last factor
// is the series. The relative error is 1.2e-15 for 0 <= e <= 1 (units::power: 1e-15), at a fifth of
// the time. Outside 2^-8 ... 2^8 units::power is used.
//
// The table is for steps in which the quantity leaves the range of a series; it costs 80 powers
// once.
class PowerTable {
 public:
  // Fills the table for this exponent.
  explicit PowerTable(double exponent) : series_(exponent) {
    for (std::size_t i = 0; i < parts; ++i) {
      const double middle = 1.0 + (static_cast<double>(i) + 0.5) / parts;
      part_[i] = {middle, 1.0 / middle, units::power(middle, exponent)};
    }
    double octave = 1.0 / (1 << lowest);
    for (double& power : octave_) {
      power = units::power(octave, exponent);
      octave *= 2.0;
    }
  }

  // Returns q^e; `q` is positive.
  double operator()(double q) const noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(q);
    const std::uint64_t octave = (bits >> 52) - (1023 - lowest);
    if (!(octave < octaves)) return units::power(q, series_.exponent());
    const Part& part = part_[bits >> (52 - part_bits) & (parts - 1)];
    const double one_to_two = std::bit_cast<double>((bits & mantissa) | one);
    const double x = (one_to_two - part.middle) * part.inverse;
    double power = 1;
    series_.raise(x, power);
    return (octave_[octave] * part.power) * power;
  }

 private:
  static constexpr int part_bits = 6, lowest = 8;
  static constexpr std::size_t parts = std::size_t{1} << part_bits, octaves = 2 * lowest;
  static constexpr std::uint64_t mantissa = 0x000fffffffffffffull, one = 0x3ff0000000000000ull;

  struct Part {
    double middle = 1, inverse = 1, power = 1;
  };

  PowerSeries series_;
  std::array<Part, parts> part_{};
  std::array<double, octaves> octave_{};
};

}  // namespace sinew::gas
