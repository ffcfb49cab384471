// run/ensemble/batches.h - many runs of ensembles in batches, as for a graphics card.
#pragma once

#include <cstddef>

#include "sinew/run/card/batch.h"
#include "sinew/run/ensemble/many.h"

namespace sinew::run {

// Options of runs in batches.
struct InBatches {
  Launcher launcher;
  std::size_t most = 1;    // largest number of runs in a batch
  bool continues = false;  // after a failed launch, on the processor
};
// Runs all in batches (run/card/batch.h); those that no batch can run, in lanes on threads. Throws
// std::runtime_error if a launch fails and `continues` is false.
void run_many_in_batches(const Many& many, const InBatches& how, int threads);

}  // namespace sinew::run
