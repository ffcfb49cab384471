// run/controllers/steering.h - how a run is steered while it goes: paused, set to another speed,
// its gains and desired stiffnesses changed. One thread steers, the run's loop obeys; neither waits
// for the other, and the loop takes no memory and no lock.
//
// Pause and speed move the wall's clock alone: the run keeps its bits. A change takes effect at the
// next period start and is kept, so that the run can be repeated (Outcome::changes).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "sinew/control/gait/change.h"
#include "sinew/signals/ring.h"

namespace sinew::run {

class Steering {
 public:
  static constexpr double slowest = 1e-3, fastest = 1e3;  // paces other than 0

  // --- the steering thread's side ---

  // Lets the run stand, or go on.
  void pause(bool paused) noexcept { paused_.store(paused, std::memory_order_relaxed); }
  // Simulated seconds per second of wall time; 0: as fast as it goes.
  void pace(double pace) noexcept { pace_.store(pace, std::memory_order_relaxed); }
  // False, and nothing done: more wait than there is room for.
  bool change(std::size_t setting, double value) noexcept {
    return wishes_.put({setting, value, false});
  }
  bool release(std::size_t setting) noexcept { return wishes_.put({setting, 0, true}); }

  // --- either's ---

  // Does it stand? At which pace does it go, or would it?
  bool paused() const noexcept { return paused_.load(std::memory_order_relaxed); }
  double pace() const noexcept { return pace_.load(std::memory_order_relaxed); }
  // As it stood at the last period start, in SI; by the number of the setting.
  double value(std::size_t setting) const noexcept {
    return value_[setting].load(std::memory_order_relaxed);
  }
  bool overridden(std::size_t setting) const noexcept {
    return overridden_[setting].load(std::memory_order_relaxed);
  }
  // Wishes that came when the run could keep no more changes; they were not followed.
  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

  // --- the loop's side ---

  // A setting that somebody wants to be otherwise, or as the plan has it.
  struct Wish {
    std::size_t setting = 0;
    double value = 0;
    bool release = false;
    int leg = -1;  // its number; -1: every leg's
  };
  // Calls `use` for every wish that came since.
  template <class Use>
  void take(Use&& use) noexcept {
    wishes_.take_all(use);
  }
  // Counts a wish that was not followed.
  void refuse() noexcept { refused_.fetch_add(1, std::memory_order_relaxed); }
  // Tells what a setting stands at, and whether that is somebody's wish.
  void show(std::size_t setting, double value, bool overridden) noexcept {
    value_[setting].store(value, std::memory_order_relaxed);
    overridden_[setting].store(overridden, std::memory_order_relaxed);
  }

 private:
  std::atomic<bool> paused_{false};
  std::atomic<double> pace_{1};
  signals::Ring<Wish> wishes_{256};
  std::array<std::atomic<double>, gait::Overrides::most> value_{};
  std::array<std::atomic<bool>, gait::Overrides::most> overridden_{};
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace sinew::run
