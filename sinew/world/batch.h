// world/batch.h - plain legs side by side (chain_lanes.h), in as many lanes as the processor has: 2
// on every x86-64, 4 with AVX2, 8 with AVX-512. One of them is accessible as a Port.
//
//   Batch batch(Batch::widest(), setup);       // all machines parked
//   batch.replace(k, setup);                   // machine k, at its start
//   LegLane lane(batch, k);                    // drives and reads machine k
//   int ended = batch.run(loop);               // chain_lanes.h
#pragma once

#include <limits>
#include <variant>

#include "sinew/world/chain_lanes.h"

namespace sinew::plant {

class Batch {
  template <int W>
  using Legs = ChainLanes<2, W>;

 public:
  // Returns the number of lanes that this processor supports.
  static int widest();
  // Return whether this machine can be simulated side by side with others, and whether these two
  // can.
  static bool fits(const Setup& setup) { return Legs<2>::fits(setup); }
  static bool alike(const Setup& a, const Setup& b) { return Legs<2>::alike(a, b); }

  // Uses at most `most` lanes, at least 2. All are parked; `like` is an example of the machines.
  Batch(int most, const Setup& like);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  // Calls `use` with the lanes.
  template <class Use>
  decltype(auto) visit(const Use& use) {
    return std::visit(use, legs_);
  }
  template <class Use>
  decltype(auto) visit(const Use& use) const {
    return std::visit(use, legs_);
  }

  // Returns the number of lanes.
  int width() const noexcept {
    return visit([](const auto& legs) { return legs.width; });
  }

  // Throws std::invalid_argument for a machine that is not supported or differs too much from the
  // others.
  void replace(int k, const Setup& setup) {
    visit([&](auto& legs) { legs.replace(k, setup); });
  }

  // Park a machine, and continue it, as ChainLanes does.
  void park(int k) noexcept {
    visit([&](auto& legs) { legs.park(k); });
  }
  void resume(int k) noexcept {
    visit([&](auto& legs) { legs.resume(k); });
  }

  static constexpr double finished = Legs<2>::finished;
  // Runs all machines as ChainLanes::go does, and returns its result.
  template <class Loop>
  int run(const Loop& loop) noexcept {
    return visit([&](auto& legs) { return legs.run(loop); });
  }

 private:
  std::variant<Legs<2>, Legs<4>, Legs<8>> legs_;
};

// One leg of a batch, as a Port and as a World.
class LegLane final : public signals::Port {
 public:
  using World = ChainWorld<2>;
  using State = World::State;

  // Takes lane `k` of a batch, which must outlive it.
  LegLane(Batch& batch, int k) : batch_(&batch), k_(k) {}

  signals::Status start(const signals::Scan& scan) noexcept override;
  signals::Status drive(signals::Edge edge) noexcept override;
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override;
  signals::Status stop(signals::Tick now) noexcept override;

  // The functions of World.
  void truth(double t, Truth& out) noexcept;
  void true_motion(double t, Truth& out) noexcept;  // as in machine.h
  void advance(double t) noexcept;
  const air::Failure& failure() const noexcept;
  std::int64_t nodes() const noexcept;
  double time() const noexcept { return world().time(); }
  double air_mass() const noexcept { return world().air_mass(); }
  bool took_air() const noexcept { return world().took_air(); }
  double shortest_step() const noexcept { return world().shortest_step(); }
  const State& state() const noexcept { return world().state(); }
  void restore(const State& state) noexcept;

 private:
  World& world() const noexcept;

  Batch* batch_;
  int k_;
};

}  // namespace sinew::plant
