// cli/figures_runs.h - `sinew figures DIR…`: the figures of recorded runs.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace sinew::cli {

struct RunFiguresRequest {
  std::vector<std::string> runs;  // folders, or logs
  std::string out;                // empty: figures/ in each run's folder
  std::string machine;            // in place of resolved.toml
  std::string units = "si";       // or "thesis"
  std::string from, to;           // "2 s"; empty: all
  std::vector<std::string> only, formats;
  bool force = false, json = false, quiet = false;
};

ExitCode draw_runs(const RunFiguresRequest& request);

}  // namespace sinew::cli
