// air/stiff/rodas3.h - a linearly implicit step for few bodies of air that are quicker than the
// steps of the machine that they belong to.
//
// RODAS3 of Sandu, Verwer, Blom, Spee, Carmichael and Potra (Atmospheric Environment 31, 1997):
// four stages, three evaluations, order 3, stiffly accurate and L-stable, with an embedded answer
// of order 2. A body that settles within microseconds needs no small step for stability, only for
// accuracy.
//
// Masses x of N bodies, and what has passed three openings q (in, out, leaked):
//
//   x' = r(t, x)     q' = p(t, x)
//
// Rosenbrock methods keep linear invariants: what r and p conserve at every instant (in - out -
// leaked = sum of the masses' gains), a step conserves to rounding.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

namespace sinew::air {

// Rates at one instant, and their slopes. A body that does not leak has two openings.
template <int N, int Openings = 3>
struct QuickRates {
  static constexpr int openings = Openings;

  std::array<double, N> mass{};                             // r [kg/s]
  std::array<double, openings> passed{};                    // p [kg/s]
  std::array<std::array<double, N>, N> mass_by{};           // dr_i/dx_j [1/s]
  std::array<std::array<double, N>, openings> passed_by{};  // dp_k/dx_j [1/s]
  std::array<double, N> mass_by_time{};                     // dr/dt [kg/s^2]
  std::array<double, openings> passed_by_time{};            // dp/dt [kg/s^2]
};

template <int N>
struct QuickStep {
  std::array<double, N> mass{};    // at the end of the step [kg]
  std::array<double, 3> passed{};  // within the step [kg]
  std::array<double, N> error{};   // estimated, of a mass [kg]
  std::array<double, N> bend{};    // h/8 of the rates' difference from end to end, of a mass [kg]
};

namespace rodas3 {

// Solves (I/(h gamma) - J) x = b for one or two bodies.
template <int N>
class Solver {
 public:
  // Inverts 1/(h gamma) less the slopes, once for all stages of a step.
  Solver(double inverse_step, const std::array<std::array<double, N>, N>& slopes) {
    const double shift = 2.0 * inverse_step;  // 1/(h gamma), gamma = 1/2
    if constexpr (N == 1) {
      inverse_[0][0] = 1.0 / (shift - slopes[0][0]);
    } else {
      const double a = shift - slopes[0][0], b = -slopes[0][1], c = -slopes[1][0],
                   d = shift - slopes[1][1];
      const double one = 1.0 / (a * d - b * c);
      inverse_ = {{{d * one, -b * one}, {-c * one, a * one}}};
    }
  }

  // Returns the x for a right side b.
  std::array<double, N> solve(const std::array<double, N>& b) const {
    std::array<double, N> x{};
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) x[i] += inverse_[i][j] * b[j];
    return x;
  }

 private:
  std::array<std::array<double, N>, N> inverse_{};
};

}  // namespace rodas3

// One step of length h from the masses x at time t. rates(t, x, slopes) answers QuickRates<N>, the
// slopes only where it is asked for them.
template <int N, class Rates>
QuickStep<N> rodas3_step(const Rates& rates, double t, const std::array<double, N>& x, double h) {
  using At = std::decay_t<decltype(rates(t, x, true))>;
  constexpr std::size_t n = N, m = At::openings;
  const double inverse = 1.0 / h, half = 0.5 * h;
  const At first = rates(t, x, true);
  const rodas3::Solver<N> solver(inverse, first.mass_by);

  // K of stage s: c1, c2, c3 weigh the earlier stages, g the slope over time.
  std::array<std::array<double, N>, 4> k{};
  std::array<std::array<double, m>, 4> q{};
  const auto stage = [&](std::size_t s, const At& at, std::array<double, 3> c, double g) {
    std::array<double, N> b{};
    for (std::size_t i = 0; i < n; ++i) {
      b[i] = at.mass[i] + g * h * first.mass_by_time[i];
      for (std::size_t e = 0; e < s; ++e) b[i] += c[e] * inverse * k[e][i];
    }
    k[s] = solver.solve(b);
    for (std::size_t i = 0; i < m; ++i) {
      double sum = at.passed[i] + g * h * first.passed_by_time[i];
      for (std::size_t e = 0; e < s; ++e) sum += c[e] * inverse * q[e][i];
      for (std::size_t j = 0; j < n; ++j) sum += first.passed_by[i][j] * k[s][j];
      q[s][i] = half * sum;
    }
  };
  stage(0, first, {}, 0.5);
  stage(1, first, {4.0, 0, 0}, 1.5);
  std::array<double, N> there{};
  for (std::size_t i = 0; i < n; ++i) there[i] = x[i] + 2.0 * k[0][i];
  stage(2, rates(t + h, there, false), {1.0, -1.0, 0}, 0.0);
  for (std::size_t i = 0; i < n; ++i) there[i] += k[2][i];
  const At last = rates(t + h, there, false);
  stage(3, last, {1.0, -1.0, -8.0 / 3.0}, 0.0);

  QuickStep<N> out;
  for (std::size_t i = 0; i < n; ++i) {
    out.mass[i] = there[i] + k[3][i];
    out.error[i] = std::abs(k[3][i]);
    out.bend[i] = 0.125 * h * (first.mass[i] - last.mass[i]);
  }
  for (std::size_t i = 0; i < m; ++i) out.passed[i] = 2.0 * q[0][i] + q[2][i] + q[3][i];
  return out;
}

}  // namespace sinew::air
