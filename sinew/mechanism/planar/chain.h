// mechanism/planar/chain.h - a chain of N rigid links in the plane, hung from a trolley (or a fixed
// base).
//
// With absolute link angles phi the equations of motion are short for any N (Lagrange):
//
//   E_k = 1/2 M x_t'^2 - x_t' sum_i S_i sin(phi_i) phi_i'
//         + 1/2 sum_ij I_ij cos(phi_i - phi_j) phi_i' phi_j'
//   E_p = g sum_i S_i sin(phi_i)
//
//   M x_t'' - sum_i S_i sin(phi_i) phi_i''                   = F_x + sum_i S_i cos(phi_i) phi_i'^2
//   -S_i sin(phi_i) x_t'' + sum_j I_ij cos(phi_i-phi_j) phi_j'' = tau_i - g S_i cos(phi_i)
//                                                            - sum_j I_ij sin(phi_i-phi_j) phi_j'^2
//
//   S_i  = m_i l_ci + l_i (masses beyond link i)       first moment about joint i [kg m]
//   I_ii = I_i + m_i l_ci^2 + l_i^2 (masses beyond i),  I_ij = l_i S_j for i < j    [kg m^2]
//   M    mass that moves along the track [kg];  x_t  trolley [m];  F_x, tau_i  generalised forces
//        [N], [N m]
//
// Solved by eliminating the trolley and LDL^T of the N x N rest; for N = 2 by Cramer's rule, which
// has one division in its dependency chain instead of two. Without trolley 1/M = 0.
//
// S is a double, or a pack (units/pack.h) over several chains of equal N.
#pragma once

#include <array>

#include "sinew/units/math.h"

namespace sinew::plant {

template <int N, class S = double>
struct ChainConstants {
  std::array<S, N> length{}, first_moment{};  // l [m], c [kg m]
  std::array<std::array<S, N>, N> inertia{};  // A [kg m^2]
  S total_mass = 0;                           // M [kg]
  S inverse_total_mass = 0;                   // 0 for a fixed base [1/kg]
  S gravity = 9.80665;                        // [m/s^2]
};

// The generalized state of a chain: coordinates and their rates.
template <int N, class S = double>
struct GeneralizedState {
  S x = 0, x_rate = 0;               // trolley [m], [m/s]
  std::array<S, N> angle{}, rate{};  // angles of the links, from +x [rad], [rad/s]
};

// A force on each coordinate, or an acceleration of each.
template <int N, class S = double>
struct GeneralizedVector {
  S x = 0;
  std::array<S, N> angle{};
};

// Returns `a` where the mask is set, else `b`.
template <class Mask, int N, class S>
GeneralizedVector<N, S> select(const Mask& mask, const GeneralizedVector<N, S>& a,
                               const GeneralizedVector<N, S>& b) {
  GeneralizedVector<N, S> out{.x = units::select(mask, a.x, b.x)};
  for (int i = 0; i < N; ++i) out.angle[i] = units::select(mask, a.angle[i], b.angle[i]);
  return out;
}

// Terms of the equations that depend on the motion, evaluated once and used for several right
// sides.
template <int N, class S = double>
class Chain {
 public:
  // Computes sines, cosines and the mass matrix at this motion. Both arguments must outlive the
  // object.
  Chain(const ChainConstants<N, S>& constants, const GeneralizedState<N, S>& motion)
      : k_(constants), motion_(motion) {
    for (int i = 0; i < N; ++i) {
      const auto sc = units::sin_cos(motion.angle[i]);
      sin_[i] = sc.sin;
      cos_[i] = sc.cos;
      lever_[i] = k_.first_moment[i] * sin_[i];
    }
    factor();
  }

  // Return the sine and the cosine of link i's angle.
  S sin(int i) const { return sin_[i]; }
  S cos(int i) const { return cos_[i]; }

  // Returns the accelerations under these forces, gravity and the velocity terms.
  GeneralizedVector<N, S> accelerations(const GeneralizedVector<N, S>& given) const {
    GeneralizedVector<N, S> force = given;
    for (int i = 0; i < N; ++i) {
      const S rate2 = motion_.rate[i] * motion_.rate[i];
      force.x += k_.first_moment[i] * cos_[i] * rate2;
      force.angle[i] -= k_.gravity * k_.first_moment[i] * cos_[i];
      for (int j = 0; j < N; ++j) {
        if (j == i) continue;
        const S sine = sin_[i] * cos_[j] - cos_[i] * sin_[j];
        force.angle[i] -= k_.inertia[i][j] * sine * (motion_.rate[j] * motion_.rate[j]);
      }
    }
    return response(force);
  }

