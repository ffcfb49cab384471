// analysis/measures/trolley.h - where the trolley goes under a known push and a dry drag, as 6.3
// integrates it: in stance the friction force of [75] less the drag, in swing the drag alone.
//
//   M v' = F - D sign(v),   |F - M v'| <= D while v = 0
//
//   M  all that moves along the track [kg]     F  push of the ground [N]     D  drag [N]
//
// Linear integration: F is straight between two samples, velocity and position by trapezoids, the
// drag takes away at most the velocity that is there. Exact for a constant force up to the step in
// which the trolley stops.
#pragma once

#include <cstddef>

#include "sinew/signals/table.h"

namespace sinew::analysis {

// Where the trolley is, and how fast.
struct TrolleyState {
  double position = 0;  // [m]
  double velocity = 0;  // [m/s]
};

// Over `dt` seconds under the mean push of that time.
TrolleyState pushed(TrolleyState state, double push, double drag, double mass, double dt);

// How far the trolley came, and how fast.
struct TrolleyMotion {
  signals::Column position, velocity;  // [m], [m/s]
};

// From rest at row `start`; rows before it stay at 0. A push that is not a number counts as none.
TrolleyMotion integrate(const signals::Column& push, const signals::Column& seconds, double drag,
                        double mass, std::size_t start);

}  // namespace sinew::analysis
