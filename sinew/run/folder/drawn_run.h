// run/folder/drawn_run.h - the figures of runs that are kept, as a folder of files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/align/align.h"
#include "sinew/report/figures/gnuplot.h"
#include "sinew/report/figures/run_figures.h"
#include "sinew/run/folder/figure_files.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::run {

// Which figures of a run are drawn, and how.
struct DrawingRequest {
  std::string machine = {};  // what was run; empty: the run's resolved.toml
  // As units/shown.h reads them; empty: as the run, the person or the environment says.
  std::string units = {};
  report::RunFigureOptions options = {};  // without units and channels
  // Figures of these channels in place of the page's panels: each text is a figure, and what stands
  // between commas a plot of it: "/joint/*/angle,/muscle/*/tension". * stands for any letters.
  std::vector<std::string> channels = {};
  std::vector<std::string> only = {};  // these figures alone; empty: all
  std::string title = {};              // above the picture, of one figure alone
  report::Paper paper = {};
  FigureFiles files = {};
};

// Runs that are aligned with each other.
struct OverlaidRuns {
  std::vector<std::filesystem::path> runs;  // folders, or logs
  std::vector<std::string> labels = {};     // of the first ones; else a run is called as its folder
  // alignment of the others' times with those of the first one; absent: they begin
  // together.
  std::optional<analysis::AlignRequest> align = {};
};

// Draws the figures of the run at `named`, its folder or its log, into `folder`; returns its
// index.json. A log that was cut off or a run that was ended are warnings, and so are labels that
// no figure has. Throws config::Error where there is no such run, no sample, no figure of a name in
// `only`, or no such channel, and as write_figures().
std::string draw_run(const std::filesystem::path& named, const std::filesystem::path& folder,
                     const DrawingRequest& request, const Notices& notices = {});

// Draws the characteristic of each muscle of an actuator's or a robot's file in the same way, in
// metric units where none are chosen. Throws, too, for channels or a time, which are a run's.
std::string draw_muscles(const std::filesystem::path& file, const std::filesystem::path& folder,
                         const DrawingRequest& request, const Notices& notices = {});

// Draws several runs in the same axes; notes say how they were aligned with the first one. Throws
// config::Error, too, where there are no such labels, or the runs cannot be aligned with each
// other.
std::string draw_runs(const OverlaidRuns& runs, const std::filesystem::path& folder,
                      const DrawingRequest& request, const Notices& notices = {});

// Returns a file of labels, to begin with, of all that the figures of these runs say.
std::string labels_of_runs(const std::vector<std::filesystem::path>& runs,
                           const DrawingRequest& request);

}  // namespace sinew::run
