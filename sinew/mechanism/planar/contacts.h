// mechanism/planar/contacts.h - where a planar machine rubs: its joints, its trolley, its foot.
//
// Contact c slips with the velocity J_c v and carries the force f_c, whose generalised force is
// J_c^T f_c. At a node everything that the friction of a step needs is made once (prepare); the
// forces for a step of any length then follow from it (hold). See friction.h for the law.
//
// S is a double; or a pack of them, of machines side by side. What only some of those do is
// calculated where one does it, and selected.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/mechanism/friction/friction.h"
#include "sinew/mechanism/planar/chain.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

// The ground and the foot on it, in numbers; where one is missing the ground is out of reach.
template <class S>
struct Footing {
  S height = -std::numeric_limits<double>::infinity();  // of the ankle at contact [m]
  S stiffness = 0, damping = 0;                         // of the ground [N/m], [N s/m]
  S friction = 0, radius = 0;                           // of the foot [-], [m]
};

// Returns foot and ground of a robot; without either, one that touches nothing.
inline Footing<double> footing_of(const robot::Robot& robot) {
  Footing<double> f{.friction = robot.foot.friction, .radius = robot.foot.radius};
  if (!robot.ground.present || !robot.foot.present) return f;
  f.height = robot.ground.height;
  f.stiffness = robot.ground.normal_stiffness;
  f.damping = robot.ground.normal_damping;
  return f;
}

template <int N, class S = double>
class Contacts {
 public:
  static constexpr int count = N + 2;  // the joints, the trolley, the foot
  static constexpr int trolley = N, foot = N + 1;
  using Forces = std::array<S, count>;  // [N m] of the joints, [N] of the others

  // Takes the constants, which outlive it.
  Contacts(const ChainConstants<N, S>& chain, const Footing<S>& footing)
      : k_(chain), footing_(footing) {}

  // J^T f.
  GeneralizedVector<N, S> generalised(const Chain<N, S>& chain, const Forces& f) const {
    GeneralizedVector<N, S> out;
    out.x = f[trolley] + f[foot];
    for (int i = 0; i < N; ++i)
      out.angle[i] = f[i] - (i + 1 < N ? f[i + 1] : S(0.0)) - f[foot] * k_.length[i] * chain.sin(i);
    out.angle[N - 1] += f[foot] * footing_.radius;
    return out;
  }

  // J v, or J a. The foot slips at its lowest point, a radius below the ankle.
  Forces slips(const Chain<N, S>& chain, const GeneralizedVector<N, S>& v) const {
    Forces s;
    s[trolley] = v.x;
    s[foot] = v.x + footing_.radius * v.angle[N - 1];
    for (int i = 0; i < N; ++i) {
      s[i] = v.angle[i] - (i > 0 ? v.angle[i - 1] : S(0.0));
      s[foot] -= k_.length[i] * chain.sin(i) * v.angle[i];
    }
    return s;
  }

  // The fastest rate at which springs, dampers and the ground bring the machine to rest  [1/s]: c w
  // and sqrt(k w) with w, the acceleration per force of the joint or of the ankle.
  double stiffest_rate(const Chain<N, S>& chain, const std::array<S, N>& damping,
                       const std::array<S, N>& spring) const {
    double fastest = 0;
    const auto consider = [&](double w, double c, double k) {
      fastest = std::max({fastest, c * w, std::sqrt(k * w)});
    };
    GeneralizedVector<N, S> up;
    for (int i = 0; i < N; ++i) {
      Forces unit{};
      unit[i] = 1.0;
      consider(slips(chain, chain.response(generalised(chain, unit)))[i], damping[i], spring[i]);
      up.angle[i] = k_.length[i] * chain.cos(i);
    }
    if (std::isinf(footing_.height)) return fastest;
    const GeneralizedVector<N, S> column = chain.response(up);
    double w = 0;
    for (int i = 0; i < N; ++i) w += up.angle[i] * column.angle[i];
    consider(w, footing_.damping, footing_.stiffness);
    return fastest;
  }

  // At a node: accelerations without friction, bounds, and the ground's force on the foot.
  void prepare(const Chain<N, S>& chain, const GeneralizedState<N, S>& motion,
               const GeneralizedVector<N, S>& acceleration, const Forces& bound, const S& normal) {
    problem_.bound = bound;
    for (int c = 0; c < count; ++c) {
      Forces unit{};
      unit[c] = 1.0;
      column_[c] = {};
      if (const auto rubs = bound[c] > 0.0; units::any(rubs))
        column_[c] = select(rubs, chain.response(generalised(chain, unit)), column_[c]);
      const Forces response = slips(chain, column_[c]);
      for (int d = 0; d < count; ++d) problem_.response[d][c] = response[d];
    }
    problem_.slip = slips(chain, {.x = motion.x_rate, .angle = motion.rate});
    slip_rate_ = slips(chain, acceleration);
    // The foot's lever turns with the links: d/dt of J is part of the slip's rate.
    for (int i = 0; i < N; ++i)
      slip_rate_[foot] -= k_.length[i] * chain.cos(i) * motion.rate[i] * motion.rate[i];

    normal_.force = normal;
    if (units::any(normal > 0.0)) prepare_normal(chain, motion, acceleration);
  }

