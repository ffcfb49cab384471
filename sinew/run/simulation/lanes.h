// run/simulation/lanes.h - many experiments, as many of them at a time as the processor has lanes.
//
//   run_in_lanes({.next = […] { return experiment or nullptr; },
//                 .done = […](const Experiment& e, Outcome outcome) { … }});
//
// Each has its own controllers, recorder, ticks and end, and goes by the one loop (loop.h); only
// the nodes of the machines are integrated side by side (world/batch.h). Where a run ends, the next
// experiment takes its lane. An outcome has the bits that run() answers, whoever goes beside it
// and in whatever order. What cannot go in lanes is run by itself.
#pragma once

#include <exception>
#include <functional>

#include "sinew/experiment/experiment.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

struct Lanes {
  // Answers the next experiment, which lives on until it is done; nullptr: there is none, now or
  // later. Must not throw.
  std::function<const experiment::Experiment*()> next;
  // Takes an outcome, or what run() would have thrown. Its wall time is from the run's start to its
  // end, among the others. Must not throw.
  std::function<void(const experiment::Experiment&, Outcome, std::exception_ptr)> done;
  // Lanes at most; 1: one run after the other, as where there are but the two lanes that every
  // processor has, which are taken only where just two are asked for.
  int most = 8;
  bool recorded = true;  // false: an outcome has no table, nor what is taken from it
};
// Runs all that `next` answers, side by side, and returns when the last is done.
void run_in_lanes(const Lanes& lanes);

// Lanes that are worth it on this computer: 8 with AVX-512, 4 with AVX2, else 1.
int widest_lanes();

}  // namespace sinew::run
