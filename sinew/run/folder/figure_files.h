// run/folder/figure_files.h - a folder of figures: CSV, scripts and pictures, and two indices that
// tell what each of them shows, index.json and the page index.html.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/report/figures/figure.h"
#include "sinew/report/figures/gallery.h"
#include "sinew/report/figures/gnuplot.h"
#include "sinew/report/figures/labels.h"
#include "sinew/run/folder/notices.h"
#include "sinew/units/shown.h"

namespace sinew::run {

struct FigureFiles {
  std::vector<report::Picture> pictures{report::Picture::svg, report::Picture::png};
  report::Labels labels = {};  // of the pictures
  bool must_draw = false;      // the pictures were asked for by name
  bool force = false;
};

// Writes <sheet>.csv, <figure>.gp, index.json and index.html, and draws the pictures with gnuplot.
// Refuses to replace anything, unless `force`; then what an earlier index.json lists goes when the
// new figures are whole, and nothing else. Where there is no gnuplot all but the pictures is
// written, with a warning, or, if they must be drawn, a std::runtime_error. Fills the gallery's
// pictures and scripts; returns index.json.
std::string write_figures(const std::filesystem::path& folder, report::Gallery gallery,
                          const FigureFiles& options, const Notices& notices);

// Returns the files that the folder's index.json lists, and the index, which comes last; none where
// there is no index of figures.
std::vector<std::string> figures_in(const std::filesystem::path& folder);

// What is told of a run of which nothing is reported.

// Returns lines of text: times, the way, each joint's excursion, error and passiveness, air. No
// paper gives the units here, so lengths are in millimetres.
// Or in those that `shown` has, where there are some.
std::string main_figures(const analysis::Summary& summary, const analysis::Machine& machine,
                         const units::ShownUnits* shown = nullptr);

// The characteristic of a muscle as figures: tension over length at several pressures, by the law
// of its file.

// Returns whether the path names a TOML file, which may hold muscles, and not a run.
bool is_muscle_file(const std::filesystem::path& named);

// Returns a figure for each actuator of the file, of a robot's or of one actuator, from its
// shortest to its greatest length. Throws config::Error for a file without actuators.
std::vector<report::Figure> muscle_figures(const std::filesystem::path& file,
                                           const units::ShownUnits& units);

}  // namespace sinew::run
