// run/simulation/lanes.h - many experiments, run in parallel in the lanes of the processor.
//
//   run_in_lanes({.next = […] { return experiment or nullptr; },
//                 .done = […](const Experiment& e, Outcome outcome) { … }});
//
// Each has its own controllers, recorder, ticks and end, and uses the one loop (loop.h); only the
// nodes of the machines are integrated side by side (world/batch.h). When a run ends, the next
// experiment takes its lane. An outcome equals that of run(), bit for bit, independent of the other
// lanes and of the order. An experiment that is not suited to lanes runs by itself.
#pragma once

#include <exception>
#include <functional>

#include "sinew/experiment/experiment.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

struct Lanes {
  // Returns the next experiment, which must exist until it is done; nullptr: no more experiments.
  // Must not throw.
  std::function<const experiment::Experiment*()> next;
  // Takes an outcome, or the exception that run() would have thrown. Its wall time is that from the
  // run's start to its end, shared with the other lanes. Must not throw.
  std::function<void(const experiment::Experiment&, Outcome, std::exception_ptr)> done;
  // Largest number of lanes; 1: one run after the other. A processor with only two lanes uses them
  // only if `most` is 2, since they are no faster.
  int most = 8;
  bool recorded = true;  // false: an outcome has an empty table, and nothing derived from it
  // Returns the topics that a run's table records, which must exist until it is done; nullptr, and
  // absent: all.
  std::function<const signals::TopicNames*(const experiment::Experiment&)> topics = {};
};
// Runs all experiments that `next` returns, side by side; returns when the last is done.
void run_in_lanes(const Lanes& lanes);

// Returns the useful number of lanes on this computer: 8 with AVX-512, 4 with AVX2, else 1.
int widest_lanes();

}  // namespace sinew::run
