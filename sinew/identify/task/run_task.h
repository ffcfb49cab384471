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
  v.method({"run", "friction, damping, dead times, volumes, leaks from a run of a robot itself",
            Tables::none});
  v.file(Setting{"run", "a run's folder, or a log file; an imported recording's too"}
             .required()
             .called("RUN"),
         s.run);
  v.texts(Setting{"fit",
                  "keys, and groups of them: friction, damping, dead-time, volume, leak; absent: "
                  "all groups"}
              .at_commas(),
          s.fit);
  v.file({"machine", "what was run, in place of the folder's"}, s.machine);
  v.texts(
      Setting{"sets", "KEY=VALUE: where the search begins, or what is known"}.called("start,set"),
      s.sets);
  v.texts(Setting{"priors", "\"KEY=VALUE +- DEVIATION\": what is known of a fitted number"}.called(
              "prior"),
          s.priors);
  v.texts({"freeze", "KEY=VALUE: a number that is known and not fitted"}, s.freeze);
  v.quantity({"hold_out", "of the run, at its end: scores and is not fitted", "1"}, s.hold_out);
  v.quantity(Setting{"from", "what is before is not compared", "s",
                     config::from_zero(1e6, "a time of the run")}
                 .in_python("begin"),
             s.from);
  v.integer(
      {"threads", "simulations at once; 0: one for each processor", "", {0, 1024, "simulations"}},
      s.threads);
  v.file(Setting{"base", "the robot's file, named in the one that is written"}.of_file(), s.base);
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
