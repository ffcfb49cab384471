// report/page/fit_page.h - what an identification found as one self-contained page: every model
// that was tried, why one was chosen, its values, and what was measured beside what they say.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/page/charts.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/parameters.h"

namespace sinew::report {

// One report of `sinew identify`: of several sensors each has its own.
struct FitPart {
  std::string report;  // JSON of format sinew.identification/1
  std::vector<Chart> charts;
};

struct FitPage {
  std::string title;
  std::string version;
  std::vector<std::string> data;  // files, and how they were read
  double atmosphere = 0;          // that gauges read against [Pa]
  std::vector<FitPart> parts;
  std::vector<Parameter> values;  // of the parameter file
};

// Throws std::runtime_error where the program was built without its pages.
std::string page(const FitPage& fit);
Content content(const FitPage& fit);
std::string to_json(const FitPage& fit, Columns& columns);

}  // namespace sinew::report
