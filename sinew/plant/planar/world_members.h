// plant/planar/world_members.h - the members of World, for the files that compile its kinds once
// (chain_worlds.cpp, body_worlds.cpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sinew/plant/planar/world.h"

namespace sinew::plant {

template <class M, class A>
World<M, A>::World(const Setup& setup)
    : mechanism_(setup),
      air_(setup.muscles, setup.air, setup.supply, setup.cylinder, setup.faults),
      robot_(setup.robot),
      atmosphere_(setup.air.atmosphere),
      step_(mechanism_.stable_step(setup.steps.body)),
      seed_(setup.seed) {
  using Kind = robot::Sensor::Kind;
  for (std::size_t s = 0; s < robot_.sensors.size() && s < source_.size(); ++s) {
    const robot::Sensor& sensor = robot_.sensors[s];
    const bool joint = sensor.kind == Kind::angle || sensor.kind == Kind::velocity;
    source_[s] =
        joint ? robot::find_joint(robot_, sensor.of) : robot::find_muscle(robot_, sensor.of);
  }
  static_assert(std::is_trivially_copyable_v<State>);
  Look& first = state_.first;
  state_.now.motion = mechanism_.start();
  mechanism_.route(state_.now.motion, first.ends, first.arms);
  state_.now.air = air_.initial(setup.start.pressure, first.ends.length, setup.start.lift);
  state_.valves = air_.valves_at_rest();
  state_.memory = air_.memory_at_rest(setup.start.pressure, first.ends.length);
  prepare();
}

// One evaluation of the right-hand side, with the frictions held.
template <class M, class A>
void World<M, A>::look_at(double t, const Moving& state, const Forces& held,
                          Look& look) const noexcept {
  evaluate_air(t, state, look);
  const typename M::Pose pose = mechanism_.pose(state.motion);
  mechanism_.load(pose, state.motion, look.arms, look.air, look.load);
  look.acceleration = mechanism_.accelerate(pose, state.motion, look.load, held);
}

// A new node: valves and references, the first stage, and what friction can do about it.
template <class M, class A>
void World<M, A>::prepare() noexcept {
  Look& first = state_.first;
  air_.move_valves(state_.time, state_.first.air, state_.valves);
  evaluate_air(state_.time, state_.now, first);
  look_for_failure();
  const typename M::Pose pose = mechanism_.pose(state_.now.motion);
  mechanism_.load(pose, state_.now.motion, first.arms, first.air, first.load);
  state_.trolley_bound = mechanism_.trolley_bound(state_.held, state_.trolley_bound);
  first.acceleration = prepare_friction(pose);
}

// The friction problem of the node, and the accelerations without friction.
template <class M, class A>
auto World<M, A>::prepare_friction(const typename M::Pose& pose) noexcept -> Acceleration {
  const Look& first = state_.first;
  glanced_ = false;
  return mechanism_.prepare(pose, state_.now.motion, first.arms, first.air.mesh,
                            state_.trolley_bound, first.load);
}

template <class M, class A>
void World<M, A>::restore(const State& state) noexcept {
  state_ = state;
  (void)prepare_friction(mechanism_.pose(state_.now.motion));
}

// Is anything of the look at a node no number? The air also takes from the look what it remembers.
template <class M, class A>
void World<M, A>::look_for_failure() noexcept {
  const muscle::Failure of_air = air_.remember(state_.first.air, state_.now.air, state_.memory);
  if (state_.failure) return;
  if (of_air) {
    state_.failure = of_air;
    state_.failure.time = state_.time;
    if (of_air.of == muscle::Failure::Of::air)
      state_.failure.length = state_.first.ends.length[of_air.muscle];
  } else if (!muscle::is_place(mechanism_.sum(state_.now.motion))) {
    state_.failure = {.of = muscle::Failure::Of::motion, .time = state_.time};
  }
}

// While nothing flows there is nothing to be quick.
template <class M, class A>
double World<M, A>::pieces_of(double h, const Look& look) const noexcept {
  if (!air_.flowing(state_.valves)) return 1.0;
  const double longest = air_.longest_step(look.ends, state_.valves);
  return h > longest ? std::min(std::ceil(h / longest), most_pieces) : 1.0;
}

// Hoses, walls and lags can be quicker than the body: a step is then made of several pieces, under
// the friction of the whole.
template <class M, class A>
void World<M, A>::step(double h) noexcept {
  state_.held = mechanism_.hold(h, state_.held);
  Acceleration first = mechanism_.accelerate(state_.first.acceleration, state_.held);
  const double pieces = pieces_of(h, state_.first);
  for (double k = 0; k < pieces; ++k) {
    const double from = state_.time + k * (h / pieces);
    if (k > 0) {
      look_at(from, state_.now, state_.held, state_.first);
      air_.remember(state_.first.air, state_.now.air, state_.memory);
      first = state_.first.acceleration;
    }
    piece(from, h / pieces, first);
  }
}

template <class M, class A>
void World<M, A>::piece(double from, double h, const Acceleration& first) noexcept {
  // The first stage is the look at hand; two to four stand at 1/2, 1/2 and 1.
  Moving& now = state_.now;
  Look later[3];
  Moving stage[3];
  const Motion* motion[4] = {&now.motion, &stage[0].motion, &stage[1].motion, &stage[2].motion};
  const typename A::Answer* air[4] = {&state_.first.air, &later[0].air, &later[1].air,
                                      &later[2].air};
  Acceleration acceleration[4] = {first};
  for (int s = 0; s < 3; ++s) {
    const double part = s == 2 ? h : 0.5 * h;
    mechanism_.move(stage[s].motion, now.motion, part, *motion[s], acceleration[s]);
    air_.move(stage[s].air, now.air, part, *air[s], state_.valves);
    look_at(from + part, stage[s], state_.held, later[s]);
    acceleration[s + 1] = later[s].acceleration;
  }

  const Motion rates = now.motion;  // of the first stage: the state moves
  motion[0] = &rates;
  mechanism_.finish(now.motion, h, motion, acceleration);
  air_.finish(now.air, h, air, state_.valves);
}

// The next multiple of the body step, or the next change of a valve.
template <class M, class A>
double World<M, A>::next_node() const noexcept {
  const double multiple = static_cast<double>(state_.multiple + 1) * step_;
  const double change = state_.valves.next_change;
  return change < multiple ? change : multiple;
}

template <class M, class A>
void World<M, A>::advance(double t) noexcept {
  while (!state_.failure && next_node() <= t) commit();
}

template <class M, class A>
void World<M, A>::commit() noexcept {
  const double next = next_node(), h = next - state_.time;
  if (h > 0) step(h);
  state_.time = next > state_.time ? next : state_.time;
  if (next >= static_cast<double>(state_.multiple + 1) * step_) ++state_.multiple;
  ++state_.nodes;
  prepare();
}

// The friction that a whole body step from the last node would have: what a peek goes by, however
// far it looks, so that it depends on the node alone.
template <class M, class A>
auto World<M, A>::glance() noexcept -> const Glance& {
  if (glanced_) return glance_;
  glanced_ = true;
  glance_.held = mechanism_.hold(step_, state_.held);
  glance_.acceleration = mechanism_.accelerate(state_.first.acceleration, glance_.held);
  return glance_;
}

// From the last node to t in a copy: the body by its acceleration, the air by Heun's rule in as
// many pieces as a step would take.
template <class M, class A>
auto World<M, A>::peek(const Glance& g, double t) const noexcept -> Peek {
  Peek p{.state = state_.now, .look = state_.first};
  const double dt = t - state_.time;
  if (dt <= 0 || state_.failure) return p;
  const double pieces = pieces_of(dt, state_.first), h = dt / pieces;
  for (double k = 1; k <= pieces; ++k) {
    const double to = k < pieces ? state_.time + k * h : t;
    p.state.motion = peek_motion(g, to);
    if (air_.flowing(state_.valves)) {
      const typename A::State from = p.state.air;
      const typename A::Answer before = p.look.air;
      air_.move(p.state.air, from, h, before, state_.valves);
      evaluate_air(to, p.state, p.look);
      air_.correct(p.state.air, from, h, before, p.look.air, state_.valves);
    }
    evaluate_air(to, p.state, p.look);
  }
  return p;
}

// Returns the force on a gauge in the cord [N]: the muscle's tension and its share of the mesh's
// friction at the joint that it belongs to.
template <class M, class A>
double World<M, A>::gauge(const Glance& g, const Peek& p, int muscle) const noexcept {
  const auto j = static_cast<std::size_t>(mechanism_.joint(muscle));
  double f = p.look.air.tension[muscle];
  const double mesh = state_.first.air.mesh[muscle], bound = mechanism_.bound(static_cast<int>(j));
  if (mesh > 0 && bound > 0) {
    const double share = g.held[j] * mesh / bound;
    f += mechanism_.arm(state_.first.arms, muscle) > 0 ? share : -share;
  }
  return f < 0 ? 0.0 : f;  // not a number stays what it is
}

template <class M, class A>
signals::Status World<M, A>::start(const signals::Scan& scan) noexcept {
  for (const signals::Conversion& c : scan.conversions) {
    if (c.channel.index >= robot_.sensors.size()) return signals::Status::invalid;
    lag_[c.channel.index] = c.read - c.start;
  }
  return signals::Status::ok;
}

template <class M, class A>
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

// Returns the quantity that the sensor measures at t, in SI; of something that stands still, 0.
template <class M, class A>
double World<M, A>::quantity(std::size_t index, double t) noexcept {
  using Kind = robot::Sensor::Kind;
  const Kind kind = robot_.sensors[index].kind;
  const int of = source_[index];
  if (kind == Kind::fixed || (of < 0 && kind != Kind::cylinder)) return 0;
  advance(t);
  const Glance& g = glance();
  const auto j = static_cast<std::size_t>(of < 0 ? 0 : of);
  if (kind == Kind::angle)
    return mechanism_.joint_angle(peek_motion(g, t), j) - robot_.joints[j].rest_angle;
  if (kind == Kind::velocity) return mechanism_.joint_rate(peek_motion(g, t), j);
  if (kind == Kind::cylinder) return mechanism_.lift(peek_motion(g, t));
  const Peek p = peek(g, t);
  const double gauged = p.look.air.pressure[of] - atmosphere_;
  if (kind == Kind::pressure || !std::isfinite(gauged)) return gauged;  // air that ran away too
  return gauge(g, p, of);
}

template <class M, class A>
signals::Reading World<M, A>::read(signals::Channel channel, signals::Tick now) noexcept {
  const robot::Sensor& sensor = robot_.sensors[channel.index];
  const signals::Tick sampled = now - lag_[channel.index];
  const double value =
      quantity(channel.index, static_cast<double>(sampled) * signals::tick_seconds);
  // A state that ran away never comes back: every later reading says so too.
  if (state_.failure || !std::isfinite(value)) return {0, signals::Status::fault};
  const double hiss = sensor.noise > 0 ? robot::noise(seed_, channel.index, sampled) : 0.0;
  return {counts(sensor, robot_.converter, value, hiss),
          state_.ended ? signals::Status::ended : signals::Status::ok};
}

template <class M, class A>
signals::Status World<M, A>::stop(signals::Tick) noexcept {
  state_.ended = true;  // nothing moves a simulated body after its last tick
  return state_.failure ? signals::Status::fault : signals::Status::ok;
}

template <class M, class A>
Truth World<M, A>::truth(double t) noexcept {
  advance(t);
  const Glance& g = glance();
  const Peek p = peek(g, t);

  Truth out;
  for (int i = 0; i < mechanism_.muscles(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const muscle::Account account = air_.account(p.state.air, i);
    out.tension[k] = gauge(g, p, i);
    out.pressure[k] = p.look.air.pressure[i];
    out.length[k] = p.look.ends.length[i];
    out.mass[k] = account.mass;
    out.air_in[k] = account.in;
    out.air_out[k] = account.out;
    out.air_leaked[k] = account.leak;
    mechanism_.add_torque(p.look.arms, i, out.tension[k], out.torque);
  }
  const muscle::SupplyState supply = air_.supply_state(p.state.air, p.look.air);
  out.supply_pressure = supply.line;
  out.tank_pressure = supply.tank;
  out.air_past_tank = supply.past_tank;
  out.air_mass = air_.total_mass(p.state.air, p.look.ends.travel);
  for (int c = 0; c < 2; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const muscle::Account account = air_.cylinder_account(p.state.air, c);
    out.cylinder_pressure[k] = air_.cylinder_pressure(p.look.air, c);
    out.cylinder_in[k] = account.in;
    out.cylinder_out[k] = account.out;
  }
  mechanism_.tell(p.state.motion, g.acceleration, g.held, state_.first.load, out);
  return out;
}

}  // namespace sinew::plant
