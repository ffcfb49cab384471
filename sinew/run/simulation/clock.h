// run/simulation/clock.h - who owns time: the simulation, or the wall.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

#include "sinew/run/controllers/steering.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

// As fast as it goes.
struct SimulatedClock {
  // Does not wait.
  bool wait_until(signals::Tick) noexcept { return true; }
};

// `speed` simulated seconds per second of wall time. False where a tick came too late by more than
// a tick of wall time.
class PacedClock {
 public:
  // Its time starts now.
  explicit PacedClock(double speed) : speed_(speed), start_(std::chrono::steady_clock::now()) {}

  // Waits until the tick is due. False: it came too late.
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

// A person's clock: stands while the run is paused, goes at the speed that was asked for last. What
// falls behind by more than a moment, as on a computer that slept, goes on from there. The first
// `at_once` seconds pass at once, so that a run that starts paused has something to show.
class SteeredClock {
 public:
  // `steering` outlives the clock and says when it stands and how fast it goes.
  explicit SteeredClock(const Steering& steering, double at_once = 0)
      : steering_(steering),
        pace_(steering.pace()),
        stood_(steering.paused()),
        at_once_(at_once),
        at_(at_once) {}

  // Waits until the tick is due, however often the pace changes meanwhile. False: it came far too
  // late.
  bool wait_until(signals::Tick t) noexcept {
    const double target = static_cast<double>(t) * signals::tick_seconds;
    for (;;) {
      move_on();
      if (at_ >= target || (pace_ == 0 && !stood_)) break;
      const double left = pace_ > 0 ? (target - at_) / pace_ : doze;
      std::this_thread::sleep_for(
          std::chrono::duration<double>(stood_ ? doze : std::min(left, doze)));
    }
    const bool far_behind = !stood_ && at_ - target > std::max(at_once_, moment * pace_);
    if (pace_ == 0) at_ = std::max(at_, target);
    if (pace_ > 0 && far_behind) at_ = target;
    return true;
  }

 private:
  static constexpr double doze = 5e-3;    // between two looks at what is wanted [s]
  static constexpr double moment = 0.25;  // [s]

  // Up to now at the pace of the last look.
  void move_on() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - last_;
    if (!stood_) at_ += passed.count() * pace_;
    last_ = now;
    pace_ = steering_.pace();
    stood_ = steering_.paused();
  }

  const Steering& steering_;
  double pace_;
  bool stood_;      // paused at the last look
  double at_once_;  // [s]
  double at_;       // simulated time by the wall [s]
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace sinew::run
