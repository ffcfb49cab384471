// run/card/kernel.h - the arguments of the kernel (kernel.cu).
#pragma once

#include <cstdint>

#include "sinew/run/card/walk.h"

namespace sinew::run {

// Threads of a block. They wait for each other at each node, so that they execute the same
// instructions.
inline constexpr unsigned kernel_threads = 128;
// Blocks that a multiprocessor computes at the same time. With more, a thread has too few
// registers.
inline constexpr unsigned kernel_blocks = 4;

// Runs walks[i]; meet(x) returns whether x is true for any thread of the block. A thread without a
// walk only calls meet().
template <class Meet>
void run_thread(Walk* walks, const Launch& launch, std::int64_t i, const Meet& meet) {
  const bool runs = i < launch.kept.runs;
  const std::int64_t number = runs ? i : launch.kept.runs - 1;
  Walk walk = walks[number];  // in the thread's own memory
  walk.run(launch, number, runs, meet);
  if (runs) walks[number] = walk;
}

}  // namespace sinew::run
