// report/figures/overlay.h - figures of several runs aligned with each other.
//
//   const std::vector<Figure> both = overlaid({{"measured", a}, {"simulated", b}});
//
// A run has its own dash. Few channels stay in one plot, each in its color; of more each gets a
// plot of its own, and there a run has its own color too.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/figures/figure.h"

namespace sinew::report {

// The figures of a run, and what it is called in a legend.
struct LabelledRun {
  std::string label;
  std::vector<Figure> figures;
};

// Returns a figure for each name that any run has, in the order in which they come; a plot has the
// curves of all runs that have it, in the unit of the first where units differ by a factor. What
// was desired is there once, where the runs were to do the same. Stance and faults are shaded as in
// the first run. Curves are called "hip, measured", in a plot of one channel "measured".
std::vector<Figure> overlaid(const std::vector<LabelledRun>& runs);

}  // namespace sinew::report
