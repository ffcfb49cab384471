// report/figures/figure.h - a figure as data: what a picture shows, before anything is drawn.
//
//   Figure      a name, a caption, plots under each other
//   Plot        two axes, curves, shaded spans of x
//   Curve       a label, numbers, and what they are
//
// data() lays the numbers out as CSV files, gnuplot.h draws those files: a picture and its
// numbers cannot differ.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::report {

// Says what a figure is printed on.
struct Paper {
  double width = 252;          // of the picture [pt], 72 to the inch: 89 mm, a journal's column
  double height = 0;           // [pt]; 0: as high as the plots want to be
  double font = 7;             // size of the letters [pt]
  bool decimal_comma = false;  // "0,5" at the ticks
};

// An axis with its range and unit.
struct Axis {
  static constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

  std::string name;                         // "joint angle"
  std::string unit;                         // "deg"; "-" for a plain number
  double from = automatic, to = automatic;  // in that unit; automatic: as far as the data go
  bool logarithmic = false;

  // In the place of numbers, and of the title: names of rows.
  struct Tick {
    double at = 0;
    std::string text;
  };
  std::vector<Tick> ticks = {};
  double scale = 0;  // how much of the unit one of SI is; 0: nobody knows

  std::string title() const;  // "joint angle [deg]"; a plain number has its name alone
};

// One quantity over another, and how it is drawn.
struct Curve {
  // Steps: a value holds until the next one. Marked: a line with a mark on each sample.
  enum class Style { line, marked, steps, points, bars };
  // Computed: by a law or a simulation. Measured: on hardware. Desired: asked of a controller.
  // Synthetic: in the place of a measurement that is lost; its label says so in the legend.
  enum class Kind { computed, measured, desired, synthetic };
  static constexpr int next = -1;

  std::string label;           // in the legend; empty: not there, and the file has the axis's name
  std::vector<double> xs, ys;  // in the axes' units; NaN in y: a gap
  Kind kind = Kind::computed;
  Style style = Style::line;
  int color = next;       // place in the palette; a desired curve has its actual one's
  int dash = next;        // place among the dashes; else that of the color
  std::string source;     // law, run or file that the numbers come from
  bool in_legend = true;  // or named where it ends
};

// Shaded from bottom to top: stance; or, between two lines, the time of a fault.
struct Span {
  // Why it is shaded.
  enum class Of { stance, fault };
  double from = 0, to = 0;  // in x
  Of of = Of::stance;
};

// Curves in one pair of axes.
struct Plot {
  // Of its curves: above the data, or each where it ends on the right. None: rows have theirs, and
  // lines need no dashes.
  enum class Names { legend, ends, none };

  std::string name;   // in file names, where a figure has several plots: "stiffness"
  std::string title;  // above it; empty: none
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Span> spans;
  bool equal_scale = false;  // a length is as long in x as in y
  Names names = Names::legend;
};

// What belongs into a figure and is not there.
struct Missing {
  std::string what, why;
};

struct Figure {
  std::string name;  // of its files, letters that every system takes: "6-4", "joint-angles"
  std::string title, caption;
  std::vector<Plot> plots;
  std::vector<Missing> missing = {};
  Paper paper = {};
};

// The numbers of curves with the same x, side by side: one file.
struct Sheet {
  std::string name;                          // of the file, without .csv
  std::vector<std::string> headings;         // "time [s]"
  std::vector<std::vector<double>> columns;  // x first, all of one length
};

// Where a curve's numbers are: sheet, and column of y; x is its first column.
struct Place {
  std::size_t sheet = 0, column = 0;
};

// A figure's numbers as tables, and where in them each curve stands.
struct FigureData {
  std::vector<Sheet> sheets;
  std::vector<std::vector<Place>> places;  // of each curve of each plot
};

// Curves of one plot with the same xs share a sheet. It is called as its figure, its plot where
// there are several, and its first curve where xs differ. Throws std::invalid_argument for a curve
// with unlike numbers of xs and ys, naming figure and curve, and for a
// figure whose name is not one that file_name_of() gives.
FigureData data(const Figure& figure);

// With the fewest digits that read back to the same bits. A gap is NaN: gnuplot draws a line across
// an empty cell.
std::string csv(const Sheet& sheet);

// Returns its word.
std::string_view to_text(Curve::Kind kind);

// A path without the points at which it was before: dashes that run over each other would look like
// a full line. A gap stands where points are left out.
Curve once(const Curve& path);

// "Hip flexor: at 45 psi" -> "hip-flexor-at-45-psi": a name for a file.
std::string file_name_of(std::string_view text);

}  // namespace sinew::report
