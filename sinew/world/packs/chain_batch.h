// world/packs/chain_batch.h - W plain machines side by side: chains whose muscles are filled
// through valves from a constant supply. Each is a World, and has the bits that it has alone.
//
// The nodes are integrated in lanes; readings look ahead from what the lanes have; all the rest a
// World does by itself. Each machine has its own steps, edges and failures. They go in lockstep by
// node, not by time: a machine that is not to go on waits, and its lane is calculated and thrown
// away.
//
//   go(turn)         runs all of them, each by its own loop: turn(k) is asked whenever machine k
//                    has reached the instant that it said last
//   advance(until)   commits every node up to each machine's own instant, many at once
//   drive, read, …   of machine k, as a World's; a node that only this one needs is committed alone
//   world(k)         machine k as it stands, for all that a World does: truths, saving. It follows
//                    its lane when it is asked for; where it goes on by itself, the lane follows it
//
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "sinew/air/packs/plain_air.h"
#include "sinew/world/machine.h"
#include "sinew/world/packs/chain_lanes.h"

namespace sinew::plant {

template <int N, int W>
class ChainBatch {
 public:
  using World = ChainWorld<N>;
  using Instants = std::array<double, static_cast<std::size_t>(W)>;

  // Can this machine stand side by side with others? With whom says alike().
  static bool holds(const Setup& setup);

  // Can the two stand side by side?
  static bool alike(const Setup& a, const Setup& b) {
    return plant::alike(chain_routing_of(a.robot), chain_routing_of(b.robot));
  }

  // Throws std::invalid_argument where one of the machines is not held or not like the first.
  explicit ChainBatch(std::span<const Setup, static_cast<std::size_t>(W)> setups);

  // Commits every node of machine k up to until[k]  [s].
  void advance(const Instants& until) noexcept;

  // Runs the machines that are not parked. turn(k) runs machine k's loop as far as its nodes reach
  // and returns the instant up to which every node of it can be committed [s], or `over`: then
  // machine k is parked. Returns its k; -1 when all are parked.
  static constexpr double over = std::numeric_limits<double>::infinity();
  template <class Turn>
  int go(const Turn& turn) noexcept;
  void park(int k) noexcept { parked_[static_cast<std::size_t>(k)] = true; }

  // Puts another machine, at its start, in the place of machine k. Throws as the constructor does.
  void replace(int k, const Setup& setup);

  // Machine k's part of a Port, and of a World.
  signals::Status start(int k, const signals::Scan& scan) noexcept;
  signals::Status drive(int k, const signals::Edge& edge) noexcept;
  signals::Reading read(int k, signals::Channel channel, signals::Tick now) noexcept;
  signals::Status stop(int k) noexcept;
  Truth truth(int k, double t) noexcept;
  void advance(int k, double t) noexcept;
  const air::Failure& failure(int k) const noexcept {
    return failure_[static_cast<std::size_t>(k)];
  }
  std::int64_t nodes(int k) const noexcept { return nodes_[static_cast<std::size_t>(k)]; }

  // Returns machine k as it stands.
  World& world(int k) noexcept;

  // Machine k goes on from there: its own state, or one of a world with an equal setup.
  void restore(int k, const typename World::State& state) noexcept;

 private:
  using S = units::Pack<W>;
  using Mask = units::PackMask<W>;
  using Body = ChainBody<N, S>;
  using Air = air::PlainAir<chain_muscles, W>;

  struct Moving {
    typename Body::Motion motion;
    typename Air::State air;
  };
  struct Look {
    typename Body::Ends ends;
    typename Air::Answer air;
    typename Body::Load load;
    typename Body::Acceleration acceleration;
  };

  // Machine k as its senses look at it (planar/senses.h): as a World, from its lane.
  class Sensed;
  // Friction and accelerations of a whole step, which a look between nodes goes by.
  struct Glance {
    typename Body::Forces held{};
    typename Body::Acceleration acceleration{};
  };

  using Worlds = std::array<std::unique_ptr<World>, static_cast<std::size_t>(W)>;

  [[noreturn]] static void refuse();
  static Worlds worlds_of(std::span<const Setup, static_cast<std::size_t>(W)> setups);
  static std::array<const ChainBody<N>*, W> bodies(const Worlds& worlds);
  static std::array<const air::AirNetwork<chain_muscles>*, W> airs(const Worlds& worlds);

  // Puts new numbers of the muscles in the lanes of the mask.
  auto blend_onto(const Mask& mask) const noexcept {
    return [this, mask](const auto& from, auto& to) {
      for (int i = 0; i < air_.muscles(); ++i) to[i] = units::select(mask, from[i], to[i]);
    };
  }

  double next_node(int k) const noexcept;
  Mask only(int k) const noexcept;
  void follow(int k) noexcept;
  const Glance& glance(int k) noexcept;
  void commit(const Mask& goes) noexcept;
  void step(const Mask& steps, const S& h) noexcept;
  void look_at(const Moving& state, const typename Body::Forces& held, Look& look) const noexcept;
  void prepare(const Mask& goes) noexcept;
  void prepare_friction() noexcept;
  void look_for_failures(const Mask& goes) noexcept;
  void take(int k) noexcept;
  void bring(int k) noexcept;

  Worlds worlds_;
  Body body_;
  Air air_;

  // As World::State's, of all machines.
  Moving now_{};
  typename Air::Shares shares_{};
  typename Air::Memory memory_{};
  typename Body::Forces held_{};
  S trolley_bound_ = 0;
  Look first_{};
  Instants time_{}, step_{}, change_{};  // of the node; between nodes; when a valve moves next [s]
  std::array<std::int64_t, W> multiple_{}, nodes_{};
  std::array<air::Failure, W> failure_{};
  std::array<bool, W> behind_{};  // is the machine's World?

  Glance glance_;
  std::array<bool, W> glanced_{};  // does the glance hold for the machine's node?
  Instants until_{};
  std::array<bool, W> parked_{};
};

}  // namespace sinew::plant
