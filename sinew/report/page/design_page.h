// report/page/design_page.h - result of a design calculation as one self-contained page: numbers
// with their intervals, tables and plots.
#pragma once

#include <string>
#include <vector>

#include "sinew/json/json.h"
#include "sinew/report/page/plot.h"

namespace sinew::report {

struct DesignPage {
  std::string title;
  std::string version;    // version of the program
  double atmosphere = 0;  // reference of gauge pressures [Pa]
  Json values, tables;    // lists; numbers in SI with their units
  std::vector<Plot> plots;
  std::string refused;  // why no design is possible; empty: there is one
  std::vector<std::string> notes, warnings;
  std::vector<std::string> unseen;  // limits of the result, in sentences
};

// Returns the page. Throws std::runtime_error if the program was built without its pages.
std::string page(const DesignPage& design);

}  // namespace sinew::report
