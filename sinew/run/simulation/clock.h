// run/simulation/clock.h - clocks of the loop: simulated time, paced time and steered time.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

#include "sinew/run/controllers/steering.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

// A clock that never waits: the loop runs as fast as possible.
struct SimulatedClock {
  // Returns at once.
  void wait_until(signals::Tick) noexcept {}
};

// Wall time at `speed` simulated seconds per second.
class PacedClock {
 public:
  // The clock starts now.
  explicit PacedClock(double speed) : speed_(speed), start_(std::chrono::steady_clock::now()) {}

  // Waits until the tick is due. Returns false if it is late by more than a tick of wall time.
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

// Wall time under steering: the clock stands while the run is paused, and follows the requested
// pace. A delay of more than a moment, as on a computer that was suspended, is not made up for. The
// first `at_once` seconds pass without waiting, so that a run that starts paused has data to show.
class SteeredClock {
 public:
  // `steering` must outlive the clock; it provides pause and pace.
  explicit SteeredClock(const Steering& steering, double at_once = 0)
      : steering_(steering),
        pace_(steering.pace()),
        was_paused_(steering.paused()),
        at_once_(at_once),
        at_(at_once) {}

  // Waits until the tick is due, even if the pace changes meanwhile.
  void wait_until(signals::Tick t) noexcept {
    const double target = static_cast<double>(t) * signals::tick_seconds;
    for (;;) {
      move_on();
      if (at_ >= target || (pace_ == 0 && !was_paused_)) break;
      const double left = pace_ > 0 ? (target - at_) / pace_ : poll_interval;
      std::this_thread::sleep_for(std::chrono::duration<double>(
          was_paused_ ? poll_interval : std::min(left, poll_interval)));
    }
    const bool far_behind = !was_paused_ && at_ - target > std::max(at_once_, moment * pace_);
    if (pace_ == 0) at_ = std::max(at_, target);
    if (pace_ > 0 && far_behind) at_ = target;
  }

 private:
  static constexpr double poll_interval = 5e-3;  // interval at which steering is polled [s]
  static constexpr double moment = 0.25;         // longest delay that is made up for [s]

  // Advances to the present time at the pace that was polled last, and polls again.
  void move_on() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - last_;
    if (!was_paused_) at_ += passed.count() * pace_;
    last_ = now;
    pace_ = steering_.pace();
    was_paused_ = steering_.paused();
  }

  const Steering& steering_;
  double pace_;
  bool was_paused_;  // whether it was paused when polled last
  double at_once_;   // initial time without waiting [s]
  double at_;        // simulated time according to wall time [s]
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace sinew::run
