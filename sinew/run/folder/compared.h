// run/folder/compared.h - runs that are kept, beside each other.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/compare/comparison.h"
#include "sinew/run/folder/notices.h"

namespace sinew::run {

// Compares kept runs with the first of them; `runs` are their folders or logs, and are labelled by
// the shortest ends of these paths that tell them apart. `channels`: topics alone that match one of
// these patterns, "/joint/*/angle"; all, where there is none. A log that was cut off is a warning.
// Throws config::Error or log::Error where a run cannot be read, and std::runtime_error for one
// that was ended early.
report::Comparison compare_runs(const std::vector<std::string>& runs, const report::AlignWish& wish,
                                const std::vector<std::string>& channels = {},
                                const Notices& notices = {});

}  // namespace sinew::run
