// report/compare/comparison_text.h - text tables of a comparison.
#pragma once

#include <cstddef>
#include <string>

#include "sinew/report/compare/comparison.h"
#include "sinew/units/shown.h"

namespace sinew::report {

struct ComparisonText {
  units::ShownUnits units = units::UnitSet::thesis;  // units of the tables
  bool all = false;                                  // include equal rows
  std::size_t width = 0;                             // letters of a line; 0: any
  std::string see_all = {};                          // hint shown where a table is cut
  std::string fit_clock = "clock=fit";               // option that removes a clock's rate
  bool color = false;  // verdicts that changed are red, by the escapes of a terminal
};

// Returns tables of the runs, and of figures, parameters and channels that differ.
std::string text_of(const Comparison& comparison, const ComparisonText& how);

}  // namespace sinew::report
