// report/page/fit_page.h - results of an identification as one self-contained page: all models, the
// reason of the choice, its values, and measurements compared with predictions.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/report/page/parameters.h"
#include "sinew/report/page/plot.h"

namespace sinew::report {

// One report of `sinew identify`; of several sensors each has its own.
struct FitPart {
  std::string report;  // JSON of format sinew.identification/1
  std::vector<Plot> charts;
};

struct FitPage {
  std::string title;
  std::string version;
  std::vector<std::string> data;  // files, and the way in which they were read
  double atmosphere = 0;          // reference of gauge pressures [Pa]
  std::vector<FitPart> parts;
  std::vector<Parameter> values;  // values in the parameter file
};

// Returns the page. Throws std::runtime_error if the program was built without its pages.
std::string page(const FitPage& fit);
Content content(const FitPage& fit);
Json to_json(const FitPage& fit, Columns& columns);

}  // namespace sinew::report
