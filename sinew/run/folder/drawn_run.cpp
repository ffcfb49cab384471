#include "sinew/run/folder/drawn_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::run {

namespace {

namespace fs = std::filesystem;

std::vector<report::Figure> figures_of(const RecordedRun& run, const DrawingRequest& request,
                                       const Notices& notices) {
  const config::Node resolved = config::compose(machine_of(run, request.machine).string());
  const signals::Table table = log::read(run.log);
  if (!table.complete)
    notices.warning(run.log.string() +
                    " was cut off or is damaged; the figures show what stands before");
  if (const std::string ended = ended_in(run.log); !ended.empty())
    notices.warning(fmt::format("{}: the run was ended: {}; the figures show it until then",
                                run.log.string(), ended));
  return report::run_figures({.table = table, .resolved = resolved, .name = experiment_in(run.log)},
                             request.options);
}

// Those that were asked for, all where none were.
void choose(std::vector<report::Figure>& figures, const std::vector<std::string>& only,
            const fs::path& run) {
  if (only.empty()) return;
  std::vector<std::string> there;
  for (const report::Figure& f : figures) there.push_back(f.name);
  for (const std::string& name : only)
    if (std::ranges::find(there, name) == there.end())
      config::fail({run.string(), 0, 0}, "only", fmt::format("\"{}\"", name),
                   fmt::format("one of {}", fmt::join(there, ", ")),
                   std::string(config::closest(name, {there.begin(), there.end()})));
  std::erase_if(figures, [&](const report::Figure& f) {
    return std::ranges::find(only, f.name) == only.end();
  });
}

}  // namespace

std::string draw_run(const fs::path& named, const fs::path& folder, const DrawingRequest& request,
                     const Notices& notices) {
  const RecordedRun run = recorded_run(named);
  std::vector<report::Figure> figures = figures_of(run, request, notices);
  if (figures.empty())
    config::fail({named.string(), 0, 0}, "", "no samples",
                 "a log with samples in the time that is asked for", "another time");
  choose(figures, request.only, named);
  const std::string name = experiment_in(run.log);
  report::Gallery gallery{.title = name.empty() ? "Figures" : "Figures of " + name};
  for (report::Figure& f : figures) gallery.exhibits.push_back({std::move(f), {}});
  return write_figures(folder, std::move(gallery), request.files, notices);
}

}  // namespace sinew::run
