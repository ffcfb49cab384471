// run/controllers/steering.h - steering of a run in progress: it is paused, its pace set, its gains
// and desired stiffnesses changed. One thread steers, the run's loop follows. Neither waits for the
// other, and the loop allocates no memory and takes no lock.
//
// Pause and pace affect wall time only; the results stay the same, bit for bit. A change takes
// effect at the start of the next period and is recorded, so that the run can be repeated
// (Outcome::changes).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "sinew/control/gait/change.h"
#include "sinew/signals/ring.h"

namespace sinew::run {

class Steering {
 public:
  static constexpr double slowest = 1e-3, fastest = 1e3;  // limits of a pace other than 0

  // --- called by the steering thread ---

  // Pauses or resumes the run.
  void pause(bool paused) noexcept { paused_.store(paused, std::memory_order_relaxed); }
  // Sets the simulated seconds per second of wall time; 0: as fast as possible.
  void pace(double pace) noexcept { pace_.store(pace, std::memory_order_relaxed); }
  // Return false, without effect, if the queue of requests is full.
  bool change(std::size_t setting, double value) noexcept {
    return requests_.put({setting, value, false});
  }
  bool release(std::size_t setting) noexcept { return requests_.put({setting, 0, true}); }

  // --- called by either thread ---

  // Return whether the run is paused, and its pace, which a pause does not change.
  bool paused() const noexcept { return paused_.load(std::memory_order_relaxed); }
  double pace() const noexcept { return pace_.load(std::memory_order_relaxed); }
  // Return the value of a setting at the start of the last period, in SI, and whether it is
  // overridden; by the number of the setting.
  double value(std::size_t setting) const noexcept {
    return value_[setting].load(std::memory_order_relaxed);
  }
  bool overridden(std::size_t setting) const noexcept {
    return overridden_[setting].load(std::memory_order_relaxed);
  }
  // Returns the number of requests that were dropped because no more changes can be recorded, or
  // because their setting or leg does not exist.
  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

  // --- called by the loop ---

  // Request to override a setting, or to release it to the plan's value.
  struct Request {
    std::size_t setting = 0;
    double value = 0;
    bool release = false;
    int leg = -1;  // number of the leg; -1: all legs
  };
  // Calls `use` for every request since the last call.
  template <class Use>
  void take(Use&& use) noexcept {
    requests_.take_all(use);
  }
  // Counts a request that was dropped.
  void refuse() noexcept { refused_.fetch_add(1, std::memory_order_relaxed); }
  // Publishes the value of a setting, and whether it is overridden.
  void show(std::size_t setting, double value, bool overridden) noexcept {
    value_[setting].store(value, std::memory_order_relaxed);
    overridden_[setting].store(overridden, std::memory_order_relaxed);
  }

 private:
  std::atomic<bool> paused_{false};
  std::atomic<double> pace_{1};
  signals::Ring<Request> requests_{256};
  std::array<std::atomic<double>, gait::Overrides::most> value_{};
  std::array<std::atomic<bool>, gait::Overrides::most> overridden_{};
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace sinew::run
