// cli/sweep_runs.h - the runs of a sweep, for the commands that make some.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/tune/mpi/work.h"
#include "sinew/tune/results/results.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"

namespace sinew::cli {

// What all of these commands take besides the study.
struct RunsOptions {
  int threads = 0;      // 0: as many as the machine has
  std::string results;  // a study's file
  std::string shard;    // "2/3"; empty: all points
};

// How many threads that is.
int threads_of(const RunsOptions& options);

struct SweepRuns {
  const RunsOptions& options;
  const Messages& messages;
  bool bar = true;                 // shows on a terminal how far it is
  tune::Master* master = nullptr;  // hands out the runs to other processes
  tune::TableFile* csv = nullptr;  // takes the rows, as they come where nothing else keeps them
};

// Runs what other processes of mpirun hand out, where this one is not the first of them. Returns
// false where it is, or is alone. `sweep` returns the sweep of this command line.
bool is_worker_of(const tune::Ranks& ranks, const RunsOptions& options,
                  const std::function<tune::Sweep()>& sweep);

// Returns the rows of the share: those that were there and those that were run. Tells what is to be
// said of them, and lets the table take its place. Throws std::runtime_error where they are not all
// of the share's points, config::Error where a figure has no row; both say what holds the rows.
std::vector<tune::Row> run_rows(const tune::Sweep& sweep, const SweepRuns& how);

// --range, --set, --report, --units, --allow-unreachable, --threads, --results: what every command
// with runs takes.
void add_runs(CLI::App& sub, tune::Study& study, RunsOptions& options);

// --threads and --results alone.
void add_keeping(CLI::App& sub, RunsOptions& options);

// An option that takes one word each time that it is named, so that what follows stays what it is.
void add_words(CLI::App& sub, const char* name, std::vector<std::string>& words,
               const char* description);

}  // namespace sinew::cli
