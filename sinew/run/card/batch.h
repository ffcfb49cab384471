// run/card/batch.h - many runs of plain legs as blocks of bytes (walk.h), which are launched
// together on a graphics card, or on the processor in its place.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/run/card/walk.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {

// Runs that are launched together. `sample` and `edge` have room for kept.samples and kept.edges of
// each run, in the order of Kept; the pointers of Kept are not set.
struct Batched {
  std::span<Walk> walks;
  std::span<const control::Command> commands;
  std::span<const std::uint16_t> wanted;
  std::int32_t samples = 0, edges = 0;
  std::span<std::uint64_t> sample;
  std::span<std::uint32_t> edge;
};
// A card or the processor, which runs them.
struct Launcher {
  // Runs all of them to their ends. Throws std::runtime_error if it cannot.
  std::function<void(const Batched&)> launch;
  // Returns the memory that a launch may take [byte].
  std::function<std::size_t()> memory = [] { return std::size_t{1} << 30; };
};

// Runs them on the processor, one after the other.
void launch_on_processor(const Batched& batched);

// The error of a launcher that computes other bits than the processor.
struct WrongBits : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An experiment of a batch. It must exist until the batch is done.
struct BatchedRun {
  const experiment::Experiment* experiment = nullptr;  // nullptr: it is to be run by itself
  const signals::TopicNames* topics = nullptr;         // those that its table records; nullptr: all
  std::string plan;  // runs with equal texts have the same plan, and the same robot as its
                     // controller has it
};

// Returns whether a machine of this experiment, and its plan, can be held by a batch: a leg of two
// links whose muscles are filled through valves from a constant supply, without faults, on one
// board, with a plan that measures nothing.
bool fits_batch(const experiment::Experiment& experiment);

// Runs them and passes the outcome of each one, with the bits of run(), to done(number, outcome),
// called by threads in any order. Runs that do not fit, or do not end as planned, have none: they
// are to be run by themselves. Prepares and finishes the runs on threads. Two runs of each
// launch are also computed by run() and compared first; throws WrongBits if they differ, and what
// the launcher throws. Begins no further launch once stopped() returns true.
void run_batch(std::span<const BatchedRun> runs, const Launcher& launcher, int threads,
               const std::function<bool()>& stopped,
               const std::function<void(std::size_t, Outcome)>& done);

}  // namespace sinew::run
