// air/stiff/quick.h - integration of one body of air, or two in series, that are quicker than a
// step of the machine, through that step. It takes steps of RODAS3 with error control.
// quick_bodies.h has the laws, regulator_lanes.h the calm step of muscles behind regulators in
// lanes.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "sinew/gas/slopes.h"
#include "sinew/units/math.h"

namespace sinew::air {

// Linearly implicit step for few bodies of air that are quicker than the machine's steps.
//
// RODAS3 of Sandu, Verwer, Blom, Spee, Carmichael and Potra (Atmospheric Environment 31, 1997):
// four stages, three evaluations, order 3, stiffly accurate and L-stable, with an embedded
// solution of order 2. A body that settles within microseconds needs small steps only for accuracy,
// not for stability.
//
// Masses x of N bodies, and masses passed through three openings q (in, out, leaked):
//
//   x' = r(t, x)     q' = p(t, x)
//
// Rosenbrock methods keep linear invariants: a step conserves to rounding what r and p conserve at
// every instant (in - out - leaked = sum of the masses' gains).

// Rates at one instant, and their slopes. A body without a leak has two openings.
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
  std::array<double, N> mass{};       // at the end of the step [kg]
  std::array<double, 3> passed{};     // within the step [kg]
  std::array<double, N> error{};      // estimated, of a mass [kg]
  std::array<double, N> curvature{};  // h/8 times the change of a mass's rate over the step [kg]
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

// Takes one step of length h from the masses x at time t. rates(t, x, slopes) returns
// QuickRates<N>, with slopes only if `slopes` is true.
template <int N, class Rates>
QuickStep<N> rodas3_step(const Rates& rates, double t, const std::array<double, N>& x, double h) {
  using At = std::decay_t<decltype(rates(t, x, true))>;
  constexpr std::size_t n = N, m = At::openings;
  const double inverse = 1.0 / h, half = 0.5 * h;
  const At first = rates(t, x, true);
  const rodas3::Solver<N> solver(inverse, first.mass_by);

  // Computes K of stage s: c1, c2, c3 weight the earlier stages, g the slope over time.
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
    out.curvature[i] = 0.125 * h * (first.mass[i] - last.mass[i]);
  }
  for (std::size_t i = 0; i < m; ++i) out.passed[i] = 2.0 * q[0][i] + q[2][i] + q[3][i];
  return out;
}

namespace quick {

inline constexpr double muscle_error = 1e-4;    // relative error of a muscle's mass within one step
inline constexpr double hose_error = 5e-4;      // relative error of a hose's mass
inline constexpr double equal_density = 3e-3;   // relative difference of equal densities
inline constexpr double calm_curvature = 1e-3;  // relative curvature of a mass within a calm step
inline constexpr double shortest = 1e-7;        // step that is accepted whatever its error [s]

// Integrates x from t to `until` with error control. `step_size` is the step length, kept between
// calls.
template <int N, class Rates>
void integrate(const Rates& rates, double t, double until, const std::array<double, N>& error,
               std::array<double, N>& x, std::array<double, 3>& passed, double& step_size) {
  while (t < until) {
    const double left = until - t;
    const bool last = !(step_size < left);
    const double h = last ? left : step_size;
    const QuickStep<N> step = rodas3_step<N>(rates, t, x, h);
    double worst = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const double one = step.error[i] / (x[i] * error[i]);
      worst = one > worst || !(one >= 0) ? one : worst;
    }
    if (!(worst <= 1.0) && h > shortest) {
      step_size = 0.25 * h;
      continue;
    }
    x = step.mass;
    for (std::size_t k = 0; k < 3; ++k) passed[k] += step.passed[k];
    t = last ? until : t + h;
    if (worst < 0.03) step_size = 3.0 * h;
  }
}

// Masses at the half and at the end of a step, and the masses passed within it.
template <int N>
struct StepResult {
  std::array<double, N> half{}, full{};
  std::array<double, 3> passed{};
};

// Writes the result into the cell; its muscle or chamber is the last body.
template <int N, class Cell>
void write_result(const StepResult<N>& ahead, Cell& cell) {
  cell.half = ahead.half.back();
  cell.full = ahead.full.back();
  if constexpr (N > 1) cell.hose = ahead.full.front();
  cell.in = ahead.passed[0];
  cell.out = ahead.passed[1];
  cell.leak = ahead.passed[2];
}

// Integrates through a step. If the step is calm, one step of the rule suffices, and the half is on
// the cubic through both ends and their rates. For a decay of rate r that half is wrong by 2 % of
// the curvature at r h = 1, by a tenth at 2.5 and by a third at 5.
template <int N, class Rates>
StepResult<N> integrate_step(const Rates& rates, double t, double h,
                             const std::array<double, N>& error,
                             const std::array<double, N>& start) {
  StepResult<N> out;
  const QuickStep<N> whole = rodas3_step<N>(rates, t, start, h);
  bool calm = true;
  for (std::size_t i = 0; i < N; ++i) {
    calm = calm && std::abs(whole.curvature[i]) < calm_curvature * start[i] &&
           whole.error[i] < error[i] * start[i];
    out.half[i] = 0.5 * (start[i] + whole.mass[i]) + whole.curvature[i];
  }
  if (calm) {
    out.full = whole.mass;
    out.passed = whole.passed;
    return out;
  }
  double step_size = 0.5 * h;
  out.full = start;
  integrate<N>(rates, t, t + 0.5 * h, error, out.full, out.passed, step_size);
  out.half = out.full;
  integrate<N>(rates, t + 0.5 * h, t + h, error, out.full, out.passed, step_size);
  return out;
}

// Returns e^-x; for a small part of a lag's time by five terms, with an error of 3e-9 at 0.1.
inline constexpr double short_lag = 0.1;
inline double decay(double x) {
  if (x > short_lag) return units::exp(-x);
  return 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
}

// Returns a valve's flow, with its slopes only if `sloped`.
inline gas::SlopedFlow flow(bool sloped, const gas::FlowConstants& c, double y_a, double y_b) {
  return sloped ? gas::sloped_flow_y(c, y_a, y_b) : gas::SlopedFlow{gas::flow_y(c, y_a, y_b)};
}

}  // namespace quick

}  // namespace sinew::air
