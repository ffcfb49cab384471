// actuator/series.h - ends and bladder that give way: a spring between the clamps and the braid.
//
//   B(x) = (L - x)/C          F = B(x)          dF/dL = B'/(1 + C B')
//
//   L  length of the muscle [m]   x  of its braid [m]   B  what braid and bladder pull with, pull.h
//   C  compliance of both ends together [m/N], 0: they do not give way
//
// One pair of ends has one C, whatever the rest length: short muscles lose a larger share of their
// stiffness to it. Festo muscles of 10 mm have some 0.011 mm/N (docs/theory/static-models.md).
//
// Newton's iteration from x = L: B is convex and grows with x, so every step but the first comes
// from above the solution and none goes past it. The air keeps the volume of the whole length: C F
// is 2 to 4 % of the length, and of the volume at the highest force some 5 %. Not in the thesis.
#pragma once

#include "sinew/actuator/pull.h"

namespace sinew::actuator {

// Returns x  [m]. With C = 0 it is `length` itself, to the bit.
inline double braid_length(const Actuator& a, double length, double gauge_pressure,
                           double atmosphere) {
  const double c = a.series.compliance;
  if (!(c > 0)) return length;
  const double acting = acting_pressure(a.effectiveness, gauge_pressure);
  const double eff = effectiveness(a.effectiveness, gauge_pressure, atmosphere);
  const double gain = taper_gain(a.taper, gauge_pressure);
  double x = length;
  for (int i = 0; i < 30; ++i) {
    const double w = working_length(a, x, gauge_pressure);
    const BladderPull bladder = bladder_pull(a.bladder, x);
    const double pull =
        (ideal_tension(a.braid, w, acting) + acting * wall_area(a, w)) * eff + bladder.tension;
    const double slope =
        (ideal_stiffness(a.braid, w, acting) + acting * wall_area_slope(a, w)) * gain * eff +
        bladder.stiffness;
    const double grows = c * slope > -0.5 ? c * slope : -0.5;
    const double step = (c * pull - (length - x)) / (1.0 + grows);
    x -= step;
    // What is left is of the order of the square of the last step.
    if (step < 1e-9 * length && step > -1e-9 * length) break;
  }
  return x;
}

// Returns the share of a stiffness of braid and bladder that is left of it at the muscle's ends,
// 1/(1 + C B')  [-].
inline double share_of_stiffness(const Actuator& a, double x, double gauge_pressure,
                                 double atmosphere) {
  const double c = a.series.compliance;
  if (!(c > 0)) return 1.0;
  return 1.0 / (1.0 + c * (braid_pull_slope(a, x, gauge_pressure, atmosphere) +
                           bladder_stiffness(a.bladder, x)));
}

}  // namespace sinew::actuator
