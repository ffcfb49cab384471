// report/compare/comparison_text.h - a comparison as tables for people.
#pragma once

#include <cstddef>
#include <string>

#include "sinew/report/compare/comparison.h"
#include "sinew/units/shown.h"

namespace sinew::report {

struct ComparisonText {
  units::ShownUnits units = units::UnitSet::thesis;  // of the tables
  bool all = false;                                  // what is equal too
  std::size_t width = 0;                             // letters of a line; 0: any
  std::string see_all = {};                          // where a table is cut: how to see all of it
  std::string fit_clock = "clock=fit";               // how a clock's rate is taken out
  bool color = false;  // verdicts that changed are red, by the escapes of a terminal
};

// Returns runs, figures, parameters and channels that differ.
std::string text_of(const Comparison& comparison, const ComparisonText& how);

}  // namespace sinew::report
