// world/packs/chain_batch_members.h - the members of ChainBatch, for the files that compile it.
#pragma once

#include "sinew/world/packs/chain_batch.h"

namespace sinew::plant {

namespace detail {

// Puts the new numbers in the lanes of the mask.
template <class Mask, int N, class S>
void blend(const Mask& mask, const GeneralizedState<N, S>& from, GeneralizedState<N, S>& to) {
  to.x = units::select(mask, from.x, to.x);
  to.x_rate = units::select(mask, from.x_rate, to.x_rate);
  for (int i = 0; i < N; ++i) {
    to.angle[i] = units::select(mask, from.angle[i], to.angle[i]);
    to.rate[i] = units::select(mask, from.rate[i], to.rate[i]);
  }
}

// visit(a's, b's) for each number of the muscles in a look, and in a state of the air.
template <class LookA, class LookB, class Visit>
void each_of_look(LookA& a, LookB& b, const Visit& visit) {
  visit(a.ends.length, b.ends.length);
  visit(a.ends.rate, b.ends.rate);
  visit(a.air.tension, b.air.tension);
  visit(a.air.clamped, b.air.clamped);
  visit(a.air.pressure, b.air.pressure);
  visit(a.air.friction_bound, b.air.friction_bound);
  visit(a.air.drift, b.air.drift);
  visit(a.air.inflow, b.air.inflow);
  visit(a.air.outflow, b.air.outflow);
}
template <class AirA, class AirB, class Visit>
void each_of_air(AirA& a, AirB& b, const Visit& visit) {
  visit(a.mass, b.mass);
  visit(a.in, b.in);
  visit(a.out, b.out);
}

}  // namespace detail

template <int N, int W>
bool ChainBatch<N, W>::holds(const Setup& setup) {
  if (!robot::is_chain(setup.robot) || setup.robot.joints.size() != N) return false;
  const air::AirNetwork<chain_muscles> air(setup.muscles, setup.air, setup.supply, setup.cylinder,
                                           setup.faults);
  return air.plain_for_good();
}

template <int N, int W>
ChainBatch<N, W>::ChainBatch(std::span<const Setup, static_cast<std::size_t>(W)> setups)
    : worlds_(worlds_of(setups)), body_(side_by_side(bodies(worlds_))), air_(airs(worlds_)) {
  for (int k = 0; k < W; ++k) take(k);
  until_.fill(-over);
}

template <int N, int W>
auto ChainBatch<N, W>::worlds_of(std::span<const Setup, static_cast<std::size_t>(W)> setups)
    -> Worlds {
  for (const Setup& s : setups)
    if (!holds(s) || !alike(s, setups[0])) refuse();
  Worlds worlds;
  for (std::size_t k = 0; k < W; ++k) worlds[k] = std::make_unique<World>(setups[k]);
  return worlds;
}

template <int N, int W>
void ChainBatch<N, W>::refuse() {
  throw std::invalid_argument("machines that cannot go side by side");
}

template <int N, int W>
void ChainBatch<N, W>::replace(int k, const Setup& setup) {
  const auto l = static_cast<std::size_t>(k);
  const auto other = worlds_[l == 0 && W > 1 ? 1 : 0]->mechanism().routes();
  if (!holds(setup) || !plant::alike(chain_routing_of(setup.robot), other)) refuse();
  worlds_[l] = std::make_unique<World>(setup);
  body_ = side_by_side(bodies(worlds_));
  air_ = Air(airs(worlds_));
  take(k);
  until_[l] = -over;
  parked_[l] = false;
}

template <int N, int W>
std::array<const ChainBody<N>*, W> ChainBatch<N, W>::bodies(const Worlds& worlds) {
  std::array<const ChainBody<N>*, W> out;
  for (std::size_t k = 0; k < W; ++k) out[k] = &worlds[k]->mechanism();
  return out;
}

template <int N, int W>
std::array<const air::AirNetwork<chain_muscles>*, W> ChainBatch<N, W>::airs(const Worlds& worlds) {
  std::array<const air::AirNetwork<chain_muscles>*, W> out;
  for (std::size_t k = 0; k < W; ++k) out[k] = &worlds[k]->air();
  return out;
}

template <int N, int W>
double ChainBatch<N, W>::next_node(int k) const noexcept {
  const auto l = static_cast<std::size_t>(k);
  const double multiple = static_cast<double>(multiple_[l] + 1) * step_[l];
  return change_[l] < multiple ? change_[l] : multiple;
}

template <int N, int W>
void ChainBatch<N, W>::advance(const Instants& until) noexcept {
  for (int k = 0; k < W; ++k) follow(k);
  for (;;) {
    Mask goes = S(0.0) > 0.0;
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      goes.set(k, !failure_[l] && next_node(k) <= until[l]);
    }
    if (!units::any(goes)) return;
    commit(goes);
  }
}

