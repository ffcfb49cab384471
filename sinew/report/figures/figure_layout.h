// report/figures/figure_layout.h - where the parts of a printed figure stand: one column of a
// journal wide, the legend above the data, axes that end at round numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Sizes in points, 72 to the inch: they grow with the letters.
struct Print {
  // Sizes for letters and width of that paper.
  explicit Print(const Paper& paper = {});

  double width, font;
  double left, right, top = 6, bottom = 4;
  double line;     // from line to line
  double letter;   // mean width
  double numbers;  // below the axis, at its ticks
  double plot, lowest = 60, tallest;
  double tick;         // between two numbers above each other
  double sample, gap;  // of a line in the legend; beside it
};

// Of one axis, as drawn.
struct Scale {
  double from = 0, to = 1;
  double step = 0.5;  // between ticks; logarithmic: a factor
};

// A curve's name in the legend.
struct LegendEntry {
  std::size_t curve = 0;
  std::string text;
  double x = 0, y = 0;  // middle of its sample's left end, from the left and from the top [pt]
};

// Where one plot of a figure stands.
struct PlotLayout {
  Scale x, y;
  double left = 0, right = 0;  // of the data, from the picture's edges [pt]
  double title = 0;            // its middle, from the top [pt]
  double top = 0, bottom = 0;  // of the data, from the top [pt]
  std::vector<LegendEntry> legend;
  std::vector<std::size_t> curves;  // those that have samples within the axes
};

struct FigureLayout {
  double height = 0;  // [pt]
  std::vector<PlotLayout> plots;
};

// Returns where everything in the figure stands. Throws std::invalid_argument, with the least
// height, where its plots have no room in the height of its paper.
FigureLayout layout(const Figure& figure);

// Where that curve has its name: points have no end, so theirs stands above the data.
Plot::Names naming(const Plot& plot, const Curve& curve);

// Ends at round numbers with at most seven ticks; what the axis prescribes stays. `tight`: ends
// where the data do.
Scale scale(const Axis& axis, double least, double greatest, bool tight);

// Letters, not bytes.
std::size_t letters(std::string_view utf8);

}  // namespace sinew::report
