// cli/run.h - what `sinew run` and `sinew view --live` share: their options, and what they print of
// a run that is kept.
#pragma once

#include <fmt/format.h>

#include <string>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "cli/verdicts.h"
#include "sinew/run/folder/kept_run.h"
#include "sinew/run/folder/page.h"

namespace sinew::cli {

struct RunOptions {
  run::RunRequest run;
  double pace = 0;  // simulated seconds per second of wall time; 0: no limit
  bool json = false, quiet = false;
};

// EXPERIMENT, -o, --force, --set, --allow-unreachable, --no-report, --units, --json, --quiet.
void add_run_options(CLI::App& sub, const std::string& port, RunOptions& options);

// Returns "" for what --pace may be, else what is wrong.
std::string a_pace(const std::string& text);

// Says where the page of a run that is kept stands.
inline void note_page(const std::filesystem::path& folder, const Messages& messages) {
  messages.note(fmt::format("to look at it, open {}", (folder / run::report_name).string()));
}

// Verdicts or summary.json to stdout, where it is kept to stderr.
inline void tell(const run::Kept& kept, const RunOptions& options, const Messages& messages) {
  if (options.json) {
    fmt::print("{}", kept.json);
    messages.note(kept.folder.string());
  } else {
    const config::UnitsToShow units =
        chosen_units(options.run.units, units::UnitSet::si, kept.folder / run::resolved_name);
    print_verdicts(kept.summary, kept.machine, units.asked ? &units.units : nullptr);
    messages.note(fmt::format("{:.2f} s in {:.3f} s, kept in {}", kept.duration, kept.wall,
                              kept.folder.string()));
  }
  if (kept.page) note_page(kept.folder, messages);
}

}  // namespace sinew::cli
