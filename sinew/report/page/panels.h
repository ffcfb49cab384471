// report/page/panels.h - which channels are plotted together: a run's panels, from top to bottom.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/channels.h"

namespace sinew::report {

// One channel of a panel.
struct Line {
  enum class Style { measured, desired, hidden };  // full, dashed; not shown until asked for

  std::string label;
  Channel channel;
  int color = 0;  // place in the page's palette: one for each joint, muscle or component
  Style style = Style::measured;
};

// Channels that are plotted together.
struct Panel {
  std::string group;  // "Joints"
  std::string title;  // "Joint angles"
  std::string unit;   // SI, or "share" of 1; the page shows it in others
  std::vector<Line> lines;
};

// Panels of what the channels hold, empty ones left out. What no panel knows comes last, by unit.
std::vector<Panel> panels(const Channels& channels, const analysis::Machine& machine);

}  // namespace sinew::report
