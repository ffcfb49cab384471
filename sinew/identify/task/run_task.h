// identify/task/run_task.h - `sinew identify run`: numbers of a machine from a run of it that is
// kept, whether it was simulated, driven or imported.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/identify/machine/run_fit.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// The settings of `sinew identify run`, as texts.
struct RunFitSettings {
  std::string run;                  // its folder, or its log
  std::string machine;              // what was run, in place of the folder's
  std::vector<std::string> sets;    // "key=value": where the search begins, and what is known
  std::vector<std::string> fit;     // keys and groups; empty: all groups
  std::vector<std::string> priors;  // "joint.hip.damping=0.2 N m s/rad +- 0.05 N m s/rad"
  std::vector<std::string> freeze;  // "key=value": what is known and not searched
  std::string hold_out = "20 %";    // of the run, at its end
  std::string from = "0 s";         // what is before is not compared
  int threads = 0;                  // 0: one for each processor
  std::string base;                 // the robot's file that the found one adds to; empty: none
  std::function<void(const std::string&)> progress;
};

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
