// cli/identify_page.h - the page that a method of `sinew identify` leaves.
#pragma once

#include <string>
#include <vector>

#include "cli/identify.h"

namespace sinew::cli {

// Writes the page where one is wanted. `reports`: several of one calibration. `parameter_file`: its
// text, for the table of values; may be empty.
void leave_page(const std::string& title, const std::vector<const identify::Report*>& reports,
                const std::string& parameter_file, const DataOptions& data,
                const ResultOptions& options);

}  // namespace sinew::cli
