// run/folder/compared.h - comparison of stored runs, and the page of a film.
#pragma once

#include <string>
#include <vector>

#include "sinew/report/compare/comparison.h"
#include "sinew/run/folder/notices.h"

namespace sinew::run {

// Compares stored runs with the first of them. `runs` are their folders or logs; the labels are the
// shortest ends of these paths that distinguish them. `channels` restricts the comparison to
// topics that match one of these patterns, "/joint/*/angle"; empty: all. Warns of a log that was
// cut off. Throws config::Error or log::Error if a run cannot be read, and std::runtime_error for a
// run that ended early.
report::Comparison compare_runs(const std::vector<std::string>& runs,
                                const report::AlignOptions& align_options,
                                const std::vector<std::string>& channels = {},
                                const Notices& notices = {});

// Returns the page whose replay a film shows: that of one run, as page_of() returns it, or the
// comparison of several. Throws as these do.
std::string film_page(const std::vector<std::string>& runs,
                      const report::AlignOptions& align_options, const std::string& machine = "",
                      const Notices& notices = {});

}  // namespace sinew::run
