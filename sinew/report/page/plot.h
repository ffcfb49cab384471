// report/page/plot.h - description of a plot: curves of numbers or of channels in one pair of axes.
//
// Pages, comparisons, fits and printed figures draw the same description. Over time the x axis has
// no name. A page converts the units; a printed figure is in the units of its axes.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::report {

// A field of a topic.
struct Channel {
  std::string topic;  // empty: no channel
  std::string field = "value";

  // Returns whether this is no channel.
  bool is_empty() const { return topic.empty(); }
  // Returns "/foot/position.x"; of the field "value" the topic alone.
  std::string name() const { return field == "value" ? topic : topic + "." + field; }
  bool operator==(const Channel&) const = default;
};

// A channel's samples; points into a table.
struct Samples {
  const signals::Times* time_ns = nullptr;
  const signals::Column* values = nullptr;
  std::string unit;

  explicit operator bool() const { return values && !values->empty(); }
};

// Recorded, derived and drawn series. If several tables have a channel, the first one counts.
class Channels {
 public:
  void add(const signals::Table& table) { tables_.push_back(&table); }  // must outlive this
  // Returns the samples of the first table that has the channel; empty if no table has it.
  Samples find(const Channel& channel) const;
  bool has(const Channel& channel) const { return static_cast<bool>(find(channel)); }
  // Returns the first of these topics that has samples; is_empty() if no topic has.
  Channel first_of(std::initializer_list<std::string> topics) const;
  const std::vector<const signals::Table*>& tables() const { return tables_; }

 private:
  std::vector<const signals::Table*> tables_;
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

// A curve of one quantity over another, given by numbers or by channels, and its style.
struct Curve {
  // Steps: a value holds until the next one. Marked: a line with a mark on each sample. Held out,
  // left out: points that were not used by a fit, or by no fit. Other: the line of a model that was
  // not chosen. Band: the area between ys and ys_high.
  enum class Style { line, marked, steps, points, bars, held_out, left_out, other, band };
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

  std::vector<double> ys_high{};     // upper line of a band
  Channel x_channel{}, y_channel{};  // used instead of numbers; without the first one: over time
  std::vector<double> strokes{};     // lengths of a line's strokes and gaps on a page; empty: solid
  int mark = 0;                      // shape of points that were left out; 0: a disc
  bool bold = false;
  bool hidden = false;  // initially not shown on a page
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
  std::string group{};  // group of plots on a page, "Joints"
  std::string note{};   // remark for the reader of a page
};

}  // namespace sinew::report
