// world/lane.h - one of several machines that go side by side, as a Port of its own: what
// is asked of it it passes on to the batch that holds them all (packs/batch.h).
#pragma once

#include "sinew/air/failure.h"
#include "sinew/mechanism/planar/chain_mechanism.h"
#include "sinew/signals/port.h"
#include "sinew/world/world.h"

namespace sinew::plant {

// What a batch does for its machine k, as World does for the one that it is.
template <class World>
struct LaneCalls {
  using Batch = void*;

  signals::Status (*start)(Batch, int k, const signals::Scan&) noexcept;
  signals::Status (*drive)(Batch, int k, const signals::Edge&) noexcept;
  signals::Reading (*read)(Batch, int k, signals::Channel, signals::Tick) noexcept;
  signals::Status (*stop)(Batch, int k) noexcept;
  typename World::Truth (*truth)(Batch, int k, double t) noexcept;
  void (*advance)(Batch, int k, double t) noexcept;
  const air::Failure& (*failure)(Batch, int k) noexcept;
  std::int64_t (*nodes)(Batch, int k) noexcept;
  // The machine as it stands, for what is rare.
  World& (*world)(Batch, int k) noexcept;
  void (*restore)(Batch, int k, const typename World::State&) noexcept;
};

template <class W>
class Lane final : public signals::Port {
 public:
  using World = W;
  using State = typename World::State;
  using Truth = typename World::Truth;

  // The batch and its calls outlive this.
  Lane(const LaneCalls<World>& calls, void* batch, int k) : calls_(&calls), batch_(batch), k_(k) {}

  signals::Status start(const signals::Scan& scan) noexcept override {
    return calls_->start(batch_, k_, scan);
  }
  signals::Status drive(signals::Edge edge) noexcept override {
    return calls_->drive(batch_, k_, edge);
  }
  signals::Reading read(signals::Channel channel, signals::Tick now) noexcept override {
    return calls_->read(batch_, k_, channel, now);
  }
  signals::Status stop(signals::Tick) noexcept override { return calls_->stop(batch_, k_); }

  // As World's.
  Truth truth(double t) noexcept { return calls_->truth(batch_, k_, t); }
  void advance(double t) noexcept { calls_->advance(batch_, k_, t); }
  const air::Failure& failure() const noexcept { return calls_->failure(batch_, k_); }
  std::int64_t nodes() const noexcept { return calls_->nodes(batch_, k_); }
  double time() const noexcept { return world().time(); }
  double air_mass() const noexcept { return world().air_mass(); }
  double shortest_step() const noexcept { return world().shortest_step(); }
  const State& state() const noexcept { return world().state(); }
  void restore(const State& state) noexcept { calls_->restore(batch_, k_, state); }

 private:
  World& world() const noexcept { return calls_->world(batch_, k_); }

  const LaneCalls<World>* calls_;
  void* batch_;
  int k_;
};

}  // namespace sinew::plant