// The next node of the machines that go.
template <int N, int W>
void ChainBatch<N, W>::commit(const Mask& goes) noexcept {
  S h = 0;
  Instants next{};
  for (int k = 0; k < W; ++k) {
    if (!goes[k]) continue;
    const auto l = static_cast<std::size_t>(k);
    next[l] = next_node(k);
    h.set(k, next[l] > time_[l] ? next[l] - time_[l] : 0.0);
  }
  if (const Mask steps = h > 0.0; units::any(steps)) step(steps, h);
  for (int k = 0; k < W; ++k) {
    if (!goes[k]) continue;
    const auto l = static_cast<std::size_t>(k);
    if (next[l] >= static_cast<double>(multiple_[l] + 1) * step_[l]) ++multiple_[l];
    time_[l] = next[l] > time_[l] ? next[l] : time_[l];
    ++nodes_[l];
    behind_[l] = true;
    glanced_[l] = false;
  }
  prepare(goes);
}

// RK4 under the friction of the step. Lanes that do not step keep what they have.
template <int N, int W>
void ChainBatch<N, W>::step(const Mask& steps, const S& h) noexcept {
  const typename Body::Forces held = body_.hold(h, held_);
  for (std::size_t c = 0; c < held.size(); ++c) held_[c] = units::select(steps, held[c], held_[c]);

  Look later[3];
  Moving stage[3];
  const typename Body::Motion* motion[4] = {&now_.motion, &stage[0].motion, &stage[1].motion,
                                            &stage[2].motion};
  const typename Air::Answer* air[4] = {&first_.air, &later[0].air, &later[1].air, &later[2].air};
  typename Body::Acceleration acceleration[4] = {body_.accelerate(first_.acceleration, held_)};
  for (int s = 0; s < 3; ++s) {
    const S part = s == 2 ? h : 0.5 * h;
    body_.move(stage[s].motion, now_.motion, part, *motion[s], acceleration[s]);
    air_.move(stage[s].air, now_.air, part, *air[s]);
    look_at(stage[s], held_, later[s]);
    acceleration[s + 1] = later[s].acceleration;
  }

  if (units::all(steps)) {  // each number's rate is read before it moves
    body_.finish(now_.motion, h, motion, acceleration);
    air_.finish(now_.air, h, air);
    return;
  }
  Moving after = now_;
  body_.finish(after.motion, h, motion, acceleration);
  air_.finish(after.air, h, air);
  detail::blend(steps, after.motion, now_.motion);
  detail::each_of_air(after.air, now_.air, blend_onto(steps));
}

template <int N, int W>
void ChainBatch<N, W>::look_at(const Moving& state, const typename Body::Forces& held,
                               Look& look) const noexcept {
  typename Body::Arms arms;
  body_.route(0, state.motion, look.ends, arms);
  air_.evaluate(look.ends, state.air, shares_, memory_, look.air);
  const typename Body::Pose pose = body_.pose(0, state.motion);
  body_.load(pose, state.motion, arms, look.air, look.load);
  look.acceleration = body_.accelerate(pose, state.motion, look.load, held);
}

// A new node of the machines that go: valves and references, the first stage, friction. What the
// others' first stage says, said before their references followed, stays.
template <int N, int W>
void ChainBatch<N, W>::prepare(const Mask& goes) noexcept {
  for (int k = 0; k < W; ++k) {
    const auto l = static_cast<std::size_t>(k);
    if (!goes[k] || change_[l] > time_[l]) continue;
    typename World::State& s = worlds_[l]->borrow();
    worlds_[l]->air().move_valves(time_[l], s.first.air, s.valves);
    change_[l] = s.valves.next_change;
    air_.set_shares(k, s.valves, shares_);
  }
  const bool all = units::all(goes);
  typename Body::Arms arms;
  Look other;
  Look& look = all ? first_ : other;
  body_.route(0, now_.motion, look.ends, arms);
  air_.evaluate(look.ends, now_.air, shares_, memory_, look.air);
  if (!all) detail::each_of_look(look, first_, blend_onto(goes));
  look_for_failures(goes);
  trolley_bound_ = units::select(goes, body_.trolley_bound(held_, trolley_bound_), trolley_bound_);
  prepare_friction();
}

