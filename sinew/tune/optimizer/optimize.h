// tune/optimizer/optimize.h - runs a tuning's generations one after the other.
//
//   Tuning t = load_tuning("studies/faster-walk.toml");
//   Tuned best = optimize(t, {.threads = 2, .done = [&](const Row& row) {...}});
//
// The first generation consists of the experiment's own values and points of Sobol's sequence; the
// method chooses the others. The runs of a generation are points of one sweep, run like those of
// any sweep: by threads, in lanes or elsewhere. Candidates and all results do not depend on the
// number of threads or on interruptions: known rows are not run again, and the method processes
// them as it did before.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/optimizer/tuning.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {

// Values that were tried, and the evaluation of their runs.
struct Candidate {
  std::size_t number = 0, generation = 0;  // counted from 0
  std::vector<Value> values;               // one per tuned range
  CandidateEvaluation evaluation;
};

struct TuneOptions {
  // Threads, lanes, device, stop, progress, done and known as in a sweep, with the tuning's own
  // points.
  Options runs;
  // Returns the function that runs a generation elsewhere, which replaces the threads here.
  std::function<decltype(Options::dispatch)(const Sweep&)> dispatch = {};
  // Called after each evaluated generation, between runs. Must not throw.
  std::function<void(const std::vector<Candidate>&)> generation = {};
};

struct Tuned {
  std::vector<Candidate> candidates;  // candidates of all complete generations
  bool converged = false;             // the method has converged
  bool stopped = false;               // stopped before the last generation

  // Indices of the best: one candidate for a single goal, the front for several. Empty if none is
  // feasible.
  std::vector<std::size_t> best;
};

// Throws config::Error for a faulty experiment or key, std::runtime_error if the program was built
// without pagmo, or if known rows are not those of these candidates.
Tuned optimize(const Tuning& tuning, const TuneOptions& options);

// Return the request that a study's file stores, and the stored part of a candidate.
StudyRequest request_of(const Tuning& tuning);
CandidateRow row_of(const Candidate& candidate);

// Tuning with a study's file: each row is stored as soon as its run is done, each candidate as soon
// as its generation is.

// Options of a tuning with a file.
struct StoredTuningOptions {
  TuneOptions tune;                        // `known` and `done` are not used
  std::function<void()> ask_to_stop = {};  // called if a row cannot be written
  run::Notices notices = {};
};

// Continues the study in the file, or creates it. Reports a note for each generation. Throws like
// optimize() and Results; completed runs are then in the file.
Tuned optimize_and_store(const Tuning& tuning, const std::filesystem::path& file,
                         const StoredTuningOptions& options);

}  // namespace sinew::tune
