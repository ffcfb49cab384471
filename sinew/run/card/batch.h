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

// Runs that are launched together, and the memory for what is kept of them: `wanted`, `samples`,
// `edges`, `sample` and `edge` are those of Kept (walk.h).
struct Batched {
  std::span<Walk> walks;
  std::span<const control::Command> commands;
  std::span<const std::uint16_t> wanted;
  std::int32_t samples = 0, edges = 0;
  std::span<std::uint64_t> sample;
  std::span<std::uint32_t> edge;
};
// Device that runs a launch: a card or the processor.
struct Launcher {
  // Runs all of them to their ends. Throws std::runtime_error if it cannot.
  std::function<void(const Batched&)> launch;
  // Returns the memory that a launch may take [byte].
  std::function<std::size_t()> memory = [] { return std::size_t{1} << 30; };
};

// Runs them on the processor, one after the other.
void launch_on_processor(const Batched& batched);

// A launcher computes other bits than the processor.
struct WrongBits : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An experiment of a batch. It must exist until the batch is done.
struct BatchedRun {
  const experiment::Experiment* experiment = nullptr;  // nullptr: it does not run in the batch
  const signals::TopicNames* topics = nullptr;         // those that its table records; nullptr: all
  std::string plan;  // a text that is equal for runs with the same plan table (plan_table.h)
};

// Returns whether a batch can run this experiment: a leg of two links whose muscles are filled
// through valves from a constant supply, without faults, on one board, with a plan that measures
// nothing.
bool fits_batch(const experiment::Experiment& experiment);

// Runs them and passes the outcome of each one, with the bits of run(), to done(number, outcome).
// Threads call done() in any order. It is not called for runs that do not fit or do not end as
// planned: the caller makes these by run(). Prepares and finishes the runs on threads. First
// compares two runs of each launch with run(); throws WrongBits if they differ, and what the
// launcher throws. Begins no further launch once stopped() returns true.
void run_batch(std::span<const BatchedRun> runs, const Launcher& launcher, int threads,
               const std::function<bool()>& stopped,
               const std::function<void(std::size_t, Outcome)>& done);

}  // namespace sinew::run
