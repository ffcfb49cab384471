// run/folder/page.h - pages of stored runs: report.html of a run's folder, as written by `sinew
// report`, `run` and `import`; comparisons of several runs, and the page of a film.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::run {

// Writes the page of a run of that name next to its log, from the logged channels: the same bytes
// as page_of() returns for the folder. `values` are those of resolved.toml; `units` are the initial
// units (config/shown_units.h). Returns false, with a note and without a file, if the library was
// built without its page. Throws log::Error.
bool write_report(const OutputFolder& folder, const analysis::Analysis& logged,
                  const config::Node& values, const std::string& name, const Notices& notices,
                  const std::string& units = "");

// Returns the page of a recorded run, described by `machine`, or by its resolved.toml if `machine`
// is empty. Warns if the run ended early or its log is cut off. Throws if there is no such run, or
// if the library was built without its page.
std::string page_of(const RunFiles& run, const std::string& machine, const Notices& notices = {},
                    const std::string& units = "");

// Compares stored runs with the first of them. `runs` are their folders or logs; the labels are the
// shortest ends of these paths that distinguish them. `channels` restricts the comparison to
// topics that match one of these patterns, "/joint/*/angle"; empty: all. Warns of a log that was
// cut off. Throws config::Error or log::Error if a run cannot be read, and std::runtime_error for a
// run that ended early.
report::Comparison compare_runs(const std::vector<std::string>& runs,
                                const report::AlignOptions& align_options,
                                const std::vector<std::string>& channels = {},
                                const Notices& notices = {});

// Returns the kind of a film's file, by the ending of its name.
FileKind film_kind(const std::filesystem::path& file);

// Returns the page whose replay a film shows: that of one run, as page_of() returns it, or the
// comparison of several. Throws as these do.
std::string film_page(const std::vector<std::string>& runs,
                      const report::AlignOptions& align_options, const std::string& machine = "",
                      const Notices& notices = {});

}  // namespace sinew::run