  // Dry friction of a step of length h; `last` is the last step's.
  //
  // The ground is stiff: its normal force changes within the step, by about
  //
  //   dF = -k (h/2 v_y + h/6 dv_y) - c/2 dv_y    the mean over the step for a linear v_y(t)
  //
  // and so do the slips. Solving for dF adds a rank-one term to W; without it the joints would slip
  // a little where they should stick, and the walk would converge with the first order only.
  Forces hold(const S& h, const Forces& last) const {
    FrictionProblem<count, S> p = problem_;
    for (int c = 0; c < count; ++c) {
      p.slip[c] += h * slip_rate_[c];
      for (int d = 0; d < count; ++d) p.response[c][d] *= h;
    }
    if (const auto stands = normal_.force > 0.0; units::any(stands)) add_normal(h, stands, p);
    return solve_friction<count>(p, last);
  }

  // Accelerations under the friction f, given those without any.
  GeneralizedVector<N, S> accelerations(const GeneralizedVector<N, S>& without,
                                        const Forces& f) const {
    GeneralizedVector<N, S> a = without;
    for (int c = 0; c < count; ++c) {
      a.x += column_[c].x * f[c];
      for (int i = 0; i < N; ++i) a.angle[i] += column_[c].angle[i] * f[c];
    }
    return a;
  }

  // Returns the bound of a contact's dry friction, as hold() has last found it.
  S bound(int c) const { return problem_.bound[c]; }

 private:
  // The ground's normal force as one more direction.
  struct Normal {
    S force = 0;                   // at the node [N]
    S response = 0;                // upward acceleration of the ankle per force [1/kg]
    S rate = 0, acceleration = 0;  // of the ankle, upwards [m/s], [m/s^2]
    Forces along{};                // upward acceleration per friction force
  };

  // The ground's answer within the step, for those that stand on it.
  template <class Mask>
  void add_normal(const S& h, const Mask& stands, FrictionProblem<count, S>& p) const {
    const S k = footing_.stiffness;
    const S beta = h * (h / 6.0 * k + 0.5 * footing_.damping);
    const S share = 1.0 / (1.0 + beta * normal_.response);
    const S change = -(0.5 * h * k * normal_.rate + beta * normal_.acceleration) * share;
    const S mean = normal_.force + change;
    const auto stays = stands & (mean > 0.0);
    p.bound[foot] = units::select(stands, units::select(mean > 0.0, footing_.friction * mean, 0.0),
                                  p.bound[foot]);
    if (!units::any(stays)) return;
    for (int c = 0; c < count; ++c) {
      const S slip = p.slip[c] + h * normal_.along[c] * change;
      p.slip[c] = units::select(stays, slip, p.slip[c]);
      for (int d = 0; d < count; ++d) {
        const S response =
            p.response[c][d] - h * beta * share * normal_.along[c] * normal_.along[d];
        p.response[c][d] = units::select(stays, response, p.response[c][d]);
      }
    }
  }

  void prepare_normal(const Chain<N, S>& chain, const GeneralizedState<N, S>& motion,
                      const GeneralizedVector<N, S>& acceleration) {
    GeneralizedVector<N, S> up;
    for (int i = 0; i < N; ++i) up.angle[i] = k_.length[i] * chain.cos(i);
    const GeneralizedVector<N, S> column = chain.response(up);
    normal_ = {.force = normal_.force};
    for (int i = 0; i < N; ++i) {
      const S rate = motion.rate[i];
      normal_.response += up.angle[i] * column.angle[i];
      normal_.rate += up.angle[i] * rate;
      normal_.acceleration +=
          up.angle[i] * acceleration.angle[i] - k_.length[i] * chain.sin(i) * rate * rate;
      for (int c = 0; c < count; ++c) normal_.along[c] += up.angle[i] * column_[c].angle[i];
    }
  }

  ChainConstants<N, S> k_;
  Footing<S> footing_;

  std::array<GeneralizedVector<N, S>, count> column_{};  // M^-1 J^T
  FrictionProblem<count, S> problem_{};                  // slips at the node, responses per second
  Forces slip_rate_{};                                   // of the slips, without friction
  Normal normal_;
};

}  // namespace sinew::plant
