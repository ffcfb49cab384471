// run/folder/drawn_run.h - the figures of a run that is kept, as a folder of files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/report/figures/run_figures.h"
#include "sinew/run/folder/figure_files.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::run {

// Which figures of a run are drawn, and how.
struct DrawingRequest {
  std::string machine;  // what was run; empty: the run's resolved.toml
  report::RunFigureOptions options;
  std::vector<std::string> only;  // these figures alone; empty: all
  FigureFiles files;
};

// Draws the figures of the run at `named`, its folder or its log, into `folder`; returns its
// index.json. A log that was cut off or a run that was ended are warnings. Throws config::Error
// where there is no such run, no sample or no figure of a name in `only`, and as write_figures().
std::string draw_run(const std::filesystem::path& named, const std::filesystem::path& folder,
                     const DrawingRequest& request, const Notices& notices = {});

}  // namespace sinew::run
