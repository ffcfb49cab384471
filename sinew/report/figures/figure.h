// report/figures/figure.h - a figure as data, independent of the program that draws it.
//
//   Figure      a name, a caption, plots below each other (report/page/plot.h)
//
// data() arranges the numbers in sheets and gnuplot.h draws the CSV files of these sheets, so that
// a picture and its numbers cannot differ.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/report/page/plot.h"

namespace sinew::report {

// Size of a printed figure.
struct Paper {
  double width = 252;          // [pt], 72 to the inch: 89 mm, the column of a journal
  double height = 0;           // [pt]; 0: the default height of the plots
  double font = 7;             // size of the letters [pt]
  bool decimal_comma = false;  // "0,5" at the ticks
};

// A missing part of a figure, and the reason.
struct Missing {
  std::string what, why;
};

struct Figure {
  std::string name;  // base name of the files, by file_name_of(): "6-4", "joint-angles"
  std::string title, caption;
  std::vector<Plot> plots;
  std::vector<Missing> missing = {};
  Paper paper = {};
};

// The numbers of curves with the same x: one file.
struct Sheet {
  std::string name;                          // file name without .csv
  std::vector<std::string> headings;         // "time [s]"
  std::vector<std::vector<double>> columns;  // x first, all of one length
};

// Position of a curve's numbers: sheet, and column of y; x is the first column.
struct Place {
  std::size_t sheet = 0, column = 0;
};

// A figure's numbers as tables, and the position of each curve in them.
struct FigureData {
  std::vector<Sheet> sheets;
  std::vector<std::vector<Place>> places;  // for each plot and curve
};

// Returns the numbers of a figure. Curves of one plot with the same xs share a sheet. Its name is
// the figure's, with the plot's name if there are several and the first curve's name if xs differ.
// Throws std::invalid_argument for a curve with unequal numbers of xs and ys, with the names of
// figure and curve, and for a figure whose name is not one of file_name_of().
FigureData data(const Figure& figure);

// Returns CSV with the fewest digits that read back to the same bits. A gap is written NaN, because
// gnuplot draws a line across an empty cell.
std::string csv(const Sheet& sheet);

// Returns the name of a kind.
std::string_view to_text(Curve::Kind kind);

// Returns a path without repeated points, with gaps in their place: overlapping dashes would look
// like a solid line.
Curve once(const Curve& path);

// Returns a file name for a text: "Hip flexor: at 45 psi" -> "hip-flexor-at-45-psi".
std::string file_name_of(std::string_view text);

}  // namespace sinew::report
