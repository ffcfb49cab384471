// cli/sweep_runs.h - the runs of a sweep, for the commands that make some.
#pragma once

#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/terminal.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"

namespace sinew::cli {

struct SweepRuns {
  int threads = 0;                 // 0: as many as the machine has
  bool bar = true;                 // shows on a terminal how far it is
  tune::TableFile* csv = nullptr;  // takes the rows as they come
};

// Returns the rows that are done: all, or those of an interrupted sweep.
std::vector<tune::Row> run_rows(const tune::Sweep& sweep, const SweepRuns& how);

// Tells what is to be said of the rows. Throws std::runtime_error where they are not all of the
// points; `part`: the file that holds them, if any.
void tell_of_rows(const std::vector<tune::Row>& rows, std::size_t points, const std::string& part,
                  const Messages& messages);

// --range, --set, --report, --allow-unreachable, --threads: what every command with runs takes.
void add_runs(Command sub, tune::Study& study, int& threads);

// An option that takes one word each time that it is named, so that what follows stays what it is.
void add_words(Command sub, const char* name, std::vector<std::string>& words,
               const char* description);

}  // namespace sinew::cli
