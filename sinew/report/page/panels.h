// report/page/panels.h - panels of a run, from top to bottom: the channels that are plotted
// together.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/channels.h"

namespace sinew::report {

// One channel of a panel.
struct Line {
  enum class Style { measured, desired, hidden };  // solid, dashed, initially not shown

  std::string label;
  Channel channel;
  int color = 0;  // index in the page's palette: one for each joint, muscle or component
  Style style = Style::measured;
};

// Channels that are plotted together.
struct Panel {
  std::string group;  // "Joints"
  std::string title;  // "Joint angles"
  std::string unit;   // SI, or "share" of 1; the page converts it
  std::vector<Line> lines;
};

// Returns the panels of the channels, without empty ones. Channels that no panel has come last, by
// unit.
std::vector<Panel> panels(const Channels& channels, const analysis::Machine& machine);

}  // namespace sinew::report
