// world/chain_lanes.h - W plain machines side by side: chains whose muscles are filled through
// valves from a constant supply. Each is a World, with the same bits as alone.
//
// The nodes are integrated in lanes (lane_nodes.h); readings extrapolate from the lanes; for rare
// operations a lane is copied to its World. Each machine has its own steps, edges and failures.
// They run in lockstep by node, not by time: a machine that waits is still computed in its lane,
// and the result is discarded.
//
//   run(loop)        runs all machines, each by its own loop: loop(k) is called whenever machine k
//                    has reached the instant that it returned last
//   advance(until)   commits every node up to each machine's own instant, many at once
//   drive, read, …   as in World, for machine k; a node that only this one needs is committed alone
//   world(k)         machine k as a World, for truths and saving. This call updates the World from
//                    its lane; after the World has advanced by itself, the lane is updated from it
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>

#include "sinew/world/chain_world.h"
#include "sinew/world/lane_nodes.h"

namespace sinew::plant {

template <int N, int W>
class ChainLanes {
  static constexpr auto lanes = static_cast<std::size_t>(W);

 public:
  using World = ChainWorld<N>;
  using Instants = std::array<double, lanes>;
  static constexpr int width = W;
  static constexpr double finished = std::numeric_limits<double>::infinity();

  // Returns whether this machine can be simulated side by side with others; alike() compares two.
  static bool fits(const Setup& setup);
  static bool alike(const Setup& a, const Setup& b) {
    return plant::alike(chain_routing_of(a.robot), chain_routing_of(b.robot));
  }

  // Throws std::invalid_argument if a machine is not supported or not like the first.
  explicit ChainLanes(std::span<const Setup, lanes> setups);

  // Commits every node of machine k up to until[k]  [s].
  void advance(const Instants& until) noexcept;

  // Runs the machines that are not parked. loop(k) runs machine k's loop as far as its nodes reach
  // and returns the instant up to which all its nodes can be committed [s], or `finished`: machine
  // k is then parked and its k returned. Returns -1 when all are parked.
  template <class Loop>
  int run(const Loop& loop) noexcept;
  void park(int k) noexcept { parked_[static_cast<std::size_t>(k)] = true; }
  // Continues a parked machine in the next run(), which calls its loop first.
  void resume(int k) noexcept {
    parked_[static_cast<std::size_t>(k)] = false;
    until_[static_cast<std::size_t>(k)] = -finished;
  }

  // Replaces machine k by another one at its start. Throws as the constructor does.
  void replace(int k, const Setup& setup);

  // The functions of Port and World, for machine k.
  signals::Status start(int k, const signals::Scan& scan) noexcept;
  signals::Status drive(int k, const signals::Edge& edge) noexcept;
  signals::Reading read(int k, signals::Channel channel, signals::Tick now) noexcept;
  signals::Status stop(int k) noexcept;
  Truth truth(int k, double t) noexcept;
  void advance(int k, double t) noexcept;
  const air::Failure& failure(int k) const noexcept {
    return failure_[static_cast<std::size_t>(k)];
  }
  std::int64_t nodes(int k) const noexcept { return times_[static_cast<std::size_t>(k)].nodes; }

  // Returns machine k as a World, updated from its lane.
  World& world(int k) noexcept;

  // Continues machine k from this state: its own, or one of a world with an equal setup.
  void restore(int k, const typename World::State& state) noexcept;

 private:
  using Integrated = LaneNodes<N, W>;
  using S = units::Pack<W>;
  using Mask = units::PackMask<W>;
  using Worlds = std::array<std::unique_ptr<World>, lanes>;

  // Machine k for its senses (planar/planar_mechanism.h): with the interface of World, from its
  // lane.
  class LaneView;

  [[noreturn]] static void refuse() {
    throw std::invalid_argument("machines that cannot go side by side");
  }
  static Worlds worlds_of(std::span<const Setup, lanes> setups);
  static ChainBody<N, S> bodies(const Worlds& worlds);
  static typename Integrated::Air airs(const Worlds& worlds);

