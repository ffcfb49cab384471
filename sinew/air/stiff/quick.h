// air/stiff/quick.h - integrates one body of air, or two in a row, that are quicker than a step of
// the machine, through that step. It takes steps of rodas3.h, whose length the error decides.
// quick_bodies.h has the laws, regulator_lanes.h the calm step of muscles behind regulators in
// lanes.
#pragma once

#include <array>
#include <cmath>

#include "sinew/air/stiff/rodas3.h"
#include "sinew/gas/slopes.h"
#include "sinew/units/math.h"

namespace sinew::air {

namespace quick {

inline constexpr double muscle_error = 1e-4;  // of a muscle's mass in one of its steps
inline constexpr double hose_error = 5e-4;    // of a hose's
inline constexpr double equal = 3e-3;         // relative difference of densities: asleep
inline constexpr double little = 1e-3;        // bend of a mass within a calm step
inline constexpr double shortest = 1e-7;      // step, whatever its error [s]

// Integrates x from t to `until`, which is not long. `pace` is the step that suited last.
template <int N, class Rates>
void go(const Rates& rates, double t, double until, const std::array<double, N>& error,
        std::array<double, N>& x, std::array<double, 3>& passed, double& pace) {
  while (t < until) {
    const double left = until - t;
    const bool last = !(pace < left);
    const double h = last ? left : pace;
    const QuickStep<N> step = rodas3_step<N>(rates, t, x, h);
    double worst = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const double one = step.error[i] / (x[i] * error[i]);
      worst = one > worst || !(one >= 0) ? one : worst;
    }
    if (!(worst <= 1.0) && h > shortest) {
      pace = 0.25 * h;
      continue;
    }
    x = step.mass;
    for (std::size_t k = 0; k < 3; ++k) passed[k] += step.passed[k];
    t = last ? until : t + h;
    if (worst < 0.03) pace = 3.0 * h;
  }
}

// Masses at the half and at the end of a step of length h, and what has passed in it.
template <int N>
struct Ahead {
  std::array<double, N> half{}, full{};
  std::array<double, 3> passed{};
};

// Writes the course's end into the cell; its muscle or chamber is the last body.
template <int N, class Cell>
void fill(const Ahead<N>& ahead, Cell& cell) {
  cell.half = ahead.half.back();
  cell.full = ahead.full.back();
  if constexpr (N > 1) cell.hose = ahead.full.front();
  cell.in = ahead.passed[0];
  cell.out = ahead.passed[1];
  cell.leak = ahead.passed[2];
}

// Integrates through a step. Where it is calm one step of the rule serves, and the half lies on the
// cubic through both ends and their rates. A decay of rate r is off there by 2 % of the bend at
// r h = 1, by a tenth at 2.5 and a third at 5.
template <int N, class Rates>
Ahead<N> through(const Rates& rates, double t, double h, const std::array<double, N>& error,
                 const std::array<double, N>& start) {
  Ahead<N> out;
  const QuickStep<N> whole = rodas3_step<N>(rates, t, start, h);
  bool calm = true;
  for (std::size_t i = 0; i < N; ++i) {
    calm =
        calm && std::abs(whole.bend[i]) < little * start[i] && whole.error[i] < error[i] * start[i];
    out.half[i] = 0.5 * (start[i] + whole.mass[i]) + whole.bend[i];
  }
  if (calm) {
    out.full = whole.mass;
    out.passed = whole.passed;
    return out;
  }
  double pace = 0.5 * h;
  out.full = start;
  go<N>(rates, t, t + 0.5 * h, error, out.full, out.passed, pace);
  out.half = out.full;
  go<N>(rates, t + 0.5 * h, t + h, error, out.full, out.passed, pace);
  return out;
}

// e^-x of a lag that has run for a small part of its time: five terms, 3e-9 at 0.1.
inline constexpr double short_lag = 0.1;
inline double decay(double x) {
  if (x > short_lag) return units::exp(-x);
  return 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
}

// A valve's flow, its slopes only where a step needs them.
inline gas::SlopedFlow flow(bool sloped, const gas::FlowConstants& c, double y_a, double y_b) {
  return sloped ? gas::sloped_flow_y(c, y_a, y_b) : gas::SlopedFlow{gas::flow_y(c, y_a, y_b)};
}

}  // namespace quick

}  // namespace sinew::air
