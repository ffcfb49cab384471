// report/figures/figure_script.h - a figure as a script for gnuplot, which draws the CSV files
// beside it.
//
// For print: as wide as its paper, dashes beside colors so that grey will do, the
// legend above the data. All text comes out as it was typed. Written for gnuplot 5.4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

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

}  // namespace sinew::report
