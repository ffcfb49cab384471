// cli/figure_files.h - a folder of figures: CSV, scripts and pictures, and index.json that tells
// what each of them shows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/terminal.h"
#include "sinew/report/figure.h"
#include "sinew/report/figure_script.h"

namespace sinew::cli {

struct FigureFiles {
  std::vector<report::Picture> pictures{report::Picture::svg, report::Picture::png};
  bool must_draw = false;  // the pictures were asked for by name
  bool force = false;
};

// "svg,png,csv" -> pictures; throws config::Error for another word. "csv" alone draws nothing.
std::vector<report::Picture> parse_formats(const std::vector<std::string>& words);

// Writes <sheet>.csv, <figure>.gp and index.json, and draws the pictures with gnuplot. Refuses to
// replace anything, unless `force`; then what an earlier index.json lists is removed first, and
// nothing else. Where there is no gnuplot all but the pictures is written, with a warning, or, if
// they must be drawn, a std::runtime_error. Returns the index.
std::string write_figures(const std::filesystem::path& folder,
                          const std::vector<report::Figure>& figures, const FigureFiles& options,
                          const Messages& messages);

// What index.json says: of each figure its files, with those pictures and perhaps scripts; of each
// curve what it is and where its numbers are.
std::string figure_index(const std::vector<report::Figure>& figures,
                         const std::vector<report::Picture>& pictures, bool scripts);

}  // namespace sinew::cli