  // Returns the accelerations by the forces alone: the inverse mass matrix times `force`.
  GeneralizedVector<N, S> response(const GeneralizedVector<N, S>& force) const {
    const S push = force.x * k_.inverse_total_mass;
    std::array<S, N> a;
    for (int i = 0; i < N; ++i) a[i] = force.angle[i] + lever_[i] * push;
    if constexpr (N == 2) {
      const S first = (pivot_[1] * a[0] - lower_[1][0] * a[1]) * inverse_pivot_[0];
      a[1] = (pivot_[0] * a[1] - lower_[1][0] * a[0]) * inverse_pivot_[0];
      a[0] = first;
    } else {
      substitute(a);
    }
    GeneralizedVector<N, S> out{.x = push, .angle = a};
    for (int i = 0; i < N; ++i) out.x += k_.inverse_total_mass * lever_[i] * a[i];
    return out;
  }

 private:
  void substitute(std::array<S, N>& a) const {
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < i; ++j) a[i] -= lower_[i][j] * a[j];
    for (int i = N - 1; i >= 0; --i) {
      a[i] *= inverse_pivot_[i];
      for (int j = i + 1; j < N; ++j) a[i] -= lower_[j][i] * a[j];
    }
  }

  S reduced(int i, int j) const {
    const S cosine = i == j ? S(1.0) : cos_[i] * cos_[j] + sin_[i] * sin_[j];
    return k_.inertia[i][j] * cosine - lever_[i] * lever_[j] * k_.inverse_total_mass;
  }

  // Factors I_ij cos(phi_i - phi_j) - S_i sin(phi_i) S_j sin(phi_j)/M by LDL^T. For N = 2 stores
  // the matrix itself and 1/det.
  void factor() {
    if constexpr (N == 2) {
      pivot_ = {reduced(0, 0), reduced(1, 1)};
      lower_[1][0] = reduced(1, 0);
      inverse_pivot_[0] = 1.0 / (pivot_[0] * pivot_[1] - lower_[1][0] * lower_[1][0]);
      return;
    }
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j <= i; ++j) {
        S a = reduced(i, j);
        for (int k = 0; k < j; ++k) a -= lower_[i][k] * lower_[j][k] * pivot_[k];
        if (i == j) {
          pivot_[i] = a;
          inverse_pivot_[i] = 1.0 / a;
        } else {
          lower_[i][j] = a * inverse_pivot_[j];
        }
      }
    }
  }

  const ChainConstants<N, S>& k_;
  const GeneralizedState<N, S>& motion_;
  std::array<S, N> sin_, cos_, lever_;
  std::array<S, N> pivot_, inverse_pivot_;
  std::array<std::array<S, N>, N> lower_;
};

// Returns kinetic plus potential energy [J], with zero potential at the height of the first joint.
template <int N, class S>
S energy(const ChainConstants<N, S>& k, const GeneralizedState<N, S>& motion) {
  S e = 0.5 * k.total_mass * motion.x_rate * motion.x_rate;
  for (int i = 0; i < N; ++i) {
    const auto a = units::sin_cos(motion.angle[i]);
    e += k.gravity * k.first_moment[i] * a.sin;
    e -= motion.x_rate * k.first_moment[i] * a.sin * motion.rate[i];
    for (int j = 0; j < N; ++j) {
      const auto b = units::sin_cos(motion.angle[j]);
      const S cosine = a.cos * b.cos + a.sin * b.sin;
      e += 0.5 * k.inertia[i][j] * cosine * motion.rate[i] * motion.rate[j];
    }
  }
  return e;
}

// Returns the momentum along the track [N s].
template <int N, class S>
S momentum(const ChainConstants<N, S>& k, const GeneralizedState<N, S>& motion) {
  S p = k.total_mass * motion.x_rate;
  for (int i = 0; i < N; ++i)
    p -= k.first_moment[i] * units::sin_cos(motion.angle[i]).sin * motion.rate[i];
  return p;
}

}  // namespace sinew::plant
