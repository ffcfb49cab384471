// tune/optimizer/optimize.h - a tuning's generations, one after the other.
//
//   Tuning t = load_tuning("studies/faster-walk.toml");
//   Tuned best = optimize(t, {.threads = 2, .done = [&](const Row& row) {...}});
//
// The first generation is what the experiment has and points of Sobol's sequence; then a method
// chooses. A generation's runs are points of one sweep, run as any sweep's: by threads, in lanes or
// elsewhere. Candidates, and everything that follows from them, are the same for any number of
// threads and interruptions: rows that are known are not run again, and the method goes through
// them as it did when they were new.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/optimizer/tuning.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {

// Values that were tried, and what their runs came to.
struct Candidate {
  std::size_t number = 0, generation = 0;  // from 0
  std::vector<Value> values;               // of the tuned ranges
  Judgement judged;
};

struct TuneOptions {
  // Threads, lanes, stop, progress, done and known as a sweep's, with the tuning's own points.
  Options runs;
  // Returns what runs a generation elsewhere, in place of threads here.
  std::function<decltype(Options::elsewhere)(const Sweep&)> elsewhere = {};
  // A generation is judged; between runs. Must not throw.
  std::function<void(const std::vector<Candidate>&)> generation = {};
};

struct Tuned {
  std::vector<Candidate> candidates;  // of all generations that are whole
  bool converged = false;             // the method asks for no more
  bool stopped = false;               // before all generations were there

  // Numbers of the best: of one goal one candidate, of several the front. None where nothing is
  // feasible.
  std::vector<std::size_t> best;
};

// Throws config::Error for a wrong experiment or key, std::runtime_error where the program was
// built without pagmo, and where known rows are not those of these candidates.
Tuned optimize(const Tuning& tuning, const TuneOptions& options);

// What the study's file is asked for, and what it keeps of a candidate.
Asked asked_of(const Tuning& tuning);
CandidateRow row_of(const Candidate& candidate);

// A tuning whose study is kept in a file: each row as soon as its run is done, each candidate as
// soon as its generation is.

// How a tuning is run that is kept in a file.
struct KeptOptions {
  TuneOptions tune;                        // without known and done
  std::function<void()> ask_to_stop = {};  // called where a row cannot be written
  run::Notices notices = {};
};

// Goes on with what the file has, or makes it. Says a note for each generation. Throws what
// optimize() and Results throw; what was done by then is in the file.
Tuned optimize_kept(const Tuning& tuning, const std::filesystem::path& file,
                    const KeptOptions& options);

}  // namespace sinew::tune
