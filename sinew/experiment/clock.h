// experiment/clock.h - who owns time: the simulation, or the wall.
#pragma once

#include <chrono>
#include <thread>

#include "sinew/signals/tick.h"

namespace sinew::experiment {

// As fast as it goes.
struct SimulatedClock {
  bool wait_until(signals::Tick) noexcept { return true; }
};

// `speed` simulated seconds per second of wall time. False where a tick came too late by more than
// a tick of wall time.
class PacedClock {
 public:
  explicit PacedClock(double speed) : speed_(speed), start_(std::chrono::steady_clock::now()) {}

  bool wait_until(signals::Tick t) noexcept {
    using seconds = std::chrono::duration<double>;
    const auto due = start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                  seconds(static_cast<double>(t) * signals::tick_seconds / speed_));
    std::this_thread::sleep_until(due);
    const seconds late = std::chrono::steady_clock::now() - due;
    return late.count() * speed_ < signals::tick_seconds;
  }

 private:
  double speed_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sinew::experiment
