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
  std::string units;              // empty: as the run, the person or the environment says
  std::string from, to;           // "2 s"; empty: all
  std::string title, width, height, font;
  std::string words;                  // a file of labels
  std::vector<std::string> labels;    // of runs in the same axes
  std::vector<std::string> channels;  // figures of these in place of the page's panels
  std::vector<std::string> only, formats;
  std::string align = "start", event, clock = "none";  // of runs in the same axes
  bool overlay = false, labels_template = false;
  bool force = false, json = false, quiet = false;

  // Returns whether the runs are aligned with each other.
  bool overlaid() const { return overlay || !labels.empty() || align != "start"; }
};

// Returns what --format and --force ask for: "svg,png,pdf,csv"; "csv" alone draws nothing. Throws
// config::Error for another word.
run::FigureFiles files_of(const std::vector<std::string>& formats, bool force);

ExitCode draw_runs(const RunFiguresRequest& request);

}  // namespace sinew::cli
