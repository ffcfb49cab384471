// cli/figures_runs.h - `sinew figures DIR…`: the figures of recorded runs.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/run/folder/figure_files.h"

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

// What --format and --force ask for: "svg,png,csv"; "csv" alone draws nothing. Throws config::Error
// for another word.
run::FigureFiles files_of(const std::vector<std::string>& formats, bool force);

ExitCode draw_runs(const RunFiguresRequest& request);

}  // namespace sinew::cli
