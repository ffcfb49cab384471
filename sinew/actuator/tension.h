// actuator/tension.h - tension of one actuator, [22], [30]-[32], [35].
//
//   F = P_g b^2/(4 pi n^2) (3 L^2/b^2 - 1) Eff(p) + ends + bladder + c v          [31], [33]
//
//   P_g  gauge pressure [Pa]        L  length [m]         v  dL/dt [m/s]
//
// Beyond the thesis, and without effect unless set: a threshold of the pressure (here), caps, taper
// and wall (body.h), a nonlinear bladder (bladder.h), a soft beginning and elastic ends (series.h):
//
//   F = P_act Eff(p) (b^2/(4 pi n^2) (3 L_b^2/b^2 - 1) + A_t(L_b)) + ...
//
// The dry friction of [33] is not included: it is a force of the step, see loss.h. Departures: P -
// P_atm keeps its sign (appendix A takes |P - 14.7|, so that vacuum would pull). Below the shortest
// length an end stop acts, or the tension is zero as printed, or appendix A's other line holds:
//
//   F <- 5 F + 10 F_damping,  F with the damping included: 5 times the pull, 15 times the losses
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/bladder.h"
#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/pull.h"
#include "sinew/actuator/series.h"

namespace sinew::actuator {

// ShortEnd::Law::empirical: factors of the pull, and of viscous and dry friction [-].
inline constexpr double empirical_pull = 5, empirical_loss = 15;

// Returns the tension of the stretched threads, [32], [35] [N]; zero up to L_max.
constexpr double long_end_tension(const LongEnd& end, double length, double velocity) {
  const double force = end.stiffness * (length - end.length) + end.damping * velocity;
  return length > end.length ? force : 0.0;
}

// Returns whether the actuator has the thesis's law of force and volume, a linear bladder and
// nothing more.
constexpr bool is_plain(const Actuator& a) {
  const Bladder none;
  return a.effectiveness.threshold == 0 && a.caps.length == 0 && !tapers(a.taper) &&
         a.wall.thickness == 0 && a.air.offset == 0 && a.series.compliance == 0 &&
         a.toe.tension == 0 && a.bladder.quadratic == 0 && a.bladder.cubic == 0 &&
         a.bladder.saturating_tension == 0 && a.bladder.valid_from == none.valid_from &&
         a.bladder.valid_to == none.valid_to;
}

// Returns the tension that bladder and toe add to the braid's [N].
inline double bladder_and_toe_tension(const Actuator& a, double x, double pull) {
  const double bladder = bladder_tension(a.bladder, x);
  return a.toe.tension > 0 ? toe_tension(a.toe, pull + bladder) - pull : bladder;
}

// Returns [31], [33] without dry friction for an actuator clamped at both ends: negative where it
// pushes [N].
inline double clamped_tension(const Actuator& a, double length, double velocity,
                              double gauge_pressure, double atmosphere) {
  const double x = braid_length(a, length, gauge_pressure, atmosphere);
  const double pull = braid_pull(a, x, gauge_pressure, atmosphere);
  const double passive = bladder_and_toe_tension(a, x, pull) + a.loss.viscous * velocity;
  const double inside = pull + passive + long_end_tension(a.long_end, length, velocity);

  const double shortest = shortest_length(a);
  if (length >= shortest) return inside;
  if (a.short_end.law == ShortEnd::Law::zero) return 0.0;
  if (a.short_end.law == ShortEnd::Law::empirical)
    return inside + (empirical_pull - 1) * pull + (empirical_loss - 1) * a.loss.viscous * velocity;
  return inside + a.short_end.stiffness * (length - shortest) + a.short_end.damping * velocity;
}

// Returns the tension of a muscle whose ends are free to approach [N]. It cannot push: where the
// clamped actuator would, the tension is 0.
inline double tension(const Actuator& a, double length, double velocity, double gauge_pressure,
                      double atmosphere) {
  const double clamped = clamped_tension(a, length, velocity, gauge_pressure, atmosphere);
  return clamped > 0 ? clamped : 0.0;
}

}  // namespace sinew::actuator
