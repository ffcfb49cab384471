// tune/run_many.h - runs of experiments by their files, as many at a time as the processor has
// lanes (run/simulation/lanes.h). Each is what run_once says of it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sinew/tune/sweep.h"

namespace sinew::tune {

// A run that somebody wants.
struct Wanted {
  std::size_t point = 0;  // whoever asks knows it by this
  std::string experiment;
  std::vector<std::string> sets;
};

struct Many {
  // Answers what is to be run next, if there is more. Must not throw.
  std::function<std::optional<Wanted>()> next;
  // Takes what was run, in any order. Must not throw.
  std::function<void(std::size_t point, Ran)> done;
  bool allow_unreachable = false;
  int lanes = 8;  // at most; 1: one after the other
};
void run_many(const Many& many);

}  // namespace sinew::tune