  double next_node(int k) const noexcept;
  Mask only(int k) const noexcept;
  void update_lane(int k) noexcept;
  void update_step_preview(int k) noexcept;
  void commit(const Mask& active) noexcept;
  void move_valves(const Mask& active) noexcept;
  void note_failures(const Mask& active, const std::array<int, W>& failed) noexcept;
  template <class Packed, class One, class Put>
  void each_number(Packed& packed, One& one, const Put& put) const noexcept;
  void copy_to_lane(int k) noexcept;
  void copy_to_world(int k) noexcept;

  Worlds worlds_;
  Integrated nodes_of_all_;
  typename Integrated::State state_;

  // As World::State's, for each machine.
  std::array<NodeTimes, lanes> times_{};
  Instants step_{}, change_{};  // body steps; instants of the next valve changes [s]
  std::array<air::Failure, lanes> failure_{};
  std::array<bool, lanes> world_outdated_{};  // the machine's World is out of date

  typename Integrated::StepPreview step_preview_;  // whole steps, used by evaluations between nodes
  std::uint32_t has_step_preview_ = 0;  // it is valid for the node of these machines, a bit each
  Instants until_{};
  std::array<bool, lanes> parked_{};
};

template <int N, int W>
class ChainLanes<N, W>::LaneView {
 public:
  LaneView(ChainLanes& all, int k) : b_(all), k_(k), l_(static_cast<std::size_t>(k)) {}

  void advance(double t) noexcept { b_.advance(k_, t); }
  const air::Failure& failure() const noexcept { return b_.failure_[l_]; }
  bool ended() const noexcept { return b_.worlds_[l_]->ended(); }

  const ChainMechanism<N>& mechanism() const noexcept { return b_.worlds_[l_]->mechanism(); }
  typename ChainBody<N>::Arms arms() const noexcept { return {}; }
  double friction_bound(int muscle) const noexcept {
    return b_.state_.first.air.friction_bound[muscle][k_];
  }
  double bound(int contact) const noexcept { return b_.nodes_of_all_.body().bound(contact)[k_]; }

  GeneralizedState<N> preview_motion(double t) noexcept {
    b_.update_step_preview(k_);
    const auto a = units::lane_of<GeneralizedVector<N>>(b_.step_preview_.acceleration, k_);
    GeneralizedState<N> motion = units::lane_of<GeneralizedState<N>>(b_.state_.now.motion, k_);
    mechanism().extrapolate(motion, t - b_.times_[l_].time, a);
    return motion;
  }
  struct StepPreview {
    std::array<double, N + 2> held;
  };
  StepPreview step_preview() const noexcept {
    return {units::lane_of<std::array<double, N + 2>>(b_.step_preview_.held, k_)};
  }

  // The tension and pressure of one muscle; those of the others are not set.
  struct Preview {
    struct {
      struct {
        std::array<double, chain_muscles> tension, pressure;
      } air;
    } evaluation;
  };
  Preview preview_muscle(double t, int i) noexcept {
    const auto m = static_cast<std::size_t>(i);
    const auto& s = b_.state_;
    Preview p;
    b_.update_step_preview(k_);
    if (!(t > b_.times_[l_].time) || failure()) {
      p.evaluation.air.tension[m] = s.first.air.tension[i][k_];
      p.evaluation.air.pressure[m] = s.first.air.pressure[i][k_];
      return p;
    }
    typename ChainBody<N>::Ends ends;
    typename ChainBody<N>::Arms no_arms;
    mechanism().route(t, preview_motion(t), ends, no_arms);
    const auto muscle =
        b_.nodes_of_all_.air().preview(k_, i, ends.length[i], ends.rate[i], t - b_.times_[l_].time,
                                       s.now.air, s.valves, s.memory, s.first.air);
    p.evaluation.air.tension[m] = muscle.tension;
    p.evaluation.air.pressure[m] = muscle.pressure;
    return p;
  }

