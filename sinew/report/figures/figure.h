// report/figures/figure.h - a figure as data, independent of the program that draws it.
//
//   Figure      a name, a caption, plots below each other
//   Plot        two axes, curves, shaded spans of x
//   Curve       a label, numbers, and their kind
//
// data() arranges the numbers in sheets and gnuplot.h draws the CSV files of these sheets, so that
// a picture and its numbers cannot differ.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::report {

// Size of a printed figure.
struct Paper {
  double width = 252;          // [pt], 72 to the inch: 89 mm, the column of a journal
  double height = 0;           // [pt]; 0: the default height of the plots
  double font = 7;             // size of the letters [pt]
  bool decimal_comma = false;  // "0,5" at the ticks
};

// An axis with its range and unit.
struct Axis {
  static constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

  std::string name;                         // "joint angle"
  std::string unit;                         // "deg"; "-" for a plain number
  double from = automatic, to = automatic;  // in `unit`; automatic: the range of the data
  bool logarithmic = false;

  // Names of rows, shown instead of numbers and title.
  struct Tick {
    double at = 0;
    std::string text;
  };
  std::vector<Tick> ticks = {};
  double scale = 0;  // size of the SI unit in `unit`; 0: unknown

  std::string title() const;  // "joint angle [deg]"; a plain number has its name alone
};

// A curve of one quantity over another, and its style.
struct Curve {
  // Steps: a value holds until the next one. Marked: a line with a mark on each sample.
  enum class Style { line, marked, steps, points, bars };
  // Computed: by a law or a simulation. Measured: on hardware. Desired: setpoint of a controller.
  // Synthetic: replaces a measurement that is lost, and is marked so in the legend.
  enum class Kind { computed, measured, desired, synthetic };
  static constexpr int next = -1;

  std::string label;           // empty: not in the legend, and the file uses the axis's name
  std::vector<double> xs, ys;  // in the axes' units; NaN in y: a gap
  Kind kind = Kind::computed;
  Style style = Style::line;
  int color = next;       // index in the palette; a desired curve has its actual one's
  int dash = next;        // index of the dash; next: that of the color
  std::string source;     // law, run or file of the numbers
  bool in_legend = true;  // false: the label is not drawn
};

// A shaded range of x: stance, or the time of a fault between two lines.
struct Span {
  // Event that the span marks.
  enum class Of { stance, fault };
  double from = 0, to = 0;  // in x
  Of of = Of::stance;
};

// Curves in one pair of axes.
struct Plot {
  // Position of the curves' names: in a legend above the data, or at each curve's right end. None:
  // the rows have names, and lines need no dashes.
  enum class Names { legend, ends, none };

  std::string name;   // part of file names if a figure has several plots: "stiffness"
  std::string title;  // drawn above the plot; empty: no title
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Span> spans;
  bool equal_scale = false;  // both axes have the same scale
  Names names = Names::legend;
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
