// report/page/charts.h - one quantity against another: points, lines and bands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/report/page/channels.h"

namespace sinew::report {

struct ChartAxis {
  std::string label;  // "length"
  std::string unit;   // SI, "share" of 1, or "Pa diff"; the page shows it in others
};

// Either numbers, or two channels of one clock. A number that is none breaks a line.
struct ChartCurve {
  // Says what is drawn at the numbers.
  enum class Style {
    points,
    line,
    held_out,  // points that a fit did not see
    left_out,  // points that none was to see, hollow: each `mark` has a shape
    other,     // a line of a model that was not chosen
    band       // from y to y_high
  };

  std::string label;
  Style style = Style::line;
  int color = 0;  // place in the page's palette
  std::vector<double> x, y, y_high;
  Channel x_channel, y_channel;  // in place of numbers
  std::vector<double> dash;      // of a line: lengths of its strokes and gaps; empty: none [px]
  int mark = 0;                  // shape of points that were left out; of others 0 is a disc
  bool bold = false;
  bool hidden = false;  // until it is asked for
};

// A quantity against another, in one picture.
struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  std::string note;  // what one should know when looking at it

  bool empty() const { return curves.empty(); }
};

}  // namespace sinew::report
