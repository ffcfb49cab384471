// world/cuts.h - the members of World that integrate a mechanism which cuts its steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "sinew/world/cut.h"
#include "sinew/world/world.h"

namespace sinew::plant {

// A smooth part begins at t: what is prescribed goes into the state, and friction is decided by a
// look at it.
template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
void World<M, A>::begin_part(double t, Moving& s, const Memory& memory, Forces& held,
                             Look& look) noexcept {
  mechanism_.begin(t, s.motion);
  mechanism_.route(t, s.motion, look.ends, look.arms);
  air_.place(look.ends, s.air);
  air_.use_whole_laws();
  air_.evaluate(t, look.ends, s.air, state_.valves, memory, look.air);
  air_.choose_sides(look.air, state_.valves);
  const typename M::Pose pose = mechanism_.pose(t, s.motion);
  mechanism_.load(pose, s.motion, look.arms, look.air, look.load);
  held = mechanism_.hold(s.motion, look.load, held);
  look.acceleration = mechanism_.accelerate(pose, s.motion, look.load, held);
}

// Integrates from one instant to another. `first` is the look at the state there, and in the end
// that at the beginning of the last piece.
template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
void World<M, A>::go(double from, double to, Moving& s, Memory& memory, Forces& held,
                     Look& first) noexcept {
  constexpr double shortest = 1e-7;  // of a piece, unless it is cut [s]
  Moving others[2];
  Moving *now = &s, *after = &others[0], *spare = &others[1];
  for (double t = from; t < to;) {
    if (t > from) {
      begin_part(t, *now, memory, held, first);
      air_.remember(first.air, now->air, memory);
    } else {
      mechanism_.begin(t, now->motion);
      air_.choose_sides(first.air, state_.valves);
    }
    const double target = std::min(to, mechanism_.corner()), whole = target - t;
    const double pieces = std::ceil(whole / std::max(longest_piece(*now, first), shortest) - 1e-9);
    double h = pieces > 1 ? whole / pieces : whole;
    double reached = pieces > 1 ? t + h : target;
    const auto integrate = [&](Moving& out, double within) {
      out = *now;
      piece(t, within, out, memory, first, first.acceleration, held);
    };
    integrate(*after, h);
    const double broken = gap(reached, *now, *after, memory, held);
    if (broken > 0) {
      // The end of the piece is put where it breaks, on the far side of it.
      const double unbroken = std::max(mechanism_.gap(now->motion, now->motion, held, first.load),
                                       air_.gap(first.air, state_.valves));
      h = cut(h, unbroken, broken, mechanism_.cut_within(), [&](double within) {
        integrate(*spare, within);
        const double g = gap(t + within, *now, *spare, memory, held);
        if (g > 0) std::swap(after, spare);
        return g;
      });
      reached = t + h;
      mechanism_.stop(after->motion, held);
    }
    std::swap(now, after);
    t = reached;
  }
  if (now == &s) return;
  s = *now;
}

// Returns how far `after` is beyond what a smooth piece from `before` can hold.
template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
double World<M, A>::gap(double t, const Moving& before, const Moving& after, const Memory& memory,
                        const Forces& held) const noexcept {
  Look look;
  const bool watches = air_.watches(state_.valves);
  if (watches || mechanism_.watches(held)) look_at(t, after, memory, held, look);
  const double of_body = mechanism_.gap(before.motion, after.motion, held, look.load);
  return watches ? std::max(of_body, air_.gap(look.air, state_.valves)) : of_body;
}

template <IsMechanism M, IsAirOf<M> A>
template <CutsSteps>
double World<M, A>::longest_piece(const Moving& s, const Look& look) const noexcept {
  return std::min(mechanism_.longest_piece(s.motion, look.load, look.air),
                  air_.longest_piece(look.ends, look.air, s.air, state_.valves));
}

}  // namespace sinew::plant
