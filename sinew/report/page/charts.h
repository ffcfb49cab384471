// report/page/charts.h - one quantity against another: points, or lines.
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
  enum class Style { points, line, held_out };  // held_out: points that a fit did not see

  std::string label;
  Style style = Style::line;
  int color = 0;  // place in the page's palette
  std::vector<double> x, y;
  Channel x_channel, y_channel;  // in place of numbers
  bool hidden = false;           // until it is asked for
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
