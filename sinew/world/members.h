// world/members.h - the members of World, for the files that compile its kinds once
// (chain_worlds.cpp, body_worlds.cpp, stand.cpp); cuts.h has those of
// mechanisms that cut their steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "sinew/world/cuts.h"
#include "sinew/world/reading.h"
#include "sinew/world/world.h"

namespace sinew::plant {

template <IsMechanism M, IsAirOf<M> A>
World<M, A>::World(const Setup& setup)
    : mechanism_(setup),
      air_(mechanism_.template make_air<A>(setup)),
      step_(mechanism_.node_step(setup)),
      senses_(setup) {
  static_assert(std::is_trivially_copyable_v<State>);
  Look& first = state_.first;
  state_.now.motion = mechanism_.start();
  mechanism_.route(0, state_.now.motion, first.ends, first.arms);
  state_.now.air = mechanism_.start_air(air_, setup, first.ends);
  state_.valves = air_.valves_at_rest();
  state_.memory = mechanism_.start_memory(air_, setup, first.ends);
  prepare();
}

// One evaluation of the right-hand side, with the frictions held.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::look_at(double t, const Moving& state, const Memory& memory, const Forces& held,
                          Look& look, std::uint64_t ahead) const noexcept {
  evaluate_air(t, state, memory, look, ahead);
  const typename M::Pose pose = mechanism_.pose(t, state.motion);
  mechanism_.load(pose, state.motion, look.arms, look.air, look.load);
  look.acceleration = mechanism_.accelerate(pose, state.motion, look.load, held);
}

// A new node: valves and references, the first stage, and what friction can do about it.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::prepare() noexcept {
  Look& first = state_.first;
  air_.move_valves(state_.time, state_.first.air, state_.valves);
  if constexpr (CutsSteps<M>) {
    begin_part(state_.time, state_.now, state_.memory, state_.held, first);
    look_for_failure();
  } else {
    evaluate_air(state_.time, state_.now, state_.memory, first, air_.always_ahead(state_.valves));
    look_for_failure();
    const typename M::Pose pose = mechanism_.pose(state_.time, state_.now.motion);
    mechanism_.load(pose, state_.now.motion, first.arms, first.air, first.load);
    state_.trolley_bound = mechanism_.trolley_bound(state_.held, state_.trolley_bound);
    first.acceleration = prepare_friction(pose);
  }
}

// The friction problem of the node, and the accelerations without friction.
template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::prepare_friction(const typename M::Pose& pose) noexcept -> Acceleration {
  const Look& first = state_.first;
  glanced_ = false;
  if constexpr (SkipsNodes<M>)
    skipped_ = mechanism_.next_multiple(state_.multiple, step_, pose, state_.now.motion) -
               (state_.multiple + 1);
  if constexpr (CutsSteps<M>)
    return first.acceleration;  // each part has its own
  else
    return mechanism_.prepare(pose, state_.now.motion, first.arms, first.air.friction_bound,
                              state_.trolley_bound, first.load);
}

template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::restore(const State& state) noexcept {
  state_ = state;
  resume();
}

// Is anything of the look at a node no number? The air also takes from the look what it remembers.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::look_for_failure() noexcept {
  const air::Failure of_air = air_.remember(state_.first.air, state_.now.air, state_.memory);
  if (state_.failure) return;
  if (of_air) {
    state_.failure = of_air;
    state_.failure.time = state_.time;
    if (of_air.of == air::Failure::Of::air)
      state_.failure.length = state_.first.ends.length[of_air.muscle];
  } else if (!air::is_place(mechanism_.sum(state_.now.motion))) {
    state_.failure = {.of = air::Failure::Of::motion, .time = state_.time};
  }
}

// While nothing flows, only the air that a piston shuts in can be quick.
template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::longest_piece_of(const Look& look) const noexcept {
  double longest = std::numeric_limits<double>::infinity();
  if (air_.flowing(state_.valves)) longest = air_.longest_step_of_rest(look.ends, state_.valves);
  if constexpr (LiftsBody<M>)
    longest = std::min(
        longest, air_.longest_step_of_piston(look.ends, look.air, mechanism_.lift_per_force()));
  return longest;
}

template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::pieces_of(double h, const Look& look) const noexcept {
  const double longest = longest_piece_of(look);
  return h > longest ? std::min(std::ceil(h / longest), most_pieces) : 1.0;
}

// Hoses, walls and lags can be quicker than the body: a step is then made of several pieces, under
// the friction of the whole.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::step(double to) noexcept {
  if constexpr (CutsSteps<M>) {
    go(state_.time, to, state_.now, state_.memory, state_.held, state_.first);
  } else {
    const double h = to - state_.time;
    Acceleration first;
    if (SkipsNodes<M> && is_whole(to)) {  // a peek goes by the same friction
      first = glance().acceleration;
      state_.held = glance_.held;
    } else {
      state_.held = mechanism_.hold(h, state_.held);
      first = mechanism_.accelerate(state_.first.acceleration, state_.held);
    }
    const double pieces = pieces_of(h, state_.first);
    for (double k = 0; k < pieces; ++k) {
      const double from = state_.time + k * (h / pieces);
      if (k > 0) {
        look_at(from, state_.now, state_.memory, state_.held, state_.first,
                air_.always_ahead(state_.valves));
        air_.remember(state_.first.air, state_.now.air, state_.memory);
        first = state_.first.acceleration;
      }
      piece(from, h / pieces, state_.now, state_.memory, state_.first, first, state_.held);
    }
  }
}

