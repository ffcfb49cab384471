// identify/page/fit_page.h - a report as one page: what was measured and what the models say of it.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/report/page/charts.h"

namespace sinew::identify {

// Returns what was measured and what the models say of it, then what they leave; no chart where the
// report tells no rows.
std::vector<report::Chart> charts_of(const Report& report);

struct Page {
  std::string title, version;          // of the program that made it
  std::vector<std::string> data;       // what was read, in words
  double atmosphere = 0;               // that gauges read against [Pa]
  std::vector<const Report*> reports;  // of one calibration there may be several
  std::string parameter_file;          // its text, for the table of values; may be empty
};

// Returns the page as HTML. Throws std::runtime_error where the library was built without its page,
// config::Error where the parameter file cannot be read.
std::string page(const Page& page);

}  // namespace sinew::identify
