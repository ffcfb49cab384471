#include "cli/figures_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/figure_files.h"
#include "cli/json_text.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/text_table.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/log/reader.h"
#include "sinew/report/run_figures.h"
#include "sinew/units/constants.h"

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

report::RunFigureOptions options_of(const RunFiguresRequest& request) {
  report::RunFigureOptions out;
  if (request.units == "thesis") out.units = report::UnitSystem::thesis;
  if (!request.from.empty()) out.from = argument("--from", request.from, "s", units::atmosphere);
  if (!request.to.empty()) out.to = argument("--to", request.to, "s", units::atmosphere);
  if (out.from >= out.to)
    config::fail({"--from", 0, 0}, "", request.from,
                 fmt::format("a time before --to, {}", request.to));
  return out;
}

std::vector<report::Figure> figures_of(const RecordedRun& run, const RunFiguresRequest& request,
                                       const Messages& messages) {
  const config::Node resolved = config::compose(machine_of(run, request.machine).string());
  const signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(run.log.string() +
                     " was cut off or is damaged; the figures show what stands before");
  if (const std::string ended = ended_in(run.log); !ended.empty())
    messages.warning(fmt::format("{}: the run was ended: {}; the figures show it until then",
                                 run.log.string(), ended));
  return report::run_figures({.table = table, .resolved = resolved, .name = experiment_in(run.log)},
                             options_of(request));
}

// Those that were asked for, all where none were.
void choose(std::vector<report::Figure>& figures, const std::vector<std::string>& only,
            const fs::path& run) {
  if (only.empty()) return;
  std::vector<std::string> there;
  for (const report::Figure& f : figures) there.push_back(f.name);
  for (const std::string& name : only)
    if (std::ranges::find(there, name) == there.end())
      config::fail({run.string(), 0, 0}, "--only", fmt::format("\"{}\"", name),
                   fmt::format("one of {}", fmt::join(there, ", ")),
                   std::string(config::closest(name, {there.begin(), there.end()})));
  std::erase_if(figures, [&](const report::Figure& f) {
    return std::ranges::find(only, f.name) == only.end();
  });
}

// A run's own folder, or one below --output where there are several runs.
fs::path folder_of(const RunFiguresRequest& request, const std::string& named,
                   const RecordedRun& run) {
  if (request.out.empty()) return run.log.parent_path() / figures_name;
  if (request.runs.size() == 1) return request.out;
  return fs::path(request.out) / report::file_name_of(named);
}

void print(const Json& runs) {
  for (const Json& run : runs) {
    fmt::print("{}\n", run["folder"].get<std::string>());
    TextTable table({"figure", "", "curves"}, {TextTable::Align::left, TextTable::Align::left});
    for (const Json& f : run["figures"])
      table.add({f["figure"], f["title"], std::to_string(f["curves"].size())});
    fmt::print("{}", table.text());
  }
}

}  // namespace

ExitCode draw_runs(const RunFiguresRequest& request) {
  const Messages messages(request.quiet);
  FigureFiles files{.must_draw = !request.formats.empty(), .force = request.force};
  if (files.must_draw) files.pictures = parse_formats(request.formats);

  Json out{{"format", "sinew.figures/1"}, {"runs", Json::array()}};
  std::vector<fs::path> folders;
  for (const std::string& named : request.runs) {
    const RecordedRun run = recorded_run(named);
    const fs::path folder = folder_of(request, named, run);
    if (std::ranges::find(folders, folder) != folders.end())
      config::fail({named, 0, 0}, "", "the same run, or one of the same name, a second time",
                   "each run once", "without -o");
    folders.push_back(folder);
    std::vector<report::Figure> figures = figures_of(run, request, messages);
    if (figures.empty())
      config::fail({named, 0, 0}, "", "no samples",
                   "a log with samples in the time that is asked for",
                   "it without --from and --to");
    choose(figures, request.only, named);
    const std::string name = experiment_in(run.log);
    report::Gallery gallery{.title = name.empty() ? "Figures" : "Figures of " + name};
    for (report::Figure& f : figures) gallery.exhibits.push_back({std::move(f), {}});
    const std::string index = write_figures(folder, std::move(gallery), files, messages);
    out["runs"].push_back(
        {{"folder", folder.string()}, {"figures", Json::parse(index)["figures"]}});
  }
  if (request.json)
    fmt::print("{}\n", json_text(out, 2));
  else
    print(out["runs"]);
  return ok;
}

}  // namespace sinew::cli
