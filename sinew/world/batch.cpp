#include "sinew/world/batch.h"

#include <array>
#include <vector>

namespace sinew::plant {

namespace {

// Returns the largest supported number of lanes that is at most `most`.
int lanes_of(int most) {
#if defined(__x86_64__)
  if (most >= 8 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
    return 8;
  if (most >= 4 && __builtin_cpu_supports("avx2")) return 4;
#endif
  (void)most;
  return 2;
}

// Returns the first setups, as many as there are lanes.
template <int W>
std::span<const Setup, static_cast<std::size_t>(W)> first_of(const std::vector<Setup>& all) {
  return std::span<const Setup, static_cast<std::size_t>(W)>(all.data(), W);
}

template <class Legs>
Legs parked(const std::vector<Setup>& all) {
  return Legs(first_of<Legs::width>(all));
}

}  // namespace

int Batch::widest() { return lanes_of(8); }

Batch::Batch(int most, const Setup& like)
    : legs_([&]() -> decltype(legs_) {
        const std::vector<Setup> all(8, like);
        switch (lanes_of(most)) {
          case 8:
            return parked<Legs<8>>(all);
          case 4:
            return parked<Legs<4>>(all);
          default:
            return parked<Legs<2>>(all);
        }
      }()) {
  visit([](auto& legs) {
    for (int k = 0; k < legs.width; ++k) legs.park(k);
  });
}

signals::Status LegLane::start(const signals::Scan& scan) noexcept {
  return batch_->visit([&](auto& legs) { return legs.start(k_, scan); });
}

signals::Status LegLane::drive(signals::Edge edge) noexcept {
  return batch_->visit([&](auto& legs) { return legs.drive(k_, edge); });
}

signals::Reading LegLane::read(signals::Channel channel, signals::Tick now) noexcept {
  return batch_->visit([&](auto& legs) { return legs.read(k_, channel, now); });
}

signals::Status LegLane::stop(signals::Tick) noexcept {
  return batch_->visit([&](auto& legs) { return legs.stop(k_); });
}

void LegLane::truth(double t, Truth& out) noexcept {
  batch_->visit([&](auto& legs) { legs.truth(k_, t, out); });
}

void LegLane::true_motion(double t, Truth& out) noexcept {
  batch_->visit([&](auto& legs) { legs.true_motion(k_, t, out); });
}

void LegLane::advance(double t) noexcept {
  batch_->visit([&](auto& legs) { legs.advance(k_, t); });
}

const air::Failure& LegLane::failure() const noexcept {
  return batch_->visit([&](auto& legs) -> const air::Failure& { return legs.failure(k_); });
}

std::int64_t LegLane::nodes() const noexcept {
  return batch_->visit([&](auto& legs) { return legs.nodes(k_); });
}

void LegLane::restore(const State& state) noexcept {
  batch_->visit([&](auto& legs) { legs.restore(k_, state); });
}

LegLane::World& LegLane::world() const noexcept {
  return batch_->visit([&](auto& legs) -> World& { return legs.world(k_); });
}

}  // namespace sinew::plant
