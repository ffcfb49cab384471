// run/folder/figure_files.h - a folder of figures: CSV, scripts and pictures, and two indices that
// describe them, index.json and the page index.html.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"
#include "sinew/report/figures/gallery.h"
#include "sinew/report/figures/gnuplot.h"
#include "sinew/report/figures/labels.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/notices.h"
#include "sinew/units/shown.h"

namespace sinew::run {

struct FigureFiles {
  std::vector<report::Picture> pictures{report::Picture::svg, report::Picture::png};
  report::Labels labels = {};  // used in the pictures
  bool must_draw = false;      // the pictures were explicitly requested
  bool force = false;
};

// Kind of index.json, which lists the files that may be replaced.
inline constexpr FileKind figures_kind{"index of figures", "such an index",
                                       "{\"format\":\"sinew.figures/", FileKind::At::start};

// Writes <sheet>.csv, <figure>.gp, index.json and index.html, and draws the pictures with gnuplot.
// Refuses to replace files unless `force` is set; then the files of an earlier index.json, and no
// others, are removed after the new figures are complete. Without gnuplot, writes everything but
// the pictures, with a warning, or throws std::runtime_error if `must_draw` is set. Fills the
// gallery's pictures and scripts; returns index.json.
std::string write_figures(const std::filesystem::path& folder, report::Gallery gallery,
                          const FigureFiles& options, const Notices& notices);

// Returns the files that the folder's index.json lists, followed by index.json itself; empty if
// there is no index of figures.
std::vector<std::string> figures_in(const std::filesystem::path& folder);

// Figures of the characteristic of a muscle: tension over length at several pressures, by the
// law of its file.

// Returns whether the path names a TOML file, which may hold muscles and is not a run.
bool is_muscle_file(const std::filesystem::path& named);

// Returns a figure for each actuator in the file of a robot or of one actuator, from its shortest
// to its greatest length. Throws config::Error for a file without actuators.
std::vector<report::Figure> muscle_figures(const std::filesystem::path& file,
                                           const units::ShownUnits& units);

}  // namespace sinew::run
