// tune/sensitivity_table.h - a sensitivity study: the sweep that it runs, and what it says, as rows
// and as JSON.
//
//   const Sweep runs = sweep_of(design, base);           // base.sample has the ranges
//   const std::vector<Row> rows = sweep(runs, {.threads = 2});
//   for (const FigureSensitivity& f : sensitivities(design, runs, rows)) ...
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/tune/sensitivity.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {

// Returns the sweep with the design's points in its ranges. Throws config::Error where it varies or
// searches anything beside them, reports nothing, or has more than most_points.
Sweep sweep_of(const Design& design, Sweep base);

struct FigureSensitivity {
  std::string figure;                // as the sweep heads it, "trolley.distance [in]"
  std::optional<Sensitivity> found;  // none: too few runs have the figure, or it never changes
};

// Returns what each reported figure says of the ranges, in the figure's unit. Expects all rows.
std::vector<FigureSensitivity> sensitivities(const Design& design, const Sweep& runs,
                                             const std::vector<Row>& rows);

// Returns the table of all figures and ranges: the heading of each column, then a row for each. A
// figure without an answer has rows with empty cells.
std::vector<std::string> sensitivity_headings(Method method);
std::vector<std::vector<std::string>> sensitivity_rows(const Design& design, const Sweep& runs,
                                                       const std::vector<FigureSensitivity>& all);

// Returns the same in format sinew.sensitivity/1, with mean, standard deviation and what was left
// out.
std::string sensitivity_json(const Design& design, const Sweep& runs,
                             const std::vector<FigureSensitivity>& all);

}  // namespace sinew::tune
