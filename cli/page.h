// cli/page.h - report.html of a run's folder: `sinew report`, and what `run` and `import` leave.
#pragma once

#include <filesystem>
#include <string>

#include "cli/run_folder.h"
#include "cli/terminal.h"
#include "sinew/signals/table.h"

namespace sinew::cli {

inline constexpr std::string_view report_name = "report.html";

// Beside the log, of what it holds: the same bytes as `sinew report` makes of the folder. Without a
// page in the program: a note, no file, and false.
bool write_report(const OutputFolder& folder, const signals::Table& logged,
                  const std::string& resolved, const std::string& name, const Messages& messages);

// Says where the page of a run that is kept stands.
void note_report(const OutputFolder& folder, const Messages& messages);

// The page of a recorded run, by `machine` where it is not empty, else by its resolved.toml. Throws
// where there is no such run, or no page in the program; `cut` says whether the log was.
std::string page_of(const RecordedRun& run, const std::string& machine, bool* cut = nullptr);

}  // namespace sinew::cli
