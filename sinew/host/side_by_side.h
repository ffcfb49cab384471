// host/side_by_side.h - pieces of work that do not depend on each other, on all cores.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace sinew::host {

// Counts pieces that are done, for a progress bar; null: nothing is counted.
using Tally = std::atomic<std::int64_t>;

// Returns that many threads, or as many as the computer has cores where `asked` is 0.
int threads_of(int asked);

// Calls `work` with each number below `count`, on so many threads, of which the caller's is one, or
// on as many as there are cores. The last begins first: lists go from the simplest on, and the
// dearest takes longest. A piece may depend on its number alone and writes to places of its own, so
// the results are the same for any number of threads. Throws what the first piece that failed has
// thrown, when all are done; pieces that have not begun when the caller's thread is stopped
// (stop.h) throw Stopped.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  Tally* done = nullptr, int threads = 0);

}  // namespace sinew::host
