#include "sinew/live/study_pages.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "sinew/json/json.h"
#include "sinew/live/request.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_storage.h"

namespace sinew::live {

namespace fs = std::filesystem;

StudyFeed::StudyFeed(const fs::path& file)
    : file_(file), seen_(stamp()), study_(tune::study_view(file)) {
  for (std::size_t i = 0; i < study_.rows.size(); ++i) {
    at_[study_.rows[i].number] = i;
    changes_.push_back(study_.rows[i].number);
  }
}

// Returns the stamp of the file. It is taken before the file is read, so that a change during the
// read is found at the next call.
StudyFeed::Stamp StudyFeed::stamp() const {
  Stamp out{};
  std::size_t i = 0;
  for (const fs::path& file : {file_, fs::path(file_.string() + "-wal")}) {
    std::error_code none;
    out[i++] = fs::last_write_time(file, none).time_since_epoch().count();
    out[i++] = static_cast<long long>(fs::file_size(file, none));
  }
  return out;
}

void StudyFeed::refresh() {
  const Stamp now = stamp();
  if (now == seen_) return;
  tune::StudyView next = tune::study_view(file_);
  std::map<std::size_t, std::size_t> at;
  for (std::size_t i = 0; i < next.rows.size(); ++i) {
    const tune::StudyRow& row = next.rows[i];
    at[row.number] = i;
    const auto known = at_.find(row.number);
    if (known == at_.end() || !(study_.rows[known->second] == row)) changes_.push_back(row.number);
  }
  at_ = std::move(at);
  study_ = std::move(next);
  seen_ = now;
}

std::vector<tune::StudyRow> StudyFeed::since(std::size_t known) const {
  std::vector<tune::StudyRow> out;
  std::set<std::size_t> added;
  for (std::size_t i = known; i < changes_.size(); ++i) {
    const auto found = at_.find(changes_[i]);
    if (found != at_.end() && added.insert(changes_[i]).second)
      out.push_back(study_.rows[found->second]);
  }
  return out;
}

namespace {

constexpr auto moment = std::chrono::milliseconds(1500);
constexpr std::ptrdiff_t most_at_once = 4;

bool goes(const std::shared_future<std::filesystem::path>& run) {
  return run.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

}  // namespace

RowRuns::~RowRuns() { stop_ = true; }  // the futures then wait for their threads

bool RowRuns::is_busy() {
  return std::ranges::count_if(runs_, [](const auto& r) { return goes(r.second); }) >= most_at_once;
}

void RowRuns::begin(std::size_t row, const tune::StudyRun& run) {
  const run::RunRequest request{.experiment = run.experiment,
                                .sets = run.sets,
                                .allow_unreachable = run.allow_unreachable,
                                .stop = &stop_};
  runs_[row] = std::async(std::launch::async, [request] {
                 return run::run_and_store(request).folder;
               }).share();
}

std::optional<std::filesystem::path> RowRuns::folder(std::size_t row) {
  const auto& run = runs_.at(row);
  if (run.wait_for(moment) != std::future_status::ready) return std::nullopt;
  return run.get();
}

namespace {

// Returns a page that reloads itself.
Reply in_progress(std::size_t row) {
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
    study.feed.refresh();
    views.push_back(study.feed.study());
    server.known.push_back(study.feed.changes());
  }
  return {200, tune::study_page(views, server)};
}

// Returns new rows. An error of the file is included, and shown on the open page.
Reply StudyPages::rows(Study& study, std::size_t known) {
  std::string error;
  try {
    study.feed.refresh();
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
    if (study.runs.is_busy()) return in_progress(row);
    study.runs.begin(row, run);
  }
  const auto folder = study.runs.folder(row);
  if (!folder) return in_progress(row);
  if (study.reported.insert(row).second)
    notices_.note(fmt::format("row {}: kept in {}", row, folder->string()));
  return {200, file_text(*folder / run::report_name)};
}

}  // namespace sinew::live
