#include "sinew/live/served.h"

#include <fmt/format.h>

#include <memory>

#include "sinew/config/diagnostics.h"
#include "sinew/live/runs_pages.h"
#include "sinew/live/study_pages.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/tune/page/study_view.h"

namespace sinew::live {
namespace {

namespace fs = std::filesystem;

Served of_studies(const std::vector<fs::path>& files, run::Notices notices) {
  auto pages = std::make_shared<StudyPages>(files, std::move(notices));
  std::string names = files.front().string();
  if (files.size() > 1) names += " and " + files[1].string();
  return {.get = [pages](std::string_view path) { return pages->get(path); },
          .in_words = [names](const std::string&) { return names + "; Ctrl-C ends"; }};
}

}  // namespace

namespace {

Served of_runs(std::shared_ptr<RunsPages> pages) {
  return {.get = [pages](std::string_view path) { return pages->get(path); },
          .in_words =
              [pages](const std::string& url) {
                const std::size_t runs = pages->runs().size();
                return fmt::format("{}; Ctrl-C ends{}", pages->runs().front().string(),
                                   runs > 1 ? fmt::format("; {} runs at {}runs", runs, url) : "");
              }};
}

// A folder that is no run, with runs below it: their list is what is wanted.
bool is_of_runs(const std::string& what) {
  const fs::path folder(what);
  return fs::is_directory(folder) && !fs::exists(folder / run::log_name) &&
         !fs::exists(folder / run::unfinished_name) && !runs_below(folder).empty();
}

}  // namespace

Served served(const std::string& what, const std::string& machine, run::Notices notices) {
  if (!what.empty() && tune::is_study(what)) return of_studies({what}, std::move(notices));
  if (what.empty() || is_of_runs(what)) {
    const fs::path folder = what.empty() ? "runs" : what;
    std::vector<fs::path> runs = runs_below(folder);
    if (runs.empty())
      config::fail({"runs", 0, 0}, "", "no run", "folders with a log.mcap",
                   "sinew run experiments/walk-test-1.toml, or the folder of a run");
    auto pages = std::make_shared<RunsPages>(folder, std::move(runs), machine);
    if (!what.empty()) pages->list_first();
    return of_runs(std::move(pages));
  }
  (void)run::page_of(run::recorded_run(what), machine);  // its errors belong here
  return of_runs(std::make_shared<RunsPages>("", std::vector<fs::path>{what}, machine));
}

Served served(const std::vector<std::string>& what, const std::string& machine,
              run::Notices notices) {
  if (what.size() < 2) return served(what.empty() ? "" : what.front(), machine, std::move(notices));
  for (const std::string& file : what)
    if (what.size() > 2 || !tune::is_study(file))
      config::fail({file, 0, 0}, "", what.size() > 2 ? "a third one" : "no study's file",
                   "one run, one study, or two studies beside each other",
                   "sinew compare for runs");
  return of_studies({what[0], what[1]}, std::move(notices));
}

}  // namespace sinew::live
