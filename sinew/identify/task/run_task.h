// identify/task/run_task.h - `sinew identify run`: numbers of a machine from a run of it that is
// kept, whether it was simulated, driven or imported.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/identify/machine/run_fit.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct RunFitSettings {
  std::string run;
  std::vector<std::string> fit;
  std::string machine;
  std::vector<std::string> sets, priors, freeze;
  std::string hold_out = "20 %", from = "0 s";
  int threads = 0;
  std::string base;
  std::function<void(const std::string&)> progress;  // is given a line now and then; empty: nothing
};

template <class Visitor>
void fields(Visitor& v, RunFitSettings& s) {
  v.method({.name = "run",
            .doc = "friction, damping, dead times, volumes, leaks from a run of a robot itself",
            .tables = Tables::none});
  v.file({.name = "run",
          .doc = "a run's folder, or a log file; an imported recording's too",
          .option = "RUN",
          .required = true},
         s.run);
  v.texts({.name = "fit",
           .doc = "keys, and groups of them: friction, damping, dead-time, volume, leak; absent: "
                  "all groups",
           .at_commas = true},
          s.fit);
  v.file({.name = "machine", .doc = "what was run, in place of the folder's"}, s.machine);
  v.texts({.name = "sets",
           .doc = "KEY=VALUE: where the search begins, or what is known",
           .option = "start,set"},
          s.sets);
  v.texts({.name = "priors",
           .doc = "\"KEY=VALUE +- DEVIATION\": what is known of a fitted number",
           .option = "prior"},
          s.priors);
  v.texts({.name = "freeze", .doc = "KEY=VALUE: a number that is known and not fitted"}, s.freeze);
  v.quantity(
      {.name = "hold_out", .unit = "1", .doc = "of the run, at its end: scores and is not fitted"},
      s.hold_out);
  v.quantity({.name = "from",
              .unit = "s",
              .range = config::from_zero(1e6, "a time of the run"),
              .doc = "what is before is not compared",
              .keyword = "begin"},
             s.from);
  v.integer({.name = "threads",
             .range = {0, 1024, "simulations"},
             .doc = "simulations at once; 0: one for each processor"},
            s.threads);
  v.file({.name = "base",
          .doc = "the robot's file, named in the one that is written",
          .of_file = true},
         s.base);
}

// Holds what was found, with the robot's file.
struct RunFitFound {
  RunFitResult result;
  std::string base, source;

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Throws config::Error and Refusal.
RunFitFound find_run_fit(const RunFitSettings& settings);

// Returns the report with channels and what is not determined, as `--json` prints it.
Json to_json(const RunFitFound& found);

}  // namespace sinew::identify
