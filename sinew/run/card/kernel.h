// run/card/kernel.h - the arguments of the kernel (kernel.cu).
#pragma once

#include <cstdint>

#include "sinew/run/card/walk.h"

namespace sinew::run {

// Threads of a block. All of them meet at each node, so that they execute the same instructions.
inline constexpr unsigned kernel_threads = 128;

// Runs walks[i] with meet(x) among the threads of a block; surplus threads run copies of the last
// one, and write nothing.
template <class Meet>
void run_thread(Walk* walks, const Launch& launch, std::int64_t i, const Meet& meet) {
  const std::int64_t number = i < launch.kept.runs ? i : launch.kept.runs - 1;
  Launch its = launch;
  if (i >= launch.kept.runs) its.kept.samples = its.kept.edges = 0;
  Walk walk = walks[number];
  walk.run(its, number, meet);
  if (i < launch.kept.runs) walks[number] = walk;
}

}  // namespace sinew::run
