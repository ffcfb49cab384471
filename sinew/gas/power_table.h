// gas/power_table.h - a power of any positive number without exp and log, from a table:
//
//   q = 2^k c_i (1 + x),   q^e = 2^(k e) c_i^e (1 + x)^e,   |x| <= 1/128
//
// with the octave k and the c_i in the middle of 64 parts of it by the bits of q, and the last
// factor by gas/power_series.h. 1.2e-15 relative for 0 <= e <= 1 (units::power has 1e-15), a fifth
// of its time. Beyond 2^-8 ... 2^8 units::power answers.
//
// It is for whoever takes steps in which the quantity leaves the reach of a series: a table costs
// 80 powers once.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "sinew/gas/power_series.h"
#include "sinew/units/math.h"

namespace sinew::gas {

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
