// analysis/align/fft.h - discrete Fourier transform of a power of two of values (Cooley and Tukey
// 1965), for correlations over all shifts at once.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace sinew::analysis {

// X_k = sum x_i exp(-2 pi j i k/n), in place; backwards with the opposite sign, divided by n.
inline void transform(std::vector<std::complex<double>>& x, bool backwards) {
  const std::size_t n = x.size();

  // Values go to where their place's bits, read backwards, point.
  for (std::size_t i = 1, k = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; k & bit; bit /= 2) k ^= bit;
    k ^= bit;
    if (i < k) std::swap(x[i], x[k]);
  }

  // Transforms of twice the length from two of half of it.
  const double turn = (backwards ? 2 : -2) * std::numbers::pi;
  for (std::size_t length = 2; length <= n; length *= 2)
    for (std::size_t k = 0; k < length / 2; ++k) {
      const auto w = std::polar(1.0, turn * static_cast<double>(k) / static_cast<double>(length));
      for (std::size_t at = k; at < n; at += length) {
        const std::complex<double> even = x[at], odd = w * x[at + length / 2];
        x[at] = even + odd;
        x[at + length / 2] = even - odd;
      }
    }
  if (backwards)
    for (auto& value : x) value /= static_cast<double>(n);
}

}  // namespace sinew::analysis
