// world/chain_lanes.h - W plain machines side by side (lane_events.h), with the bits that each has
// alone. Each machine also has a World, to which its lane is copied for rare operations, such as
// saving.
//
//   run(loop)        runs all machines, each by its own loop: loop(k) is called whenever machine k
//                    has reached the instant that loop(k) returned last
//   advance(until)   commits the nodes of all machines together, each up to an instant of its own
//   drive, read, …   as in World, for machine k; they commit the nodes of machine k alone
//   world(k)         the World of machine k, updated from its lane. If the World then advances by
//                    itself, the next call of another function updates the lane from it
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "sinew/world/chain_world.h"
#include "sinew/world/lane_events.h"

namespace sinew::plant {

// Parts of the machines that are not in lanes: a World each. Its valves are always up to date; its
// motion is not, until ChainLanes::world() copies it from the lane.
template <int N, int W>
class LaneWorlds {
  static constexpr auto lanes = static_cast<std::size_t>(W);

 public:
  using World = ChainWorld<N>;

  // Makes a World of each machine.
  explicit LaneWorlds(std::span<const Setup, lanes> setups) {
    for (std::size_t k = 0; k < lanes; ++k) of_[k] = std::make_unique<World>(setups[k]);
  }

  // The functions that lane_events.h calls.
  const ChainMechanism<N>& mechanism(int k) const noexcept { return world(k).mechanism(); }
  const PlanarSenses& senses(int k) const noexcept { return world(k).senses(); }
  signals::Tick lag(int k, signals::Channel channel) const noexcept {
    return world(k).lag(channel);
  }
  bool ended(int k) const noexcept { return world(k).ended(); }
  void end(int k) noexcept { world(k).mutable_state().ended = true; }

  // Return the positions of the machine's valves, and their number.
  const air::AirValves<chain_muscles>& valves(int k) const noexcept {
    return world(k).state().valves;
  }
  int valve_count(int k) const noexcept { return world(k).air().valves(); }
  // Applies an edge; `pressure`: that of the valve's muscle at the node [Pa].
  void command(int k, const signals::Edge& edge, double t, double pressure) noexcept {
    typename World::State& s = world(k).mutable_state();
    if (const int muscle = edge.valve.index / 2; muscle < world(k).air().muscles())
      s.first.air.pressure[muscle] = pressure;
    world(k).air().command(edge, t, s.first.air, s.valves);
  }
  void move_valves(int k, double t) noexcept {
    typename World::State& s = world(k).mutable_state();
    world(k).air().move_valves(t, s.first.air, s.valves);
  }
  air::SupplyState supply(int k) const noexcept {
    const typename World::State& s = world(k).state();
    return world(k).air().supply_state(s.now.air, s.first.air);
  }

  // moves() notes that the lane has advanced, updated() that its World is up to date again;
  // is_outdated() returns whether the World is not.
  void moves(int k) noexcept { outdated_[static_cast<std::size_t>(k)] = true; }
  bool is_outdated(int k) const noexcept { return outdated_[static_cast<std::size_t>(k)]; }
  void updated(int k) noexcept { outdated_[static_cast<std::size_t>(k)] = false; }

  // Return the World of a lane, and replace it by that of another machine.
  World& world(int k) noexcept { return *of_[static_cast<std::size_t>(k)]; }
  const World& world(int k) const noexcept { return *of_[static_cast<std::size_t>(k)]; }
  void replace(int k, const Setup& setup) {
    of_[static_cast<std::size_t>(k)] = std::make_unique<World>(setup);
  }

 private:
  std::array<std::unique_ptr<World>, lanes> of_;
  std::array<bool, lanes> outdated_{};
};

// Returns whether a setup is a chain of N links that stays plain (air/bodies.h).
template <int N>
bool is_plain_chain(const Setup& setup) {
  if (!robot::is_chain(setup.robot) || setup.robot.joints.size() != N) return false;
  const air::AirNetwork<chain_muscles> air(setup.muscles, setup.air, setup.supply, setup.cylinder,
                                           setup.faults, setup.steps.body);
  return air.stays_plain();
}

// The machines, with the functions of the list above.
template <int N, int W>
class ChainLanes : public LaneEvents<N, W, LaneWorlds<N, W>> {
  using Events = LaneEvents<N, W, LaneWorlds<N, W>>;
  static constexpr auto lanes = static_cast<std::size_t>(W);

 public:
  using World = ChainWorld<N>;
  using typename Events::Instants;
  static constexpr double finished = std::numeric_limits<double>::infinity();

  // Return whether a machine can be simulated side by side with others, and whether two machines
  // can be so together.
  static bool fits(const Setup& setup) { return is_plain_chain<N>(setup); }
  static bool alike(const Setup& a, const Setup& b) {
    return plant::alike(chain_routing_of(a.robot), chain_routing_of(b.robot));
  }

  // Throws std::invalid_argument if a machine does not fit(), or is not alike() to the first.
  explicit ChainLanes(std::span<const Setup, lanes> setups);

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
  signals::Status drive(int k, const signals::Edge& edge) noexcept {
    update_lane(k);
    return Events::drive(k, edge);
  }
  void advance(int k, double t) noexcept {
    update_lane(k);
    Events::advance(k, t);
  }
  void advance(const Instants& until) noexcept {
    for (int k = 0; k < W; ++k) update_lane(k);
    Events::advance(until);
  }
  signals::Reading read(int k, signals::Channel channel, signals::Tick now) noexcept {
    update_lane(k);
    return Events::read(k, channel, now);
  }
  void truth(int k, double t, Truth& out) noexcept {
    update_lane(k);
    Events::truth(k, t, out);
  }
  void true_motion(int k, double t, Truth& out) noexcept {
    update_lane(k);
    Events::true_motion(k, t, out);
  }