 private:
  ChainLanes& b_;
  int k_;
  std::size_t l_;
};

template <int N, int W>
bool ChainLanes<N, W>::fits(const Setup& setup) {
  if (!robot::is_chain(setup.robot) || setup.robot.joints.size() != N) return false;
  const air::AirNetwork<chain_muscles> air(setup.muscles, setup.air, setup.supply, setup.cylinder,
                                           setup.faults);
  return air.stays_plain();
}

template <int N, int W>
ChainLanes<N, W>::ChainLanes(std::span<const Setup, lanes> setups)
    : worlds_(worlds_of(setups)), nodes_of_all_(bodies(worlds_), airs(worlds_)) {
  for (int k = 0; k < W; ++k) copy_to_lane(k);
  until_.fill(-finished);
}

template <int N, int W>
auto ChainLanes<N, W>::worlds_of(std::span<const Setup, lanes> setups) -> Worlds {
  for (const Setup& s : setups)
    if (!fits(s) || !alike(s, setups[0])) refuse();
  Worlds worlds;
  for (std::size_t k = 0; k < W; ++k) worlds[k] = std::make_unique<World>(setups[k]);
  return worlds;
}

template <int N, int W>
void ChainLanes<N, W>::replace(int k, const Setup& setup) {
  const auto l = static_cast<std::size_t>(k);
  const auto other = worlds_[l == 0 && W > 1 ? 1 : 0]->mechanism().routes();
  if (!fits(setup) || !plant::alike(chain_routing_of(setup.robot), other)) refuse();
  worlds_[l] = std::make_unique<World>(setup);
  nodes_of_all_.body() = bodies(worlds_);
  nodes_of_all_.air() = airs(worlds_);
  copy_to_lane(k);
  until_[l] = -finished;
  parked_[l] = false;
}

template <int N, int W>
auto ChainLanes<N, W>::bodies(const Worlds& worlds) -> ChainBody<N, S> {
  std::array<const ChainBody<N>*, lanes> each;
  for (std::size_t k = 0; k < W; ++k) each[k] = &worlds[k]->mechanism();
  return side_by_side(each);
}

template <int N, int W>
auto ChainLanes<N, W>::airs(const Worlds& worlds) -> typename Integrated::Air {
  std::array<const air::AirNetwork<chain_muscles>*, lanes> each;
  for (std::size_t k = 0; k < W; ++k) each[k] = &worlds[k]->air();
  return typename Integrated::Air(each);
}

template <int N, int W>
double ChainLanes<N, W>::next_node(int k) const noexcept {
  const auto l = static_cast<std::size_t>(k);
  return times_[l].next(step_[l], 0, change_[l]);
}

template <int N, int W>
auto ChainLanes<N, W>::only(int k) const noexcept -> Mask {
  Mask mask = S(0.0) > 0.0;
  mask.set(k, true);
  return mask;
}

// Copies the World to its lane if it was driven or integrated by itself.
template <int N, int W>
void ChainLanes<N, W>::update_lane(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  if (world_outdated_[l]) return;
  change_[l] = worlds_[l]->state().valves.next_change;
  if (worlds_[l]->nodes() != times_[l].nodes) copy_to_lane(k);
}

template <int N, int W>
template <class Loop>
int ChainLanes<N, W>::run(const Loop& loop) noexcept {
  for (int k = 0; k < W; ++k) update_lane(k);
  for (;;) {
    Mask active = S(0.0) > 0.0;
    bool any = false;
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      if (parked_[l]) continue;
      while (failure_[l] || !(next_node(k) <= until_[l])) {
        until_[l] = loop(k);
        if (until_[l] < finished) continue;
        park(k);
        return k;
      }
      active.set(k, true);
      any = true;
    }
    if (!any) return -1;
    commit(active);
  }
}

