// host/beat.h - the wall's clock in ticks: who drives a machine that does not wait for him sleeps
// from tick to tick by it.
#pragma once

#include <cstdint>

#include "sinew/signals/tick.h"

namespace sinew::host {

// Of the clock that no one sets  [ns].
std::int64_t now_ns() noexcept;
// Returns at once where the instant has passed. A signal's handler does not end it.
void sleep_until_ns(std::int64_t instant) noexcept;

class Beat {
 public:
  // Tick 0 is at the first wait_until, or from here on.
  void start() noexcept;

  // Sleeps to that tick. False where it is later than a tick by then.
  bool wait_until(signals::Tick tick) noexcept;

  // By how much the last wait ended too late  [ticks], 0 where it did not.
  signals::Tick behind() const noexcept { return behind_; }

 private:
  std::int64_t start_ = -1;  // [ns]
  signals::Tick behind_ = 0;
};

}  // namespace sinew::host
