// mechanism/friction/friction.h - dry friction with true stick, one force per contact and step.
//
// The slip velocities at the end of a step of length h are, to first order in the forces,
//
//   v_s = v_s0 + W f,   v_s0 = J_s (v + h a),   W = h J_s M^-1 J_s^T,   |f_i| <= f_b,i
//
// and each contact either sticks (v_s,i = 0) or slides (f_i = -sign(v_s,i) f_b,i). The
// contacts that stuck in the last step are tried first, which is nearly always right; contacts then
// change their sides until all are consistent.
//
// More contacts can stick than the machine has degrees of freedom (foot, trolley and both joints of
// a standing leg). Rigid bodies then do not determine their shares of the load. The forces
// change by the smallest amount from those of the last step, so the shares depend on history and
// not on the step.
//
// Machines side by side have the bits of the scalar solution in each lane. The sticking contacts
// differ between lanes. The matrix has every row that sticks in any lane; in the lanes where it
// does not stick, it is that of the unit matrix with a right side of zero:
//
//   L_ab = L_ba = 0, pivot = 1, x = 0
//
// This leaves the other values unchanged: only zeros are subtracted, in the same order. Lanes that
// are consistent wait for the others; a lane that needs many changes is solved on its own.
#pragma once

#include <array>

#include "sinew/units/pack.h"

namespace sinew::plant {

template <int C, class S = double>
struct FrictionProblem {
  std::array<S, C> slip;                     // v_s0, without friction
  std::array<std::array<S, C>, C> response;  // W, symmetric, slip per force
  std::array<S, C> bound;                    // >= 0; a contact with bound 0 carries no force
};

namespace detail {

enum class Side : unsigned char { idle, sticks, slides };

template <int C>
[[gnu::always_inline]] inline double slip_under(const FrictionProblem<C>& p, int count,
                                                const std::array<double, C>& force, int i) {
  double s = p.slip[i];
  for (int j = 0; j < count; ++j) s += p.response[i][j] * force[j];
  return s;
}

// Brings the sticking contacts' slips to zero by the smallest change of their forces: LDL^T with a
// small damping, 1e-9 of the largest response, for those that cannot move independently.
template <int C>
[[gnu::always_inline]] inline void solve_sticking(const FrictionProblem<C>& p, int count,
                                                  const std::array<Side, C>& side,
                                                  std::array<double, C>& force) {
  std::array<int, C> index;
  int n = 0;
  double largest = 0;
  for (int i = 0; i < count; ++i)
    if (side[i] == Side::sticks) {
      index[n++] = i;
      largest = p.response[i][i] > largest ? p.response[i][i] : largest;
    }

  std::array<std::array<double, C>, C> lower;
  std::array<double, C> pivot, inverse, x;
  const double damping = 1e-9 * largest;
  for (int a = 0; a < n; ++a) {
    const int i = index[a];
    x[a] = -slip_under<C>(p, count, force, i);
    for (int b = 0; b <= a; ++b) {
      double m = p.response[i][index[b]];
      for (int k = 0; k < b; ++k) m -= lower[a][k] * lower[b][k] * pivot[k];
      if (a == b) {
        pivot[a] = (m > 0 ? m : 0.0) + damping;
        inverse[a] = 1.0 / pivot[a];
      } else {
        lower[a][b] = m * inverse[b];
      }
    }
    for (int k = 0; k < a; ++k) x[a] -= lower[a][k] * x[k];
  }
  for (int a = n - 1; a >= 0; --a) {
    x[a] *= inverse[a];
    for (int k = a + 1; k < n; ++k) x[a] -= lower[k][a] * x[k];
    force[index[a]] += x[a];
  }
}

// Lets contacts slide that exceed their bound, and contacts stick whose force would push them along
// their slip: all of them, or only the first. Returns whether all contacts were consistent.
template <int C>
[[gnu::always_inline]] inline bool update_sides(const FrictionProblem<C>& p, int count,
                                                bool only_first, std::array<Side, C>& side,
                                                std::array<double, C>& force) {
  bool agreed = true;
  for (int i = 0; i < count && (agreed || !only_first); ++i) {
    if (side[i] == Side::sticks && (force[i] > p.bound[i] || force[i] < -p.bound[i])) {
      force[i] = force[i] > 0 ? p.bound[i] : -p.bound[i];
      side[i] = Side::slides;
      agreed = false;
    } else if (side[i] == Side::slides && slip_under<C>(p, count, force, i) * force[i] > 0) {
      side[i] = Side::sticks;
      agreed = false;
    }
  }
  return agreed;
}

template <int C>
[[gnu::always_inline]] inline std::array<Side, C> sides_of(const FrictionProblem<C>& p, int count,
                                                           std::array<double, C>& force) {
  std::array<Side, C> side{};  // idle beyond the last
  for (int i = 0; i < count; ++i) {
    const double b = p.bound[i];
    const bool free = force[i] < b && force[i] > -b;
    side[i] = b <= 0 ? Side::idle : free ? Side::sticks : Side::slides;
    force[i] = b <= 0 ? 0.0 : free ? force[i] : force[i] > 0 ? b : -b;
  }
  return side;
}

}  // namespace detail

// Returns the forces that stop or slow each of the first `count` contacts. `last`: the forces of
// the last step. Inlined, so that a constant count costs nothing.
template <int C>
[[gnu::always_inline]] inline std::array<double, C> solve_friction(
    const FrictionProblem<C>& p, const std::array<double, C>& last, int count = C) {
  std::array<double, C> force = last;
  std::array<detail::Side, C> side = detail::sides_of<C>(p, count, force);
  // Changing all at once nearly always suffices; changing the first one only converges for every
  // positive definite W.
  const int all_at_once = 2 * count, one_at_a_time = 24 * count;
  for (int change = 0; change < all_at_once + one_at_a_time; ++change) {
    detail::solve_sticking<C>(p, count, side, force);
    if (detail::update_sides<C>(p, count, change >= all_at_once, side, force)) return force;
  }
  for (int i = 0; i < count; ++i)
    force[i] = force[i] < -p.bound[i] ? -p.bound[i] : force[i] > p.bound[i] ? p.bound[i] : force[i];
  return force;
}

namespace detail {

// The problem and its current solution.
template <int C, int W>
class FrictionLanes {
 public:
  using S = units::Pack<W>;
  using Mask = units::PackMask<W>;
  using Forces = std::array<S, C>;

