#include "cli/figures_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/json_text.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/drawn_run.h"
#include "sinew/units/constants.h"

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

report::RunFigureOptions options_of(const RunFiguresRequest& request) {
  report::RunFigureOptions out;
  if (request.units == "thesis") out.units = units::UnitSet::thesis;
  if (!request.from.empty()) out.from = argument("--from", request.from, "s", units::atmosphere);
  if (!request.to.empty()) out.to = argument("--to", request.to, "s", units::atmosphere);
  if (out.from >= out.to)
    config::fail({"--from", 0, 0}, "", request.from,
                 fmt::format("a time before --to, {}", request.to));
  return out;
}

// A run's own folder, or one below --output where there are several runs.
fs::path folder_of(const RunFiguresRequest& request, const std::string& named,
                   const run::RecordedRun& run) {
  if (request.out.empty()) return run.log.parent_path() / run::figures_name;
  if (request.runs.size() == 1) return request.out;
  return fs::path(request.out) / report::file_name_of(named);
}

void print(const Json& runs) {
  for (const Json& run : runs) {
    fmt::print("{}\n", run["folder"].get<std::string>());
    report::TextTable table({"figure", "", "curves"},
                            {report::TextTable::Align::left, report::TextTable::Align::left});
    for (const Json& f : run["figures"])
      table.add({f["figure"], f["title"], std::to_string(f["curves"].size())});
    fmt::print("{}", table.text());
  }
}

}  // namespace

ExitCode draw_runs(const RunFiguresRequest& request) {
  const Messages messages(request.quiet);
  run::DrawingRequest drawing{.machine = request.machine,
                              .options = options_of(request),
                              .only = request.only,
                              .files = files_of(request.formats, request.force)};
  Json out{{"format", "sinew.figures/1"}, {"runs", Json::array()}};
  std::vector<fs::path> folders;
  for (const std::string& named : request.runs) {
    const fs::path folder = folder_of(request, named, run::recorded_run(named));
    if (std::ranges::find(folders, folder) != folders.end())
      config::fail({named, 0, 0}, "", "the same run, or one of the same name, a second time",
                   "each run once", "without -o");
    folders.push_back(folder);
    const std::string index = run::draw_run(named, folder, drawing, messages.notices());
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
