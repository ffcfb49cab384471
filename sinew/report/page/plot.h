// report/page/charts.h - charts of one quantity against another: points, lines and bands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/report/page/channels.h"

namespace sinew::report {

struct ChartAxis {
  std::string label;  // "length"
  std::string unit;   // SI, "share" of 1, or "Pa diff"; the page converts it
};

// A curve, given by numbers or by two channels with the same times. NaN breaks a line.
struct ChartCurve {
  // The way in which the curve is drawn.
  enum class Style {
    points,
    line,
    held_out,  // points that were held out of a fit
    left_out,  // points that were left out of all fits, hollow: each `mark` has a shape
    other,     // a line of a model that was not chosen
    band       // area between y and y_high
  };

  std::string label;
  Style style = Style::line;
  int color = 0;  // index in the page's palette
  std::vector<double> x, y, y_high;
  Channel x_channel, y_channel;  // used instead of numbers
  std::vector<double> dash;      // lengths of a line's strokes and gaps; empty: solid [px]
  int mark = 0;                  // shape of points that were left out; 0 for others: a disc
  bool bold = false;
  bool hidden = false;  // initially not shown
};

// Curves of a quantity against another, in one picture.
struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  std::string note;  // remark for the reader

  bool empty() const { return curves.empty(); }
};

}  // namespace sinew::report
