// world/packs/batch.h - plain legs side by side (chain_batch.h), in as many lanes as the processor
// has: 2 on every x86-64, 4 with AVX2, 8 with AVX-512.
//
//   Batch batch(Batch::widest(), setup);       // all of it parked
//   batch.replace(k, setup);                   // machine k, at its start
//   LegLane lane = batch.lane(k);              // to be driven, read and looked at
//   int ended = batch.go(turn);                // chain_batch.h
//
// Each width is compiled apart, for its processor, and keeps all its functions to itself
// (cmake/lanes.cmake), so that nothing of it can come to run on another.
#pragma once

#include "sinew/world/machine.h"

namespace sinew::plant {

// The functions of one width.
struct BatchCalls {
  using Turn = double (*)(void* context, int k) noexcept;

  int width;
  void* (*make)(const Setup& everywhere);
  void (*destroy)(void* batch) noexcept;
  void (*replace)(void* batch, int k, const Setup& setup);
  int (*go)(void* batch, Turn turn, void* context) noexcept;
  LaneCalls<ChainWorld<2>> lane;
};
// Defined for the widths that this library was compiled with.
template <int W>
const BatchCalls& batch_calls();
template <>
const BatchCalls& batch_calls<2>();
template <>
const BatchCalls& batch_calls<4>();
template <>
const BatchCalls& batch_calls<8>();

// Legs side by side, in as many lanes as the processor has.
class Batch {
 public:
  // Lanes that this processor has, and this library was compiled for.
  static int widest();
  // Can this machine stand side by side with others; and these two?
  static bool holds(const Setup& setup);
  static bool alike(const Setup& a, const Setup& b);

  // At most so many lanes, at least 2. All are parked; `like` is one that shall be held.
  Batch(int most, const Setup& like);
  ~Batch() { calls_->destroy(batch_); }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  // Returns how many lanes there are, and one of them.
  int width() const noexcept { return calls_->width; }
  LegLane lane(int k) const noexcept { return {calls_->lane, batch_, k}; }

  // Throws std::invalid_argument for a machine that is not held, or not like the others.
  void replace(int k, const Setup& setup) { calls_->replace(batch_, k, setup); }

  static constexpr double over = std::numeric_limits<double>::infinity();
  // Runs all of them as ChainBatch does. Returns what it returns.
  template <class Turn>
  int go(Turn& turn) noexcept {
    const auto ask = [](void* context, int k) noexcept {
      return (*static_cast<Turn*>(context))(k);
    };
    return calls_->go(batch_, ask, &turn);
  }

 private:
  const BatchCalls* calls_;
  void* batch_;
};

}  // namespace sinew::plant
