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

Served served(const std::string& what, const std::string& machine, run::Notices notices) {
  if (!what.empty() && tune::is_study(what)) return of_studies({what}, std::move(notices));
  const std::vector<fs::path> runs =
      what.empty() ? runs_below("runs") : std::vector<fs::path>{what};
  if (runs.empty())
    config::fail({"runs", 0, 0}, "", "no run", "folders with a log.mcap",
                 "sinew run experiments/walk-test-1.toml, or the folder of a run");
  if (!what.empty())
    (void)run::page_of(run::recorded_run(what), machine);  // its errors belong here
  return {.get = [=](std::string_view path) { return answer(path, runs, machine); },
          .in_words =
              [=](const std::string& url) {
                return fmt::format(
                    "{}; Ctrl-C ends{}", runs.front().string(),
                    runs.size() > 1 ? fmt::format("; {} runs at {}runs", runs.size(), url) : "");
              }};
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
