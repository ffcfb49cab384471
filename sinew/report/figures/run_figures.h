// report/figures/run_figures.h - the figures of a recorded run: a figure for each panel of its
// page, from the same series, and paths and loops that have no time axis.
//
//   for (const Figure& f : run_figures({.analysis = analysis, .resolved = resolved})) …
//
// Runs of a robot, in simulation or on hardware, and of the test stand have figures. Lines that the
// page initially hides are left out.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/report/figures/figure.h"
#include "sinew/report/page/page.h"
#include "sinew/units/shown.h"

namespace sinew::report {

// Channels of one plot: those for whose topic `has` returns true. If no topic matches, topics under
// /true are matched by their names without /true.
struct ChosenChannels {
  std::string name;  // name of the plot, "/joint/*/angle"
  std::function<bool(std::string_view topic)> has;
};
// Plots below each other.
using ChosenFigure = std::vector<ChosenChannels>;

// Options of the figures of a run.
struct RunFigureOptions {
  units::ShownUnits units = {};
  double from = -std::numeric_limits<double>::infinity();  // first time that is shown [s]
  double to = std::numeric_limits<double>::infinity();     // last time [s]
  std::vector<ChosenFigure> channels = {};  // figures of these instead of the page's panels
};

// Returns the topics that a run's figures can show, recorded and derived. Throws as run_figures()
// does.
std::vector<std::string> topics_of(const Run& run);

// Returns the spans of stance by plan, foot plant and propulsion as one  [s].
std::vector<Span> stance_of(const analysis::Record& record, const analysis::Machine& machine);

// Returns the figures of a run. Throws config::Error for a resolved.toml that cannot be read.
std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options = {});

}  // namespace sinew::report
