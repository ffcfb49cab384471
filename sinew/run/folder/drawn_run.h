// run/folder/drawn_run.h - the figures of stored runs, as a folder of files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/align/align.h"
#include "sinew/report/figures/run_figures.h"
#include "sinew/run/folder/figure_files.h"
#include "sinew/run/folder/notices.h"

namespace sinew::run {

// Selection and format of the figures.
struct DrawingRequest {
  std::string machine = {};  // description of the run; empty: the run's resolved.toml
  // Read by units/shown.h; empty: those of the run, the user's settings or the environment.
  std::string units = {};
  report::RunFigureOptions options = {};  // without units and channels
  // Figures of these channels, which replace the page's panels. Each text is a figure with one plot
  // per part between commas: "/joint/*/angle,/muscle/*/tension". * matches any letters.
  std::vector<std::string> channels = {};
  std::vector<std::string> only = {};  // names of the figures to draw; empty: all
  std::string title = {};              // above the picture; requires a single figure
  report::Paper paper = {};
  FigureFiles files = {};
};

// Runs that are aligned with each other.
struct OverlaidRuns {
  std::vector<std::filesystem::path> runs;  // folders, or logs
  std::vector<std::string> labels = {};     // labels of the first runs; the others are labelled by
                                            // their folders
  // Alignment of the other runs' times with those of the first run; absent: they begin together.
  std::optional<analysis::AlignRequest> align = {};
};

// Draws the figures of the run at `named`, its folder or its log, into `folder`; returns its
// index.json. Warns of a log that was cut off, of a run that ended early and of labels that no
// figure contains. Throws config::Error if there is no such run, no sample, no figure of a name in
// `only` or no such channel, and like write_figures().
std::string draw_run(const std::filesystem::path& named, const std::filesystem::path& folder,
                     const DrawingRequest& request, const Notices& notices = {});

// Draws the characteristic of each muscle in the file of an actuator or a robot in the same way, in
// metric units unless others are chosen. Also throws if channels or a time are given, which apply
// to runs only.
std::string draw_muscles(const std::filesystem::path& file, const std::filesystem::path& folder,
                         const DrawingRequest& request, const Notices& notices = {});

// Draws several runs in the same axes; notes report their alignment with the first one. Also throws
// config::Error if there are too many labels or the runs cannot be aligned.
std::string draw_runs(const OverlaidRuns& runs, const std::filesystem::path& folder,
                      const DrawingRequest& request, const Notices& notices = {});

// Returns a file of labels that contains all texts of these runs' figures, as a start.
std::string labels_of_runs(const std::vector<std::filesystem::path>& runs,
                           const DrawingRequest& request);

}  // namespace sinew::run
