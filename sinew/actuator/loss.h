// actuator/loss.h - bound of the dry friction between bladder and mesh, [33], [34].
//
//   |F_coulomb| <= Q k,  Q = mu F_n/k [m]
//
// k is the secant stiffness [34] as printed, or the sealed stiffness that Q was identified with
// ([45]), or a constant. Below the bound the mesh sticks. The integrator of the body decides
// between stick and slip once per step (docs/theory/actuator.md, "Losses").
#pragma once

#include <algorithm>

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"

namespace sinew::actuator {

// Returns [34], F/(L - L_min), in a form without its 0/0 at L_min:
//
//   k = 3 P_g Eff (L + L_min)/(4 pi n^2)   [N/m]
//
// It is the stiffness of the braid alone, without a wall.
inline double secant_stiffness(const Actuator& a, double length, double gauge_pressure,
                               double atmosphere) {
  return 3.0 * acting_pressure(a.effectiveness, gauge_pressure) *
         effectiveness(a.effectiveness, gauge_pressure, atmosphere) *
         (working_length(a, length, gauge_pressure) + shortest_length(a.braid)) *
         braid_factor(a.braid);
}

// Returns the largest dry friction [N], never negative. `sealed_stiffness` is used by Scale::sealed
// only.
inline double coulomb_bound(const Actuator& a, double length, double gauge_pressure,
                            double atmosphere, double sealed_stiffness) {
  const bool short_of = length < shortest_length(a);
  if (a.short_end.law == ShortEnd::Law::zero && short_of) return 0.0;
  double k = a.loss.coulomb_stiffness;
  if (a.loss.coulomb_scale == Loss::Scale::secant)
    k = secant_stiffness(a, length, gauge_pressure, atmosphere);
  if (a.loss.coulomb_scale == Loss::Scale::sealed) k = sealed_stiffness;
  if (a.short_end.law == ShortEnd::Law::empirical && short_of) k *= empirical_loss;
  const double bound = a.loss.coulomb_length * k;
  return bound > 0 ? bound : 0.0;
}

// Returns the tension [33] while the length changes at `velocity` = dL/dt, negative when the muscle
// contracts [N]: the static tension, the viscous terms (c v and the ends' damping), and the dry
// friction at its bound, which reduces the tension in contraction and increases it in extension. At
// rest the dry friction may have any value within its bound; 0 is used. Never negative, since a
// muscle cannot push.
inline double sliding_tension(const Actuator& a, double length, double velocity,
                              double gauge_pressure, double atmosphere, double sealed_stiffness) {
  const double flowing = clamped_tension(a, length, velocity, gauge_pressure, atmosphere);
  const double bound = coulomb_bound(a, length, gauge_pressure, atmosphere, sealed_stiffness);
  return std::max(flowing + (velocity > 0 ? bound : velocity < 0 ? -bound : 0.0), 0.0);
}

}  // namespace sinew::actuator
