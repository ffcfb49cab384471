// host/stop.h - work that a caller ends early: a flag for one thread and for all that it begins
// side by side.
#pragma once

#include <atomic>
#include <stdexcept>

namespace sinew::host {

// Thrown by work that has been stopped.
class Stopped : public std::runtime_error {
 public:
  // Makes it with these words.
  Stopped() : std::runtime_error("stopped") {}
};

// While it lives, is_stopped() of its thread returns whether `stop` is true.
class Stoppable {
 public:
  // Takes the flag, which outlives it.
  explicit Stoppable(const std::atomic<bool>* stop);
  ~Stoppable();
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

  // Returns the flag of this thread; null: nothing stops it.
  static const std::atomic<bool>* flag();

 private:
  const std::atomic<bool>* before_;
};

// Returns whether the work of this thread is to end.
inline bool is_stopped() {
  const std::atomic<bool>* flag = Stoppable::flag();
  return flag && flag->load(std::memory_order_relaxed);
}

}  // namespace sinew::host
