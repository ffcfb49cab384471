// tune/run_many.h - runs of experiment files, in parallel in the lanes of the processor
// (run/simulation/lanes.h). Each result equals that of run_once.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A requested run.
struct RequestedRun {
  std::size_t point = 0;  // identifies the run for the caller
  std::string experiment;
  std::vector<std::string> sets;
};

struct Many {
  // Returns the next run, if there is one. Must not throw.
  std::function<std::optional<RequestedRun>()> next;
  // Receives the results, in any order. Must not throw.
  std::function<void(std::size_t point, RunResult)> done;
  bool allow_unreachable = false;
  int lanes = 8;  // largest number; 1: one after the other
};
void run_many(const Many& many);

}  // namespace sinew::tune
