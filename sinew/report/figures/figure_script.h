// report/figures/figure_script.h - a figure as a script for gnuplot, which draws the CSV files
// beside it.
//
// For print: one column of a journal wide, 8 pt, dashes beside colors so that grey will do, the
// legend above the data. All text comes out as it was typed. Written for gnuplot 5.4.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// The formats in which gnuplot draws.
enum class Picture { svg, png };

// To be run in the folder of the sheets; leaves <name>.svg and <name>.png there. The same figure
// gives the same bytes.
std::string script(const Figure& figure, const FigureData& data,
                   const std::vector<Picture>& pictures);

}  // namespace sinew::report
