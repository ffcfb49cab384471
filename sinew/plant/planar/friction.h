// plant/planar/friction.h - dry friction with true stick, one force per contact and step.
//
// The slip velocities at the end of a step of length h are, to first order in the forces,
//
//   s = s0 + W f,   s0 = J (v + h a),   W = h J M^-1 J^T,   |f_i| <= bound_i
//
// and each contact either sticks (s_i = 0) or slides (f_i = -sign(s_i) bound_i). Three Gauss-Seidel
// sweeps guess which contacts stick; for those the equations are then solved exactly. The forces are
// held over the step, so without friction the integrator is pure RK4.
#pragma once

#include <array>

namespace sinew::plant {

template <int C>
struct FrictionProblem {
  std::array<double, C> slip{};                     // s0, without friction
  std::array<std::array<double, C>, C> response{};  // W, symmetric, slip per force
  std::array<double, C> bound{};                    // >= 0; a contact with bound 0 carries nothing
};

namespace detail {

// Cholesky on the contacts in `stick`; a hair of damping where more stick than can move.
template <int C>
void solve_sticking(const FrictionProblem<C>& p, const std::array<bool, C>& stick,
                    std::array<double, C>& force) {
  std::array<int, C> index{};
  int n = 0;
  double largest = 0;
  for (int i = 0; i < C; ++i)
    if (stick[i]) {
      index[n++] = i;
      largest = p.response[i][i] > largest ? p.response[i][i] : largest;
    }

  std::array<std::array<double, C>, C> lower{};
  std::array<double, C> pivot{}, rhs{};
  for (int a = 0; a < n; ++a) {
    const int i = index[a];
    rhs[a] = -p.slip[i];
    for (int j = 0; j < C; ++j) rhs[a] -= p.response[i][j] * force[j];
    for (int b = 0; b <= a; ++b) {
      double m = p.response[i][index[b]] + (a == b ? 1e-9 * largest : 0.0);
      for (int k = 0; k < b; ++k) m -= lower[a][k] * lower[b][k] * pivot[k];
      if (a == b)
        pivot[a] = m > 1e-10 * largest ? m : 1e-10 * largest;
      else
        lower[a][b] = m / pivot[b];
    }
    for (int k = 0; k < a; ++k) rhs[a] -= lower[a][k] * rhs[k];
  }
  for (int a = n - 1; a >= 0; --a) {
    rhs[a] /= pivot[a];
    for (int k = a + 1; k < n; ++k) rhs[a] -= lower[k][a] * rhs[k];
  }
  for (int a = 0; a < n; ++a) force[index[a]] += rhs[a];
}

}  // namespace detail

// Forces that stop or slow each contact. `guess` is where the sweeps start (the last step's forces).
template <int C>
std::array<double, C> solve_friction(const FrictionProblem<C>& p,
                                     const std::array<double, C>& guess) {
  constexpr int sweeps = 3;
  std::array<double, C> force{}, inverse{};
  for (int i = 0; i < C; ++i) {
    if (p.bound[i] <= 0) continue;
    inverse[i] = 1.0 / p.response[i][i];
    force[i] = guess[i] < -p.bound[i] ? -p.bound[i] : guess[i] > p.bound[i] ? p.bound[i] : guess[i];
  }

  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int i = 0; i < C; ++i) {
      if (p.bound[i] <= 0) continue;
      double s = p.slip[i];
      for (int j = 0; j < C; ++j) s += p.response[i][j] * force[j];
      const double f = force[i] - s * inverse[i];
      force[i] = f < -p.bound[i] ? -p.bound[i] : f > p.bound[i] ? p.bound[i] : f;
    }

  // The guess: inside its bound a contact sticks. Solve, and let go whatever then asks for too much.
  std::array<bool, C> stick{};
  bool any = false;
  for (int i = 0; i < C; ++i) {
    stick[i] = p.bound[i] > 0 && force[i] > -p.bound[i] && force[i] < p.bound[i];
    any = any || stick[i];
  }
  while (any) {
    detail::solve_sticking<C>(p, stick, force);
    any = false;
    for (int i = 0; i < C; ++i) {
      if (!stick[i] || (force[i] >= -p.bound[i] && force[i] <= p.bound[i])) continue;
      force[i] = force[i] > 0 ? p.bound[i] : -p.bound[i];
      stick[i] = false;
      any = true;
    }
    bool left = false;
    for (int i = 0; i < C; ++i) left = left || stick[i];
    any = any && left;
  }
  return force;
}

}  // namespace sinew::plant
