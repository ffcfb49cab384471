// report/figures/figure_layout.h - layout of a printed figure: by default one column of a journal
// wide, the legend above the data, axes that end at round numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// Sizes in points, 72 to the inch. Most are proportional to the font.
struct Print {
  // Computes the sizes for font and width of a paper.
  explicit Print(const Paper& paper = {});

  double width, font;
  double left, right, top = 6, bottom = 4;
  double line;                        // distance of two lines of text
  double letter;                      // mean width of a letter
  double numbers;                     // height of the numbers below an axis
  double plot, lowest = 60, tallest;  // height of the data: default, least, greatest
  double tick;                        // distance of two numbers at a vertical axis
  double sample, gap;                 // length of a line in the legend; space next to it
};

// Range and ticks of an axis.
struct Scale {
  double from = 0, to = 1;
  double step = 0.5;  // distance of ticks; logarithmic: their factor
};

// A curve's name in the legend.
struct LegendEntry {
  std::size_t curve = 0;
  std::string text;
  double x = 0, y = 0;  // left end of its sample line, from the left and the top [pt]
};

// Layout of one plot of a figure.
struct PlotLayout {
  Scale x, y;
  double left = 0, right = 0;  // distance of the data from the picture's edges [pt]
  double title = 0;            // middle of the title, from the top [pt]
  double top = 0, bottom = 0;  // edges of the data, from the top [pt]
  std::vector<LegendEntry> legend;
  std::vector<std::size_t> curves;  // curves with samples within the axes
};

struct FigureLayout {
  double height = 0;  // [pt]
  std::vector<PlotLayout> plots;
};

// Returns the layout of a figure. Throws std::invalid_argument with the least height if its paper
// is too low for its plots.
FigureLayout layout(const Figure& figure);

// Returns the position of a curve's name: points have no end, so they are named above the data.
Plot::Names naming(const Plot& plot, const Curve& curve);

// Returns a scale that ends at round numbers, with at most seven ticks; given ends are kept.
// `tight`: it ends at the data.
Scale scale(const Axis& axis, double least, double greatest, bool tight);

// Returns the number of letters, not bytes.
std::size_t letters(std::string_view utf8);

}  // namespace sinew::report
