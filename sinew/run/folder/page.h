// run/folder/page.h - report.html of a run's folder: `sinew report`, and what `run` and `import`
// leave.
#pragma once

#include <string>

#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/run/folder/notices.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::run {

inline constexpr std::string_view report_name = "report.html";

// Writes the page of a run of that name beside its log, of what the log holds: the same bytes as
// page_of() makes of the folder. `values`: what resolved.toml says; `units`: those in which it
// begins (config/shown_units.h), as asked for now. Returns false, with a note and no file, where
// the library was built without its page. Throws log::Error.
bool write_report(const OutputFolder& folder, const analysis::Analysis& logged,
                  const config::Node& values, const std::string& name, const Notices& notices,
                  const std::string& units = "");

// Returns the page of a recorded run, by `machine` where it is not empty, else by its
// resolved.toml. Warns where the run was ended, or its log is cut off. Throws where there is no
// such run, or no page in the library.
std::string page_of(const RecordedRun& run, const std::string& machine, const Notices& notices = {},
                    const std::string& units = "");

}  // namespace sinew::run
