// plant/packs/chain_batch.h - W plain machines side by side: chains whose muscles are filled
// through valves from a constant supply. Each is a World, and has the bits that it has alone.
//
// The nodes are integrated in lanes, all the rest a World does by itself: commands, readings,
// truths, states. Each machine has its own steps, edges and failures. They go in lockstep by node,
// not by time: whoever has reached where he is asked to go waits, and his lane is calculated and
// thrown away.
//
//   advance(until)   commits every node up to each machine's own instant, many at once
//   world(k)         machine k as it stands, for all that a World does: reading, driving, saving.
//                    It follows its lane when it is asked for; where it goes on by itself (an edge
//                    or a reading beyond the instants of `advance`), the lane follows it
//
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>

#include "sinew/air/packs/plain_air.h"
#include "sinew/plant/machine/machine.h"
#include "sinew/plant/packs/chain_lanes.h"

namespace sinew::plant {

template <int N, int W>
class ChainBatch {
 public:
  using World = ChainWorld<N>;
  using Instants = std::array<double, static_cast<std::size_t>(W)>;

  // Can this machine stand side by side with others? With whom says alike().
  static bool holds(const Setup& setup);

  // Throws std::invalid_argument where one of the machines is not held or not like the first.
  explicit ChainBatch(std::span<const Setup, static_cast<std::size_t>(W)> setups);

  // Commits every node of machine k up to until[k]  [s].
  void advance(const Instants& until) noexcept;

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

  using Worlds = std::array<std::unique_ptr<World>, static_cast<std::size_t>(W)>;

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
  Instants time_{}, step_{};
  std::array<std::int64_t, W> multiple_{}, nodes_{};
  std::array<air::Failure, W> failure_{};
  std::array<bool, W> behind_{};  // is the machine's World?
};

}  // namespace sinew::plant
