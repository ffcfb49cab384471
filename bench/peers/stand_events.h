// bench/peers/stand_events.h - event handling of the adaptive integrators of stand_peers.h: the
// valve's edges, and reversal, sticking and breakaway of the mesh.
//
// Stepper  restart(t, state, side, valve); one_step(until) returns the time reached, at most one
// step
//          beyond `until`; state_at(t) within the last step
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/appendix_a.h"
#include "bench/peers/stand_peers.h"

namespace sinew::bench {

using StandState = std::array<double, 4>;  // length, speed, pressure, mass: appendix A's units

inline constexpr double scale_of_state[4] = {1.0, 10.0, 100.0, 1e-6};

// Direction of the dry friction: 1 while the load moves down, -1 while it moves up, 0 at rest.
class StandRun {
 public:
  template <class Stepper>
  void go(Stepper& stepper, int every, Lengths& lengths) {
    state_ = appendix_a_start();
    for (int ms = 0; ms < appendix_a_milliseconds;) {
      const int in_period = ms % 40;
      const int valve = in_period < 16 ? 1 : 2;
      const int edge = ms - in_period + (in_period < 16 ? 16 : 40);
      stretch(stepper, valve, 1e-3 * ms, 1e-3 * edge, every, lengths);
      ms = edge;
    }
  }

 private:
  // Integrates between two edges of the valve.
  template <class Stepper>
  void stretch(Stepper& stepper, int valve, double t, double until, int every, Lengths& lengths) {
    while (t < until) {
      settle();
      stepper.restart(t, state_, side_, valve);
      bool event = false;
      while (t < until && !event) {
        const double reached = std::min(stepper.one_step(until), until);
        StandState then = stepper.state_at(reached);
        double to = reached;
        if (turns(then)) {
          event = true;
          to = where(stepper, t, reached);
          then = stepper.state_at(to);
        }
        sample(stepper, t, to, every, lengths);
        t = to;
        state_ = then;
      }
    }
  }

  // Returns, in motion, the speed; at rest, the friction bound minus the force. Below 0 the state
  // ends.
  double margin(const StandState& x) const {
    if (side_ != 0) return side_ * x[1];
    const AppendixFriction f = appendix_a_friction(x.data());
    return f.bound - std::fabs(f.unbalanced);
  }
  bool turns(const StandState& x) const { return margin(x) < 0; }

  // Returns the time at which the margin becomes negative, by bisection.
  template <class Stepper>
  double where(Stepper& stepper, double from, double to) const {
    double low = from, high = to;
    for (int i = 0; i < 50 && high - low > 1e-13; ++i) {
      const double middle = 0.5 * (low + high);
      (turns(stepper.state_at(middle)) ? high : low) = middle;
    }
    return high;
  }

  void settle() {
    const AppendixFriction f = appendix_a_friction(state_.data());
    if (side_ != 0 && side_ * state_[1] > 1e-9) return;
    state_[1] = 0;
    const bool broke_loose = side_ == 0 && std::fabs(f.unbalanced) > f.bound * (1 - 1e-9);
    side_ = 0;
    if (broke_loose || std::fabs(f.unbalanced) > f.bound) side_ = f.unbalanced > 0 ? 1 : -1;
  }

  template <class Stepper>
  void sample(Stepper& stepper, double from, double to, int every, Lengths& lengths) const {
    const double first = std::floor(1e3 * from / every + 1e-9) + 1;
    for (double k = first; 1e-3 * every * k <= to + 1e-12; ++k) {
      const auto ms = static_cast<std::size_t>(std::lround(every * k));
      if (ms >= 1 && ms <= lengths.size())
        lengths[ms - 1] = stepper.state_at(std::min(1e-3 * every * k, to))[0];
    }
  }

  StandState state_{};
  int side_ = 0;
};

}  // namespace sinew::bench