// From the same numbers the same problem: of those that wait nothing changes.
template <int N, int W>
void ChainBatch<N, W>::prepare_friction() noexcept {
  const typename Body::Pose pose = body_.pose(0, now_.motion);
  body_.load(pose, now_.motion, {}, first_.air, first_.load);
  first_.acceleration =
      body_.prepare(pose, now_.motion, {}, first_.air.friction_bound, trolley_bound_, first_.load);
}

template <int N, int W>
void ChainBatch<N, W>::look_for_failures(const Mask& goes) noexcept {
  const std::array<int, W> none = air_.remember(goes, first_.air, memory_);
  const S sum = body_.sum(now_.motion);
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    if (!goes[lane]) continue;
    if (none[k] >= 0)
      failure_[k] = {.of = air::Failure::Of::air,
                     .muscle = none[k],
                     .length = first_.ends.length[none[k]][lane],
                     .time = time_[k]};
    else if (!air::is_place(sum[lane]))
      failure_[k] = {.of = air::Failure::Of::motion, .time = time_[k]};
  }
}

template <int N, int W>
auto ChainBatch<N, W>::world(int k) noexcept -> World& {
  const auto l = static_cast<std::size_t>(k);
  if (behind_[l]) bring(k);
  behind_[l] = false;
  return *worlds_[l];
}

template <int N, int W>
void ChainBatch<N, W>::restore(int k, const typename World::State& state) noexcept {
  worlds_[static_cast<std::size_t>(k)]->restore(state);
  take(k);
}

// The lane follows its World.
template <int N, int W>
void ChainBatch<N, W>::take(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  const typename World::State& s = worlds_[l]->state();
  units::put_lane(s.now.motion, k, now_.motion);
  units::put_lane(s.held, k, held_);
  trolley_bound_.set(k, s.trolley_bound);
  const auto put = [&](auto& packed, const auto& one) {
    for (int i = 0; i < air_.muscles(); ++i) packed[i].set(k, one[i]);
  };
  detail::each_of_air(now_.air, s.now.air, put);
  detail::each_of_look(first_, s.first, put);
  put(memory_.y, s.memory.reference.y);
  put(memory_.inverse_sigma, s.memory.reference.inverse_sigma);
  air_.set_shares(k, s.valves, shares_);
  time_[l] = s.time;
  change_[l] = s.valves.next_change;
  step_[l] = worlds_[l]->body_step();
  multiple_[l] = s.multiple;
  nodes_[l] = s.nodes;
  failure_[l] = s.failure;
  behind_[l] = false;
  glanced_[l] = false;
  prepare_friction();
}

// The World follows its lane.
template <int N, int W>
void ChainBatch<N, W>::bring(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  typename World::State& s = worlds_[l]->borrow();
  s.now.motion = units::lane_of<GeneralizedState<N>>(now_.motion, k);
  s.held = units::lane_of<typename ChainBody<N>::Forces>(held_, k);
  s.trolley_bound = trolley_bound_[k];
  const auto put = [&](const auto& packed, auto& one) {
    for (int i = 0; i < air_.muscles(); ++i) one[i] = packed[i][k];
  };
  detail::each_of_air(now_.air, s.now.air, put);
  detail::each_of_look(first_, s.first, put);
  put(memory_.y, s.memory.reference.y);
  put(memory_.inverse_sigma, s.memory.reference.inverse_sigma);
  s.first.load = units::lane_of<typename ChainBody<N>::Load>(first_.load, k);
  s.first.acceleration = units::lane_of<GeneralizedVector<N>>(first_.acceleration, k);
  s.time = time_[l];
  s.multiple = multiple_[l];
  s.nodes = nodes_[l];
  s.failure = failure_[l];
  worlds_[l]->resume();
}

}  // namespace sinew::plant
