// host/stop.h - early end of work by its caller: a flag for a thread and all parallel tasks that it
// starts.
#pragma once

#include <atomic>
#include <stdexcept>

namespace sinew::host {

// Thrown by work that has been stopped.
class Stopped : public std::runtime_error {
 public:
  // Sets what() to "stopped".
  Stopped() : std::runtime_error("stopped") {}
};

// While it exists, is_stopped() returns the value of `stop` in its thread.
class Stoppable {
 public:
  // Keeps a pointer to the flag, which must outlive this object.
  explicit Stoppable(const std::atomic<bool>* stop);
  ~Stoppable();
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

  // Returns the flag of this thread; null: the work cannot be stopped.
  static const std::atomic<bool>* flag();

 private:
  const std::atomic<bool>* before_;
};

// Returns whether the work of this thread should end.
inline bool is_stopped() {
  const std::atomic<bool>* flag = Stoppable::flag();
  return flag && flag->load(std::memory_order_relaxed);
}

}  // namespace sinew::host
