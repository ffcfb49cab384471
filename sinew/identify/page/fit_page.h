// identify/page/fit_page.h - page of a report: measurements with the predictions of the models.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/contest/fit.h"
#include "sinew/report/page/plot.h"

namespace sinew::identify {

// Returns charts of the measurements with the models, and of the residuals; empty if the report has
// no rows.
std::vector<report::Plot> charts_of(const Report& report);

struct Page {
  std::string title, version;       // version of the program
  std::vector<std::string> data;    // description of the data
  double atmosphere = 0;            // reference pressure of gauges [Pa]
  std::span<const Report> reports;  // a calibration may have several
  std::string parameter_file;       // text for the table of values; may be empty
};

// Returns the page as HTML. Throws std::runtime_error if the library was built without its page,
// and config::Error if the parameter file cannot be read.
std::string page(const Page& page);

}  // namespace sinew::identify
