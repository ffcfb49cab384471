// report/figures/gnuplot.h - gnuplot as a process of its own, without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Is there one on the PATH?
bool has_gnuplot();

// Runs each script of the folder in a process of its own, so that none sees what another one set,
// several at a time. Returns the scripts that failed; gnuplot's own words go to stderr.
std::vector<std::string> draw(const std::filesystem::path& folder,
                              const std::vector<std::string>& scripts);

// Takes the date out of a PDF that gnuplot has drawn, so that the same figure gives the same bytes.
void take_date_out(const std::filesystem::path& pdf);

// A figure as a script for gnuplot, which draws the CSV files in the same folder.
//
// For print: as wide as its paper, with dashes in addition to colors so that grey will do, the
// legend above the data. All text comes out as it was typed. Written for gnuplot 5.4.

// The formats in which gnuplot draws.
enum class Picture { svg, png, pdf };

// Returns the ending of its files, "svg".
std::string_view ending(Picture picture);

// Returns the format whose files end so; nothing where none does.
std::optional<Picture> picture_of(std::string_view ending);

// To be run in the folder of the sheets; leaves <name>.svg, <name>.png and <name>.pdf there, those
// that are asked for. The same figure gives the same bytes.
std::string script(const Figure& figure, const FigureData& data,
                   const std::vector<Picture>& pictures);

// What a figure is printed on, as people say it: "84 mm", "9 pt".

// An empty text leaves what is usual. Throws config::Error that begins with width, height or font,
// for what is no length or no paper has.
Paper read_paper(const std::string& width, const std::string& height, const std::string& font);

}  // namespace sinew::report
