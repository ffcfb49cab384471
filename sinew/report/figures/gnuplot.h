// report/figures/gnuplot.h - figures drawn by gnuplot, run as a process without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Returns whether gnuplot is on the PATH.
bool has_gnuplot();

// Runs each script of the folder in a process of its own, several at a time, so that scripts cannot
// affect each other. Returns the scripts that failed; gnuplot's messages go to stderr.
std::vector<std::string> draw(const std::filesystem::path& folder,
                              const std::vector<std::string>& scripts);

// Removes the date from a PDF of gnuplot, so that the same figure gives the same bytes.
void take_date_out(const std::filesystem::path& pdf);

// --- Scripts ---
//
// A script draws the CSV files in its folder, for print: as wide as its paper, with dashes in
// addition to colors so that it can be printed in grey, the legend above the data. All text is
// drawn literally. Written for gnuplot 5.4.

// Formats in which gnuplot draws.
enum class Picture { svg, png, pdf };

// Returns the ending of a format's files, "svg".
std::string_view ending(Picture picture);

// Returns the format of an ending; empty if there is no such format.
std::optional<Picture> picture_of(std::string_view ending);

// Returns a script that runs in the folder of the sheets and writes <name>.svg, <name>.png and
// <name>.pdf there, as requested. The same figure gives the same bytes.
std::string script(const Figure& figure, const FigureData& data,
                   const std::vector<Picture>& pictures);

// Reads the size of a figure: "84 mm", "9 pt"; an empty text leaves the default. Throws
// config::Error that begins with width, height or font for a text that is no length or out of
// range.
Paper read_paper(const std::string& width, const std::string& height, const std::string& font);

}  // namespace sinew::report
