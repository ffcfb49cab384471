// plant/planar/contacts.h - where a planar machine rubs: its joints, its trolley, its foot.
//
// Contact c slips with the velocity J_c v and carries the force f_c, whose generalised force is
// J_c^T f_c. At a node everything that the friction of a step needs is made once (prepare); the
// forces for a step of any length then follow from it (hold). See friction.h for the law.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/plant/planar/chain.h"
#include "sinew/plant/planar/friction.h"
#include "sinew/robot/robot.h"

namespace sinew::plant {

template <int N>
class Contacts {
 public:
  static constexpr int count = N + 2;  // the joints, the trolley, the foot
  static constexpr int trolley = N, foot = N + 1;
  using Forces = std::array<double, count>;  // [N m] of the joints, [N] of the others

  Contacts(const ChainConstants<N>& chain, const robot::Robot& robot)
      : k_(chain), foot_(robot.foot), ground_(robot.ground) {}

  // J^T f.
  Generalised<N> generalised(const Chain<N>& chain, const Forces& f) const {
    Generalised<N> out;
    out.x = f[trolley] + f[foot];
    for (int i = 0; i < N; ++i)
      out.angle[i] = f[i] - (i + 1 < N ? f[i + 1] : 0.0) - f[foot] * k_.length[i] * chain.sin(i);
    out.angle[N - 1] += f[foot] * foot_.radius;
    return out;
  }

  // J v, or J a. The foot slips at its lowest point, a radius below the ankle.
  Forces slips(const Chain<N>& chain, const Generalised<N>& v) const {
    Forces s;
    s[trolley] = v.x;
    s[foot] = v.x + foot_.radius * v.angle[N - 1];
    for (int i = 0; i < N; ++i) {
      s[i] = v.angle[i] - (i > 0 ? v.angle[i - 1] : 0.0);
      s[foot] -= k_.length[i] * chain.sin(i) * v.angle[i];
    }
    return s;
  }

  // The fastest rate at which springs, dampers and the ground bring the machine to rest  [1/s]: c w
  // and sqrt(k w) with w, the acceleration per force of the joint or of the ankle.
  double stiffest_rate(const Chain<N>& chain, const std::array<double, N>& damping,
                       const std::array<double, N>& spring) const {
    double fastest = 0;
    const auto consider = [&](double w, double c, double k) {
      fastest = std::max({fastest, c * w, std::sqrt(k * w)});
    };
    Generalised<N> up;
    for (int i = 0; i < N; ++i) {
      Forces unit{};
      unit[i] = 1.0;
      consider(slips(chain, chain.response(generalised(chain, unit)))[i], damping[i], spring[i]);
      up.angle[i] = k_.length[i] * chain.cos(i);
    }
    if (!ground_.present || !foot_.present) return fastest;
    const Generalised<N> column = chain.response(up);
    double w = 0;
    for (int i = 0; i < N; ++i) w += up.angle[i] * column.angle[i];
    consider(w, ground_.normal_damping, ground_.normal_stiffness);
    return fastest;
  }

  // At a node: accelerations without friction, bounds, and the ground's force on the foot.
  void prepare(const Chain<N>& chain, const Pose<N>& pose, const Generalised<N>& acceleration,
               const Forces& bound, double normal) {
    problem_.bound = bound;
    for (int c = 0; c < count; ++c) {
      Forces unit{};
      unit[c] = 1.0;
      column_[c] = bound[c] > 0 ? chain.response(generalised(chain, unit)) : Generalised<N>{};
      const Forces response = slips(chain, column_[c]);
      for (int d = 0; d < count; ++d) problem_.response[d][c] = response[d];
    }
    problem_.slip = slips(chain, {.x = pose.x_rate, .angle = pose.rate});
    slip_rate_ = slips(chain, acceleration);
    // The foot's lever turns with the links: d/dt of J is part of the slip's rate.
    for (int i = 0; i < N; ++i)
      slip_rate_[foot] -= k_.length[i] * chain.cos(i) * pose.rate[i] * pose.rate[i];

    normal_.force = normal;
    if (normal > 0) prepare_normal(chain, pose, acceleration);
  }

  // Dry friction of a step of length h; `last` is the last step's.
  //
  // The ground is stiff: its normal force changes within the step, by about
  //
  //   dF = -k (h/2 v_y + h/6 dv_y) - c/2 dv_y    the mean over the step for a linear v_y(t)
  //
  // and so do the slips. Solving for dF adds a rank-one term to W; without it the joints would slip
  // a little where they should stick, and the walk would converge with the first order only.
  Forces hold(double h, const Forces& last) const {
    FrictionProblem<count> p = problem_;
    for (int c = 0; c < count; ++c) {
      p.slip[c] += h * slip_rate_[c];
      for (int d = 0; d < count; ++d) p.response[c][d] *= h;
    }
    if (normal_.force > 0) {
      const double k = ground_.normal_stiffness;
      const double beta = h * (h / 6.0 * k + 0.5 * ground_.normal_damping);
      const double share = 1.0 / (1.0 + beta * normal_.response);
      const double change = -(0.5 * h * k * normal_.rate + beta * normal_.acceleration) * share;
      const double mean = normal_.force + change;
      p.bound[foot] = mean > 0 ? foot_.friction * mean : 0.0;
      for (int c = 0; c < count && mean > 0; ++c) {
        p.slip[c] += h * normal_.along[c] * change;
        for (int d = 0; d < count; ++d)
          p.response[c][d] -= h * beta * share * normal_.along[c] * normal_.along[d];
      }
    }
    return solve_friction<count>(p, last);
  }

  // Accelerations under the friction f, given those without any.
  Generalised<N> accelerations(Generalised<N> without, const Forces& f) const {
    for (int c = 0; c < count; ++c) {
      without.x += column_[c].x * f[c];
      for (int i = 0; i < N; ++i) without.angle[i] += column_[c].angle[i] * f[c];
    }
    return without;
  }

  double bound(int c) const { return problem_.bound[c]; }

 private:
  // The ground's normal force as one more direction.
  struct Normal {
    double force = 0;                   // at the node [N]
    double response = 0;                // upward acceleration of the ankle per force [1/kg]
    double rate = 0, acceleration = 0;  // of the ankle, upwards [m/s], [m/s^2]
    Forces along{};                     // upward acceleration per friction force
  };

  void prepare_normal(const Chain<N>& chain, const Pose<N>& pose,
                      const Generalised<N>& acceleration) {
    Generalised<N> up;
    for (int i = 0; i < N; ++i) up.angle[i] = k_.length[i] * chain.cos(i);
    const Generalised<N> column = chain.response(up);
    normal_ = {.force = normal_.force};
    for (int i = 0; i < N; ++i) {
      const double rate = pose.rate[i];
      normal_.response += up.angle[i] * column.angle[i];
      normal_.rate += up.angle[i] * rate;
      normal_.acceleration +=
          up.angle[i] * acceleration.angle[i] - k_.length[i] * chain.sin(i) * rate * rate;
      for (int c = 0; c < count; ++c) normal_.along[c] += up.angle[i] * column_[c].angle[i];
    }
  }

  ChainConstants<N> k_;
  robot::Foot foot_;
  robot::Ground ground_;

  std::array<Generalised<N>, count> column_{};  // M^-1 J^T
  FrictionProblem<count> problem_{};            // slips at the node, responses per second
  Forces slip_rate_{};                          // of the slips, without friction
  Normal normal_;
};

}  // namespace sinew::plant