template <int N, int W>
void ChainLanes<N, W>::advance(const Instants& until) noexcept {
  for (int k = 0; k < W; ++k) update_lane(k);
  for (;;) {
    Mask active = S(0.0) > 0.0;
    bool any = false;
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      const bool one = !failure_[l] && next_node(k) <= until[l];
      active.set(k, one);
      any = any || one;
    }
    if (!any) return;
    commit(active);
  }
}

template <int N, int W>
void ChainLanes<N, W>::advance(int k, double t) noexcept {
  update_lane(k);
  while (!failure_[static_cast<std::size_t>(k)] && next_node(k) <= t) commit(only(k));
}

// Commits the next node of the machines in `active`.
template <int N, int W>
void ChainLanes<N, W>::commit(const Mask& active) noexcept {
  S h = 0;
  Mask steps = active;
  bool any = false;
  for (int k = 0; k < W; ++k) {
    if (!active[k]) continue;
    const auto l = static_cast<std::size_t>(k);
    const double next = next_node(k);
    const bool later = next > times_[l].time;
    h.set(k, later ? next - times_[l].time : 0.0);
    steps.set(k, later);
    any = any || later;
    times_[l].pass(next, step_[l]);
    world_outdated_[l] = true;
    has_step_preview_ &= ~(1u << k);
  }
  if (any) nodes_of_all_.step(steps, h, state_);
  move_valves(active);
  std::array<int, W> failed;
  if (!nodes_of_all_.prepare(active, state_, failed)) note_failures(active, failed);
}

template <int N, int W>
void ChainLanes<N, W>::move_valves(const Mask& active) noexcept {
  for (int k = 0; k < W; ++k) {
    const auto l = static_cast<std::size_t>(k);
    if (!active[k] || change_[l] > times_[l].time) continue;
    typename World::State& s = worlds_[l]->mutable_state();
    worlds_[l]->air().move_valves(times_[l].time, s.first.air, s.valves);
    change_[l] = s.valves.next_change;
    nodes_of_all_.air().update_shares(k, s.valves, state_.valves);
  }
}

template <int N, int W>
void ChainLanes<N, W>::note_failures(const Mask& active,
                                     const std::array<int, W>& failed) noexcept {
  for (std::size_t k = 0; k < W; ++k) {
    const int lane = static_cast<int>(k);
    if (!active[lane]) continue;
    double places = state_.now.motion.x[lane];
    for (int j = 0; j < N; ++j) places += state_.now.motion.angle[j][lane];
    if (failed[k] >= 0)
      failure_[k] = {.of = air::Failure::Of::air,
                     .muscle = failed[k],
                     .length = state_.first.ends.length[failed[k]][lane],
                     .time = times_[k].time};
    else if (!air::is_position(places))
      failure_[k] = {.of = air::Failure::Of::motion, .time = times_[k].time};
  }
}

// Computes the friction of a whole step from each machine's node, for all lanes when any requires
// it.
template <int N, int W>
void ChainLanes<N, W>::update_step_preview(int k) noexcept {
  if ((has_step_preview_ >> k & 1u) != 0) return;
  S h;
  for (int i = 0; i < W; ++i) h.set(i, step_[static_cast<std::size_t>(i)]);
  nodes_of_all_.preview_step(h, state_, step_preview_);
  has_step_preview_ = (1u << W) - 1;
}

template <int N, int W>
signals::Status ChainLanes<N, W>::start(int k, const signals::Scan& scan) noexcept {
  return worlds_[static_cast<std::size_t>(k)]->start(scan);
}

