// gas/power_series.h - a power of a number near one, without exp and log:
//
//   (1 + x)^e = 1 + e x + e (e - 1)/2 x^2 + ...   six terms
//
// 2e-11 relative while |x| <= 0.05 and 0 <= e <= 1. Only + - x: a number and a vector of numbers
// have the same bits.
//
// Whoever follows a quantity q takes the series about a base, x = q/base - 1, and takes a new base
// where q has drifted: `Base` is that with the root at the base, y = y_base (1 + x)^e.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "sinew/units/math.h"

namespace sinew::gas {

// S is a double; or a pack of them (units/pack.h), of machines side by side.
template <class S>
class PowerSeriesOf {
 public:
  static constexpr double reach = 0.05;   // |x| up to which six terms are enough
  static constexpr double rebase = 0.02;  // |x| from which a new base is worth its power

  constexpr PowerSeriesOf() = default;
  // Works out the terms of the exponent.
  constexpr explicit PowerSeriesOf(const S& exponent) : exponent_(exponent) {
    term_[0] = 1.0;
    for (int k = 1; k < 7; ++k) term_[k] = term_[k - 1] * (exponent - (k - 1)) / k;
  }

  // Returns it.
  constexpr S exponent() const { return exponent_; }

  // Puts (1 + x)^e into `power`, of a number or a vector; the terms go in pairs, which wait less
  // for one another than Horner's.
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

// A base of the series: y there, and one over the quantity there. Made at rest it is no base yet:
// the first look goes by the power.
struct Base {
  double y = 1, inverse = 0;
};

// Returns y of a quantity that is `at_one` where y is one, by the series or, beyond its reach, by
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

// Takes a new base where the quantity has drifted from the old one.
inline void follow(const PowerSeries& series, Base& base, double quantity, double at_one) {
  const double x = quantity * base.inverse - 1.0;
  if (x < PowerSeries::rebase && x > -PowerSeries::rebase) return;
  base = {units::power(quantity / at_one, series.exponent()), 1.0 / quantity};
}

// A power of any positive number without exp and log, from a table:
//
//   q = 2^k c_i (1 + x),   q^e = 2^(k e) c_i^e (1 + x)^e,   |x| <= 1/128
//
// with the octave k and the c_i in the middle of 64 parts of it by the bits of q, and the last
// factor by gas/power_series.h. 1.2e-15 relative for 0 <= e <= 1 (units::power has 1e-15), a fifth
// of its time. Beyond 2^-8 ... 2^8 units::power answers.
//
// It is for whoever takes steps in which the quantity leaves the reach of a series: a table costs
// 80 powers once.
class PowerTable {
 public:
  // Fills the table for that exponent.
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
