// report/figures/run_figures.h - the figures of a recorded run: a figure for each panel of its
// page, from the same series, and paths and loops that have no time axis.
//
//   for (const Figure& f : run_figures({.analysis = analysis, .resolved = resolved})) …
//
// Of a robot, in simulation or on hardware, and of the test stand. What a page hides until it is
// asked for is left out.
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

// Channels that stand in one plot: those for whose topic it returns true. A channel of a simulation
// is asked for without /true, too, where no other has the name that is left.
struct ChosenChannels {
  std::string name;  // of the plot, "/joint/*/angle"
  std::function<bool(std::string_view topic)> has;
};
// Plots below each other.
using ChosenFigure = std::vector<ChosenChannels>;

// How the figures of a run are made.
struct RunFigureOptions {
  units::ShownUnits units = {};
  double from = -std::numeric_limits<double>::infinity();  // samples that are shown [s]
  double to = std::numeric_limits<double>::infinity();
  std::vector<ChosenFigure> channels = {};  // figures of these in place of the page's panels
};

// Returns the names of the topics that a run's figures can show: recorded ones and those that are
// made of them. Throws as run_figures() does.
std::vector<std::string> topics_of(const Run& run);

// Stance by plan, foot plant and propulsion as one  [s].
std::vector<Span> stance_of(const analysis::Record& record, const analysis::Machine& machine);

// Throws config::Error for a resolved.toml that cannot be read.
std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options = {});

}  // namespace sinew::report