  FrictionLanes(const FrictionProblem<C, S>& problem, const Forces& last)
      : p_(problem), force_(last) {
    for (int i = 0; i < C; ++i) {
      const S &b = p_.bound[i], f = force_[i];
      const Mask idle = b <= 0.0, free = (f < b) & (f > -b);
      sticks_[i] = free & !idle;
      slides_[i] = !(free | idle);
      const S bounded = units::select(free, f, units::select(f > 0.0, b, -b));
      force_[i] = units::select(idle, 0.0, bounded);
    }
  }

  const Forces& force() const { return force_; }
  const Mask& unsettled() const { return unsettled_; }

  // Applies one change to all contacts that have to change.
  void change() {
    solve_sticking();
    update_sides();
  }

 private:
  S slip_under(int i) const {
    S s = p_.slip[i];
    for (int j = 0; j < C; ++j) s += p_.response[i][j] * force_[j];
    return s;
  }

  void solve_sticking() {
    // Rows that stick in some lane; all others would be zero in every lane.
    std::array<int, C> index;
    std::array<Mask, C> row;
    int n = 0;
    S largest = 0;
    for (int i = 0; i < C; ++i) {
      const Mask sticks = sticks_[i] & unsettled_;
      if (!units::any(sticks)) continue;
      const S& own = p_.response[i][i];
      largest = units::select(sticks & (own > largest), own, largest);
      row[n] = sticks;
      index[n++] = i;
    }

    std::array<std::array<S, C>, C> lower;
    std::array<S, C> pivot, inverse, x;
    const S damping = 1e-9 * largest;
    for (int a = 0; a < n; ++a) {
      const int i = index[a];
      for (int b = 0; b <= a; ++b) {
        S m = p_.response[i][index[b]];
        for (int k = 0; k < b; ++k) m -= lower[a][k] * lower[b][k] * pivot[k];
        if (a == b) {
          pivot[a] = units::select(row[a], units::select(m > 0.0, m, 0.0) + damping, 1.0);
          inverse[a] = 1.0 / pivot[a];
        } else {
          lower[a][b] = units::select(row[a] & row[b], m * inverse[b], 0.0);
        }
      }
      x[a] = -slip_under(i);
      for (int k = 0; k < a; ++k) x[a] -= lower[a][k] * x[k];
      x[a] = units::select(row[a], x[a], 0.0);
    }
    for (int a = n - 1; a >= 0; --a) {
      x[a] *= inverse[a];
      for (int k = a + 1; k < n; ++k) x[a] -= lower[k][a] * x[k];
    }
    for (int a = 0; a < n; ++a) {
      S& force = force_[index[a]];
      force = units::select(row[a], force + x[a], force);
    }
  }

  // Lets contacts slide that exceed their bound, and contacts stick whose force would push them.
  void update_sides() {
    Mask changed = unsettled_ ^ unsettled_;
    for (int i = 0; i < C; ++i) {
      const S &b = p_.bound[i], f = force_[i];
      const Mask starts_sliding = sticks_[i] & ((f > b) | (f < -b)) & unsettled_;
      Mask starts_sticking = slides_[i] & unsettled_;
      if (units::any(starts_sticking))
        starts_sticking = starts_sticking & (slip_under(i) * f > 0.0);
      force_[i] = units::select(starts_sliding, units::select(f > 0.0, b, -b), f);
      sticks_[i] = (sticks_[i] & !starts_sliding) | starts_sticking;
      slides_[i] = (slides_[i] & !starts_sticking) | starts_sliding;
      changed = changed | starts_sliding | starts_sticking;
    }
    unsettled_ = changed;
  }

  const FrictionProblem<C, S>& p_;
  Forces force_;
  std::array<Mask, C> sticks_, slides_;
  Mask unsettled_ = S(0.0) == S(0.0);
};

}  // namespace detail

// Solves W problems in lanes. Each result is that of its problem alone.
template <int C, int W>
std::array<units::Pack<W>, C> solve_friction(const FrictionProblem<C, units::Pack<W>>& p,
                                             const std::array<units::Pack<W>, C>& last) {
  constexpr int most = C < 4 ? 2 * C : 8;  // rounds for all lanes, all contacts at once
  detail::FrictionLanes<C, W> lanes(p, last);
  for (int k = 0; k < most && units::any(lanes.unsettled()); ++k) lanes.change();
  std::array<units::Pack<W>, C> force = lanes.force();
  if (!units::any(lanes.unsettled())) return force;

  for (int k = 0; k < W; ++k) {
    if (!lanes.unsettled()[k]) continue;
    const auto alone = solve_friction<C>(units::lane_of<FrictionProblem<C>>(p, k),
                                         units::lane_of<std::array<double, C>>(last, k));
    for (int c = 0; c < C; ++c) force[c].set(k, alone[c]);
  }
  return force;
}

}  // namespace sinew::plant
