#include "sinew/live/study_pages.h"

#include <fmt/format.h>

#include "sinew/json/json.h"
#include "sinew/live/path_numbers.h"
#include "sinew/live/text.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/page.h"

namespace sinew::live {
namespace {

// A page that asks again by itself.
Reply it_goes(std::size_t row) {
  return {
      200,
      fmt::format(
          "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Row {0}</title>"
          "<meta http-equiv=\"refresh\" content=\"1\">"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
          "'unsafe-inline'\"><style>:root{{color-scheme:light dark}}body{{font:15px/1.6 "
          "system-ui,sans-serif;margin:3rem}}</style></head><body><p>Row {0} runs; its page comes "
          "by itself.</p></body></html>\n",
          row)};
}

}  // namespace

StudyPages::StudyPages(const std::vector<std::filesystem::path>& files, run::Notices notices)
    : notices_(std::move(notices)) {
  for (const std::filesystem::path& file : files) studies_.emplace_back(file);
  report::require_page("the page of a study");
}

Reply StudyPages::get(std::string_view path) try {
  if (path == "/") return page();
  const bool second = studies_.size() > 1 && path.starts_with("/b/");
  if (second) path.remove_prefix(2);
  Study& study = studies_[second ? 1 : 0];
  if (const auto known = number_in(path, "/rows/")) return rows(study, *known);
  if (const auto row = number_in(path, "/run/")) return run_of(study, *row);
  return {404, "Nothing is here; the study is at the address that was printed.\n", plain};
} catch (const std::exception& wrong) {
  return {500, std::string(wrong.what()) + "\n", plain};
}

Reply StudyPages::page() {
  std::vector<tune::StudyView> views;
  tune::StudyServer server;
  for (Study& study : studies_) {
    study.feed.look();
    views.push_back(study.feed.study());
    server.known.push_back(study.feed.changes());
  }
  return {200, tune::study_page(views, server)};
}

// What is wrong with a file that was there is said on the page that stands.
Reply StudyPages::rows(Study& study, std::size_t known) {
  std::string error;
  try {
    study.feed.look();
  } catch (const std::exception& wrong) {
    error = fmt::format(",\"error\":{}", Json(wrong.what()).text());
  }
  return {200,
          fmt::format("{{\"known\":{},\"expected\":{},\"rows\":{}{}}}", study.feed.changes(),
                      study.feed.study().expected, tune::rows_json(study.feed.since(known)), error),
          "application/json"};
}

Reply StudyPages::run_of(Study& study, std::size_t row) {
  if (!study.runs.has(row)) {
    const tune::StudyRun run = tune::run_of(study.feed.study(), row);
    if (study.runs.is_busy()) return it_goes(row);
    study.runs.begin(row, run);
  }
  const auto folder = study.runs.folder(row);
  if (!folder) return it_goes(row);
  if (study.told.insert(row).second)
    notices_.note(fmt::format("row {}: kept in {}", row, folder->string()));
  return {200, file_text(*folder / run::report_name)};
}

}  // namespace sinew::live
