// cli/alignment.h - options for the alignment of runs with the first one: of `compare` and
// `film`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cli/command.h"
#include "sinew/report/compare/comparison.h"

namespace sinew::cli {

inline constexpr int most_runs = 8;  // colors that can be told apart

// The options as they are given.
struct Alignment {
  std::vector<std::string> align_by;
  std::string align = "start", clock = "none", event;
  double most_shift = std::numeric_limits<double>::infinity();  // [s]

  // Returns what they wish for.
  report::AlignWish wish() const;

  // Returns the setting of one that was given, "align_by"; "" where none was.
  std::string given() const;
};

void add_alignment(CLI::App& sub, Alignment& alignment);

}  // namespace sinew::cli
