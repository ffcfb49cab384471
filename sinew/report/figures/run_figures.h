// report/figures/run_figures.h - the figures of a recorded run: a figure for each panel of its
// page, from the same series, and paths and loops that have no time axis.
//
//   for (const Figure& f : run_figures({.table = table, .resolved = resolved})) …
//
// Of a robot, in simulation or on hardware, and of the test stand. What a page hides until it is
// asked for is left out.
#pragma once

#include <limits>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/report/figures/figure.h"
#include "sinew/report/page/page.h"
#include "sinew/units/shown.h"

namespace sinew::report {

// How the figures of a run are made.
struct RunFigureOptions {
  units::ShownUnits units = {};
  double from = -std::numeric_limits<double>::infinity();  // samples that are shown [s]
  double to = std::numeric_limits<double>::infinity();
};

// Stance by plan, foot plant and propulsion as one  [s].
std::vector<Span> stance_of(const analysis::Record& record, const analysis::Machine& machine);

// Throws config::Error for a resolved.toml that cannot be read.
std::vector<Figure> run_figures(const Run& run, const RunFigureOptions& options = {});

}  // namespace sinew::report
