// host/side_by_side.h - parallel execution of independent tasks on all cores, and its early end by
// the caller: a flag for a thread and all parallel tasks that it starts.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
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

// Counter of finished tasks, for a progress bar; null: not counted.
using Tally = std::atomic<std::int64_t>;

// Returns the number of threads: `requested`, or the number of cores if it is 0.
int threads_of(int requested);

// Calls `work` with each number below `count` on `threads` threads including the caller's; 0: one
// per core. The last number begins first, as lists are ordered from simple to expensive. A task may
// depend only on its number and must write to its own memory, so that the results are the same for
// any number of threads. Waits for all tasks, then throws the exception of the first task that
// failed; tasks that have not begun when the caller's thread is stopped throw Stopped.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  Tally* done = nullptr, int threads = 0);

}  // namespace sinew::host
