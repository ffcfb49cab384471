// analysis/measures/trolley.h - motion of the trolley under a given push and a dry drag, integrated
// as in 6.3: in stance the friction force of [75] less the drag, in swing the drag alone.
//
//   M v' = F - D sign(v),   |F - M v'| <= D while v = 0
//
//   M  mass that moves along the track [kg]     F  push of the ground [N]     D  drag [N]
//
// F is linear between two samples, velocity and position are integrated by trapezoids, and the drag
// reduces the velocity to 0 at most. It is exact for a constant force up to the step in which the
// trolley stops.
#pragma once

#include <cstddef>

#include "sinew/signals/table.h"

namespace sinew::analysis {

// Position and velocity of the trolley.
struct TrolleyState {
  double position = 0;  // [m]
  double velocity = 0;  // [m/s]
};

// Returns the state after `dt` seconds under a mean push.
TrolleyState pushed(TrolleyState state, double push, double drag, double mass, double dt);

// Position and velocity of the trolley in each row.
struct TrolleyMotion {
  signals::Column position, velocity;  // [m], [m/s]
};

// Integrates from rest at row `start`; the rows before it are 0. A push that is NaN counts as 0.
TrolleyMotion integrate(const signals::Column& push, const signals::Column& seconds, double drag,
                        double mass, std::size_t start);

}  // namespace sinew::analysis
