#include "cli/figures_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/arguments.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/drawn_run.h"
#include "sinew/run/folder/figure_files.h"
#include "sinew/units/constants.h"

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

report::RunFigureOptions range_of(const RunFiguresRequest& request) {
  report::RunFigureOptions out;
  if (!request.from.empty()) out.from = argument("--from", request.from, "s", units::atmosphere);
  if (!request.to.empty()) out.to = argument("--to", request.to, "s", units::atmosphere);
  if (out.from >= out.to)
    config::fail({"--from", 0, 0}, "", request.from,
                 fmt::format("a time before --to, {}", request.to));
  return out;
}

// None: the runs begin together.
std::optional<analysis::AlignRequest> align_of(const RunFiguresRequest& request) {
  if (request.align == "start") return std::nullopt;
  const bool event = request.align == "event";
  return analysis::AlignRequest{
      .by = event ? analysis::AlignBy::event : analysis::AlignBy::correlation,
      .event = request.event,
      .fit_clock = request.clock == "fit"};
}

run::DrawingRequest drawing_of(const RunFiguresRequest& request) {
  run::DrawingRequest out{.machine = request.machine,
                          .units = request.units,
                          .options = range_of(request),
                          .channels = request.channels,
                          .only = request.only,
                          .title = request.title,
                          .paper = report::read_paper(request.width, request.height, request.font),
                          .files = files_of(request.formats, request.force)};
  if (!request.words.empty()) out.files.labels = report::read_labels(request.words);
  return out;
}

// A run's own folder, or one below --output where there are several runs.
fs::path folder_of(const RunFiguresRequest& request, const std::string& named) {
  const fs::path source =
      run::is_muscle_file(named) ? fs::path(named) : run::recorded_run(named).log;
  if (request.out.empty()) return source.parent_path() / run::figures_name;
  if (request.runs.size() == 1) return request.out;
  return fs::path(request.out) / report::file_name_of(named);
}

// With what each run is named as.
std::vector<std::pair<fs::path, std::string>> folders_of(const RunFiguresRequest& request) {
  std::vector<std::pair<fs::path, std::string>> out;
  for (const std::string& named : request.runs) {
    const fs::path folder = folder_of(request, named);
    for (const auto& [taken, other] : out)
      if (taken == folder)
        config::fail({named, 0, 0}, "", "the same run, or one of the same name, a second time",
                     "each run once", "without -o");
    out.emplace_back(folder, named);
  }
  return out;
}

void print(const Json& runs) {
  for (const Json& run : runs) {
    fmt::print("{}\n", run["folder"].string());
    report::TextTable table({"figure", "", "curves"},
                            {report::TextTable::Align::left, report::TextTable::Align::left});
    for (const Json& f : run["figures"])
      table.add({f["figure"].string(), f["title"].string(), std::to_string(f["curves"].size())});
    fmt::print("{}", table.text());
  }
}

}  // namespace

ExitCode draw_runs(const RunFiguresRequest& request) {
  const Messages messages(request.quiet);
  const run::DrawingRequest drawing = drawing_of(request);
  if (request.labels_template) {
    fmt::print("{}", run::labels_of_runs({request.runs.begin(), request.runs.end()}, drawing));
    return ok;
  }
  Json out{{"format", "sinew.figures/1"}, {"runs", Json::array()}};
  const auto add = [&](const fs::path& folder, const std::string& index) {
    out["runs"].push_back(
        {{"folder", folder.string()}, {"figures", Json::parse(index)["figures"]}});
  };
  if (request.overlaid()) {
    const run::OverlaidRuns runs{
        {request.runs.begin(), request.runs.end()}, request.labels, align_of(request)};
    add(request.out, run::draw_runs(runs, request.out, drawing, messages.notices()));
  } else {
    for (const auto& [folder, named] : folders_of(request))
      add(folder, run::is_muscle_file(named)
                      ? run::draw_muscles(named, folder, drawing, messages.notices())
                      : run::draw_run(named, folder, drawing, messages.notices()));
  }
  if (request.json)
    fmt::print("{}\n", out.text(2));
  else
    print(out["runs"]);
  return ok;
}

}  // namespace sinew::cli
