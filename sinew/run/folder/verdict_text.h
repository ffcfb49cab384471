// run/folder/verdict_text.h - what a source reports of a run, compared with its results, as text.
#pragma once

#include <cstddef>
#include <string>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/units/shown.h"

namespace sinew::run {

struct VerdictLayout {
  std::size_t width = 0;  // letters in a line; 0: any number
  bool color = false;     // green and red verdicts, for a terminal
};

// Returns the title and a table of verdicts: in the source's own units, or in those of `shown`. Of
// a run of which nothing is reported, its main results.
std::string verdicts_text(const analysis::Summary& summary, const analysis::Machine& machine,
                          const units::ShownUnits* shown = nullptr,
                          const VerdictLayout& layout = {});

}  // namespace sinew::run
