// host/side_by_side.h - parallel execution of independent tasks on all cores.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace sinew::host {

// Counter of finished tasks, for a progress bar; null: not counted.
using Tally = std::atomic<std::int64_t>;

// Returns the number of threads: `requested`, or the number of cores if it is 0.
int threads_of(int requested);

// Calls `work` with each number below `count` on `threads` threads including the caller's; 0: one
// per core. The last number begins first, as lists are ordered from simple to expensive. A task may
// depend only on its number and must write to its own memory, so that the results are the same for
// any number of threads. Waits for all tasks, then throws the exception of the first task that
// failed; tasks that have not begun when the caller's thread is stopped (stop.h) throw Stopped.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  Tally* done = nullptr, int threads = 0);

}  // namespace sinew::host
