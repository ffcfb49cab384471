// run/ensemble/batches.h - many runs of ensembles in batches, as for a graphics card.
#pragma once

#include <cstddef>

#include "sinew/run/card/batch.h"
#include "sinew/run/ensemble/many.h"

namespace sinew::run {

// Runs all in batches of at most `most` runs (run/card/batch.h), which `launcher` computes. Other
// runs are made in lanes on threads. If a launch fails, throws std::runtime_error, or if it
// `continues` runs the others on the processor.
struct InBatches {
  Launcher launcher;
  std::size_t most = 1;
  bool continues = false;
};
void run_many_in_batches(const Many& many, const InBatches& how, int threads);

}  // namespace sinew::run