template <int N, int W>
signals::Status ChainLanes<N, W>::drive(int k, const signals::Edge& edge) noexcept {
  const auto l = static_cast<std::size_t>(k);
  World& world = *worlds_[l];
  update_lane(k);
  if (world.ended()) return signals::Status::ended;
  if (failure_[l]) return signals::Status::fault;
  const double t = static_cast<double>(edge.at) * signals::tick_seconds;
  if (edge.valve.index >= world.air().valves() || t < times_[l].time)
    return signals::Status::invalid;
  while (!failure_[l] && next_node(k) < t) commit(only(k));
  typename World::State& s = world.mutable_state();
  if (const int muscle = edge.valve.index / 2; muscle < nodes_of_all_.air().muscles())
    s.first.air.pressure[muscle] = state_.first.air.pressure[muscle][k];
  world.air().command(edge, t, s.first.air, s.valves);
  change_[l] = s.valves.next_change;
  return signals::Status::ok;
}

template <int N, int W>
signals::Reading ChainLanes<N, W>::read(int k, signals::Channel channel,
                                        signals::Tick now) noexcept {
  const World& world = *worlds_[static_cast<std::size_t>(k)];
  LaneView view(*this, k);
  return reading(view, world.senses(), channel, now - world.lag(channel));
}

template <int N, int W>
signals::Status ChainLanes<N, W>::stop(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  worlds_[l]->mutable_state().ended = true;
  return failure_[l] ? signals::Status::fault : signals::Status::ok;
}

template <int N, int W>
Truth ChainLanes<N, W>::truth(int k, double t) noexcept {
  advance(k, t);
  return world(k).truth(t);
}

template <int N, int W>
auto ChainLanes<N, W>::world(int k) noexcept -> World& {
  const auto l = static_cast<std::size_t>(k);
  if (world_outdated_[l]) copy_to_world(k);
  world_outdated_[l] = false;
  return *worlds_[l];
}

template <int N, int W>
void ChainLanes<N, W>::restore(int k, const typename World::State& state) noexcept {
  worlds_[static_cast<std::size_t>(k)]->restore(state);
  copy_to_lane(k);
}

// Calls put(values of all lanes, values of one) for each per-muscle array of a lane and a World.
template <int N, int W>
template <class Packed, class One, class Put>
void ChainLanes<N, W>::each_number(Packed& packed, One& one, const Put& put) const noexcept {
  each_of_air(packed.now.air, one.now.air, put);
  each_of_evaluation(packed.first, one.first, put);
  put(packed.memory.y, one.memory.reference.y);
  put(packed.memory.inverse_sigma, one.memory.reference.inverse_sigma);
}

// Copies the World to its lane.
template <int N, int W>
void ChainLanes<N, W>::copy_to_lane(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  const typename World::State& s = worlds_[l]->state();
  units::put_lane(s.now.motion, k, state_.now.motion);
  units::put_lane(s.held, k, state_.held);
  state_.trolley_bound.set(k, s.trolley_bound);
  each_number(state_, s, [&](auto& packed, const auto& one) {
    for (int i = 0; i < nodes_of_all_.air().muscles(); ++i) packed[i].set(k, one[i]);
  });
  nodes_of_all_.air().set_shares(k, s.valves, state_.valves);
  times_[l] = s.times;
  change_[l] = s.valves.next_change;
  step_[l] = worlds_[l]->body_step();
  failure_[l] = s.failure;
  world_outdated_[l] = false;
  has_step_preview_ &= ~(1u << k);
  nodes_of_all_.prepare_friction(state_);
}

// Copies the lane to its World.
template <int N, int W>
void ChainLanes<N, W>::copy_to_world(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  typename World::State& s = worlds_[l]->mutable_state();
  s.now.motion = units::lane_of<GeneralizedState<N>>(state_.now.motion, k);
  s.held = units::lane_of<typename ChainBody<N>::Forces>(state_.held, k);
  s.trolley_bound = state_.trolley_bound[k];
  each_number(state_, s, [&](const auto& packed, auto& one) {
    for (int i = 0; i < nodes_of_all_.air().muscles(); ++i) one[i] = packed[i][k];
  });
  s.times = times_[l];
  s.failure = failure_[l];
  worlds_[l]->continue_from_state();
}

}  // namespace sinew::plant
