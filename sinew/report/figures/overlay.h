// report/figures/overlay.h - figures of several runs aligned with each other.
//
//   const std::vector<Figure> both = overlaid({{"measured", a}, {"simulated", b}});
//
// A run has its own dash. A few channels share one plot, each in its color; of more channels each
// gets a plot of its own, in which a run has its own color too.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// The figures of a run, and its name in a legend.
struct LabelledRun {
  std::string label;
  std::vector<Figure> figures;
};

// Returns a figure for each name that any run has, in the order of occurrence. A plot has the
// curves of all runs that have it, in the unit of the first one if units differ by a factor. Equal
// desired curves of several runs are drawn once. Stance and faults are shaded as in the first run.
// Curves are named "hip, measured", in a plot of one channel "measured".
std::vector<Figure> overlaid(const std::vector<LabelledRun>& runs);

}  // namespace sinew::report
