// world/packs/wide/batch_of.h - the functions of a batch of W lanes, for the file that compiles
// them.
#pragma once

#include <vector>

#include "sinew/world/packs/batch.h"
#include "sinew/world/packs/chain_batch_lane.h"

namespace sinew::plant {

template <int W>
struct BatchOf {
  using Legs = ChainBatch<2, W>;
  using World = typename Legs::World;

  // Returns the batch behind the pointer.
  static Legs& of(void* batch) noexcept { return *static_cast<Legs*>(batch); }

  // Each is the function of BatchCalls of that name.
  static void* make(const Setup& everywhere) {
    const std::vector<Setup> setups(W, everywhere);
    auto* legs = new Legs(std::span<const Setup, static_cast<std::size_t>(W)>(setups));
    for (int k = 0; k < W; ++k) legs->park(k);
    return legs;
  }
  static void destroy(void* batch) noexcept { delete &of(batch); }
  static void replace(void* batch, int k, const Setup& setup) { of(batch).replace(k, setup); }
  static int go(void* batch, BatchCalls::Turn turn, void* context) noexcept {
    return of(batch).go([&](int k) { return turn(context, k); });
  }

  // Each asks machine k, as the function of BatchCalls of that name.
  static signals::Status start(void* batch, int k, const signals::Scan& scan) noexcept {
    return of(batch).start(k, scan);
  }
  static signals::Status drive(void* batch, int k, const signals::Edge& edge) noexcept {
    return of(batch).drive(k, edge);
  }
  static signals::Reading read(void* batch, int k, signals::Channel channel,
                               signals::Tick now) noexcept {
    return of(batch).read(k, channel, now);
  }
  static signals::Status stop(void* batch, int k) noexcept { return of(batch).stop(k); }
  static Truth truth(void* batch, int k, double t) noexcept { return of(batch).truth(k, t); }
  static void advance(void* batch, int k, double t) noexcept { of(batch).advance(k, t); }
  static const air::Failure& failure(void* batch, int k) noexcept { return of(batch).failure(k); }
  static std::int64_t nodes(void* batch, int k) noexcept { return of(batch).nodes(k); }
  static World& world(void* batch, int k) noexcept { return of(batch).world(k); }
  static void restore(void* batch, int k, const typename World::State& state) noexcept {
    of(batch).restore(k, state);
  }

  // Returns all of them.
  static constexpr BatchCalls calls() {
    return {W,       make,
            destroy, replace,
            go,      {start, drive, read, stop, truth, advance, failure, nodes, world, restore}};
  }
};

}  // namespace sinew::plant