  // Returns machine k as a World, updated from its lane.
  World& world(int k) noexcept;

  // Continues machine k from a state of its World, or of a World with an equal setup.
  void restore(int k, const typename World::State& state) noexcept;

 private:
  using Machines = LaneWorlds<N, W>;
  using Events::machines_, Events::nodes_of_all_, Events::state_, Events::times_, Events::change_,
      Events::failure_, Events::next_node;
  using typename Events::Integrated;
  using typename Events::Mask;
  using typename Events::S;

  [[noreturn]] static void refuse() {
    throw std::invalid_argument(
        "found machines that cannot be simulated side by side; expected chains that fit() and are "
        "alike()");
  }
  static Machines machines_of(std::span<const Setup, lanes> setups);
  static ChainBody<N, S> bodies(const Machines& machines);
  static typename Integrated::Air airs(const Machines& machines);

  void update_lane(int k) noexcept;
  void copy_to_lane(int k) noexcept;
  void copy_to_world(int k) noexcept;

  Instants until_{};
  std::array<bool, lanes> parked_{};
};

template <int N, int W>
ChainLanes<N, W>::ChainLanes(std::span<const Setup, lanes> setups)
    : Events(
          machines_of(setups), [](const Machines& m) { return bodies(m); },
          [](const Machines& m) { return airs(m); }) {
  for (int k = 0; k < W; ++k) copy_to_lane(k);
  until_.fill(-finished);
}

template <int N, int W>
auto ChainLanes<N, W>::machines_of(std::span<const Setup, lanes> setups) -> Machines {
  for (const Setup& s : setups)
    if (!fits(s) || !alike(s, setups[0])) refuse();
  return Machines(setups);
}

template <int N, int W>
void ChainLanes<N, W>::replace(int k, const Setup& setup) {
  const auto l = static_cast<std::size_t>(k);
  const auto other = machines_.mechanism(k == 0 && W > 1 ? 1 : 0).routes();
  if (!fits(setup) || !plant::alike(chain_routing_of(setup.robot), other)) refuse();
  machines_.replace(k, setup);
  nodes_of_all_.body() = bodies(machines_);
  nodes_of_all_.air() = airs(machines_);
  copy_to_lane(k);
  until_[l] = -finished;
  parked_[l] = false;
}

template <int N, int W>
auto ChainLanes<N, W>::bodies(const Machines& machines) -> ChainBody<N, S> {
  std::array<const ChainBody<N>*, lanes> each;
  for (int k = 0; k < W; ++k) each[static_cast<std::size_t>(k)] = &machines.mechanism(k);
  return side_by_side(each);
}

template <int N, int W>
auto ChainLanes<N, W>::airs(const Machines& machines) -> typename Integrated::Air {
  std::array<const air::AirNetwork<chain_muscles>*, lanes> each;
  for (int k = 0; k < W; ++k) each[static_cast<std::size_t>(k)] = &machines.world(k).air();
  return typename Integrated::Air(each);
}

// Copies the World to its lane if it was driven or integrated by itself.
template <int N, int W>
void ChainLanes<N, W>::update_lane(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  if (machines_.is_outdated(k)) return;
  change_[l] = machines_.valves(k).next_change;
  if (machines_.world(k).nodes() != times_[l].nodes) copy_to_lane(k);
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
    this->commit(active);
  }
}

template <int N, int W>
signals::Status ChainLanes<N, W>::start(int k, const signals::Scan& scan) noexcept {
  return machines_.world(k).start(scan);
}

template <int N, int W>
auto ChainLanes<N, W>::world(int k) noexcept -> World& {
  if (machines_.is_outdated(k)) copy_to_world(k);
  machines_.updated(k);
  return machines_.world(k);
}

template <int N, int W>
void ChainLanes<N, W>::restore(int k, const typename World::State& state) noexcept {
  machines_.world(k).restore(state);
  copy_to_lane(k);
}

// Copies the World to its lane.
template <int N, int W>
void ChainLanes<N, W>::copy_to_lane(int k) noexcept {
  this->take(k, machines_.world(k).state(), machines_.world(k).body_step());
  machines_.updated(k);
}

// Copies the lane to its World.
template <int N, int W>
void ChainLanes<N, W>::copy_to_world(int k) noexcept {
  const auto l = static_cast<std::size_t>(k);
  typename World::State& s = machines_.world(k).mutable_state();
  s.now.motion = units::lane_of<GeneralizedState<N>>(state_.now.motion, k);
  s.held = units::lane_of<typename ChainBody<N>::Forces>(state_.held, k);
  s.trolley_bound = state_.trolley_bound[k];
  this->each_number(state_, s, [&](const auto& packed, auto& one) {
    for (int i = 0; i < nodes_of_all_.air().muscles(); ++i) one[i] = packed[i][k];
  });
  s.times = times_[l];
  s.failure = failure_[l];
  machines_.world(k).continue_from_state();
}

}  // namespace sinew::plant
