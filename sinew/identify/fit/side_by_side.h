// identify/fit/side_by_side.h - laws that are tried on all cores of the computer.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace sinew::identify {

// Counts attempts that are done, for whoever watches; null: nobody does.
using Tally = std::atomic<std::int64_t>;

// Calls `attempt` with each number below `count`, on as many threads as there are cores. The last
// begins first: laws are listed from the simplest on, and the dearest takes longest. What an
// attempt does may depend on its number alone and writes to places of its own, so what is found is
// the same for any number of threads. Throws what the first attempt that failed has thrown, when
// all are done.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& attempt,
                  Tally* done = nullptr);

}  // namespace sinew::identify
