// cli/identify_page.h - the page that a method of `sinew identify` leaves.
#pragma once

#include <string>
#include <vector>

#include "cli/identify.h"
#include "sinew/report/charts.h"

namespace sinew::cli {

// What was measured and what the models say of it, then what they leave: none where the report
// tells no rows.
std::vector<report::Chart> charts_of(const identify::Report& report);

// Writes the page where one is wanted. `reports`: several of one calibration. `parameter_file`: its
// text, for the table of values; may be empty.
void leave_page(const std::string& title, const std::vector<const identify::Report*>& reports,
                const std::string& parameter_file, const DataOptions& data,
                const ResultOptions& options);

}  // namespace sinew::cli