// RK4 in place. The first stage is the look at hand; two to four stand at 1/2, 1/2 and 1. Air that
// is quicker goes ahead.
template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::piece(double from, double h, Moving& now, const Memory& memory, const Look& look,
                        const Acceleration& first, const Forces& held) const noexcept {
  Look later[3];
  Moving stage[3];
  typename A::Course course;
  if constexpr (!CutsSteps<M>)
    air_.plan(from, h, look.ends, now.air, state_.valves, memory, course);
  const Motion* motion[4] = {&now.motion, &stage[0].motion, &stage[1].motion, &stage[2].motion};
  const typename A::Answer* air[4] = {&look.air, &later[0].air, &later[1].air, &later[2].air};
  Acceleration acceleration[4] = {first};
  for (int s = 0; s < 3; ++s) {
    const double part = s == 2 ? h : 0.5 * h;
    mechanism_.move(stage[s].motion, now.motion, part, *motion[s], acceleration[s]);
    air_.move(stage[s].air, now.air, part, *air[s], state_.valves, course);
    look_at(from + part, stage[s], memory, held, later[s], course.muscles);
    if constexpr (RelaxesStages<M>)
      mechanism_.relax(h, 0.2, later[s].load, acceleration[s], later[s].acceleration);
    acceleration[s + 1] = later[s].acceleration;
  }

  const Motion rates = now.motion;  // of the first stage: the state moves
  motion[0] = &rates;
  mechanism_.finish(now.motion, h, motion, acceleration);
  air_.finish(now.air, h, air, state_.valves, course);
}

// The next multiple of the body step that is due, or the next change of a valve.
template <IsMechanism M, IsAirOf<M> A>
double World<M, A>::next_node() const noexcept {
  const double multiple = static_cast<double>(state_.multiple + 1 + skipped_) * step_;
  const double change = state_.valves.next_change;
  return change < multiple ? change : multiple;
}

template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::advance(double t) noexcept {
  while (!state_.failure && next_node() <= t) commit();
}

template <IsMechanism M, IsAirOf<M> A>
void World<M, A>::commit() noexcept {
  const double next = next_node();
  if (next > state_.time) step(next);
  state_.time = next > state_.time ? next : state_.time;
  while (next >= static_cast<double>(state_.multiple + 1) * step_) ++state_.multiple;
  ++state_.nodes;
  prepare();
}

// The friction that a whole body step from the last node would have: what a peek goes by, however
// far it looks, so that it depends on the node alone.
template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::glance() noexcept -> const Glance& {
  if (glanced_) return glance_;
  glanced_ = true;
  if constexpr (!CutsSteps<M>) {
    glance_.held = mechanism_.hold(whole_step(), state_.held);
    glance_.acceleration = mechanism_.accelerate(state_.first.acceleration, glance_.held);
  }
  if constexpr (RelaxesStages<M>) {
    glance_.mean = glance_.acceleration;
    mechanism_.relax(whole_step(), 0.5, state_.first.load, {}, glance_.mean);
  }
  return glance_;
}

// From the last node to t in a copy: the body by its acceleration, the air by Heun's rule in as
// many pieces as a step would take. What cuts its steps is integrated, and an instant before the
// last node sees what was prescribed then.
template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::peek(double t) noexcept -> Peek {
  Peek p{.state = state_.now, .look = state_.first};
  if constexpr (CutsSteps<M>) {
    Memory memory = state_.memory;
    glance_.held = state_.held;
    if (!state_.failure) go(state_.time, t, p.state, memory, glance_.held, p.look);
    begin_part(t, p.state, memory, glance_.held, p.look);
    glance_.acceleration = p.look.acceleration;
  } else {
    (void)glance();
    if (t > state_.time && !state_.failure) extrapolate(t, p);
  }
  return p;
}

template <IsMechanism M, IsAirOf<M> A>
template <WholeSteps>
void World<M, A>::extrapolate(double t, Peek& p) noexcept {
  const double dt = t - state_.time;
  const double pieces = pieces_of(dt, state_.first), h = dt / pieces;
  for (double k = 1; k <= pieces; ++k) {
    const double to = k < pieces ? state_.time + k * h : t;
    p.state.motion = peek_motion(to);
    if (air_.flowing(state_.valves)) {
      const typename A::State from = p.state.air;
      const typename A::Answer before = p.look.air;
      typename A::Course course;
      air_.plan(to - h, h, p.look.ends, from, state_.valves, state_.memory, course);
      air_.move(p.state.air, from, h, before, state_.valves, course);
      evaluate_air(to, p.state, state_.memory, p.look, course.muscles);
      air_.correct(p.state.air, from, h, before, p.look.air, state_.valves, course);
    }
    evaluate_air(to, p.state, state_.memory, p.look, air_.always_ahead(state_.valves));
  }
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= senses_.channels()) return signals::Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::drive(signals::Edge edge) noexcept {
  if (state_.ended) return signals::Status::ended;
  if (state_.failure) return signals::Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= air_.valves() || t < state_.time) return signals::Status::invalid;
  while (!state_.failure && next_node() < t)
    commit();  // later edges act at t or after: these nodes are final
  air_.command(edge, t, state_.first.air, state_.valves);
  return signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
signals::Reading World<M, A>::read(signals::Channel channel, signals::Tick now) noexcept {
  return reading(*this, senses_, channel, now - lag_[channel.index]);
}

template <IsMechanism M, IsAirOf<M> A>
signals::Status World<M, A>::stop(signals::Tick) noexcept {
  state_.ended = true;  // nothing moves a simulated body after its last tick
  return state_.failure ? signals::Status::fault : signals::Status::ok;
}

template <IsMechanism M, IsAirOf<M> A>
auto World<M, A>::truth(double t) noexcept -> Truth {
  advance(t);
  return senses_.truth(*this, std::max(t, state_.time));
}

}  // namespace sinew::plant
