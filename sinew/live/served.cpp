#include "sinew/live/served.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/json/json.h"
#include "sinew/live/request.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_storage.h"

extern char** environ;

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

namespace {

namespace fs = std::filesystem;

// Writes a new file of mode 0600. Returns its name, or "" if it cannot be written.
fs::path private_file(const std::string& text) {
  const char* own = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  const fs::path folder = own && *own ? fs::path(own) : fs::temp_directory_path(none);
  if (folder.empty()) return {};  // TMPDIR is no folder; the address is printed anyway
  std::string name = (folder / "sinew-view-XXXXXX.html").string();
  const int file = mkstemps(name.data(), 5);  // length of ".html"
  if (file < 0) return {};
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  if (whole) return name;
  ::unlink(name.c_str());
  return {};
}

void start_quietly(std::string program, std::string word) {
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int out : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, out, "/dev/null", O_WRONLY, 0);
  char* const arguments[] = {program.data(), word.data(), nullptr};
  pid_t pid = 0;
  posix_spawnp(&pid, program.c_str(), &quiet, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&quiet);
}

}  // namespace

Browser::Browser(const std::string& url) {
  if (url.empty() || (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))) return;
  redirecting_page_ = private_file(fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Sinew</title><meta "
      "http-equiv=\"refresh\" content=\"0; url={0}\"></head><body><a "
      "href=\"{0}\">{0}</a></body></html>\n",
      url));
  if (!redirecting_page_.empty()) start_quietly("xdg-open", redirecting_page_.string());
}

Browser::~Browser() {
  std::error_code ignored;
  if (!redirecting_page_.empty()) fs::remove(redirecting_page_, ignored);
}

namespace fs = std::filesystem;

std::vector<fs::path> runs_below(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code none;
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(
           folder, fs::directory_options::skip_permission_denied, none))
    if (e.path().filename() == run::log_name && e.is_regular_file() &&
        e.path().parent_path().filename() != run::unfinished_name)
      found.emplace_back(e.last_write_time(), e.path().parent_path());
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a > b; });
  std::vector<fs::path> out;
  for (auto& [time, run] : found) out.push_back(std::move(run));
  return out;
}

namespace {

constexpr std::size_t most_compared = 8;

Reply not_found() { return {404, "Nothing is here; the runs are at runs.\n", plain}; }

// Returns the folder of a run, which may be given by its log.
fs::path folder_of(const fs::path& run) { return fs::is_directory(run) ? run : run.parent_path(); }

// Returns a time in local time: "2026-11-25 02:10".
std::string date_of(fs::file_time_type written) {
  const auto when = std::chrono::file_clock::to_sys(written);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(when));
  std::tm local{};
  if (localtime_r(&seconds, &local) == nullptr) return "";
  return fmt::format("{:%Y-%m-%d %H:%M}", local);
}

// Returns the lines of a resolved.toml before its first table, with title and robot, because
// parsing the whole file is slow.
std::string top_of(const fs::path& file) {
  std::ifstream in(file);
  std::string out, line;
  while (std::getline(in, line) && !line.starts_with('[')) out += line + '\n';
  return out;
}

std::string text_at(const config::Node& node, std::string_view key) {
  const config::Node* found = node.find(key);
  if (found != nullptr && found->is_value_table()) found = found->find("value");
  return found != nullptr ? config::written(*found) : "";
}

// Returns the content of summary.json; an empty object if the run was not finished.
Json summary_in(const fs::path& folder) {
  std::ifstream in(folder / run::summary_name);
  Json out;
  return in && Json::parse(in, out) && out.is_object() ? out : Json::object();
}

}  // namespace

RunsPages::RunsPages(fs::path folder, std::vector<fs::path> runs, std::string machine)
    : folder_(std::move(folder)), runs_(std::move(runs)), machine_(std::move(machine)) {}

Reply RunsPages::get(std::string_view path) try {
  if (path == "/") return list_first_ ? list() : page_of_run(0);
  if (path == "/runs") return list();
  constexpr std::string_view compare = "/compare/";
  if (path.starts_with(compare)) return compared(path.substr(compare.size()));
  if (const auto run = number_in(path, "/run/"); run && *run < runs_.size())
    return page_of_run(*run);
  if (const auto run = number_in(path, "/picture/"); run && *run < runs_.size())
    return picture_of(*run);
  return not_found();
} catch (const std::exception& wrong) {
  return {500, std::string(wrong.what()) + "\n", plain};
}

void RunsPages::find_new_runs() {
  if (folder_.empty()) return;
  for (fs::path& found : runs_below(folder_))
    if (std::ranges::find(runs_, found) == runs_.end()) runs_.push_back(std::move(found));
}

std::string RunsPages::entry_of(std::size_t run) {
  const fs::path folder = folder_of(runs_[run]);
  std::error_code gone;
  const fs::file_time_type written = fs::last_write_time(run::run_files(runs_[run]).log, gone);
  ListEntry& entry = entries_[run];
  if (entry.written == written && !entry.json.empty()) return entry.json;
  const Json summary = summary_in(folder);
  config::Node top;
  try {
    top = config::parse_text(top_of(folder / run::resolved_name), "resolved.toml");
  } catch (const config::Error&) {
    // The list shows only the folder. The run's own page reports the error.
  }
  Json out = {{"run", run}, {"folder", runs_[run].string()}, {"date", date_of(written)}};
  out["title"] = summary.string("title", text_at(top, "title"));
  out["about"] = summary.string("reproduces", text_at(top, "reproduces"));
  out["robot"] = text_at(top, "robot_name");
  out["seed"] = text_at(top, "seed");
  if (summary.contains("duration_s")) out["duration_s"] = summary["duration_s"];
  entry = {written, out.text()};
  return entry.json;
}

Reply RunsPages::list() {
  report::require_page("the list of runs");
  find_new_runs();
  std::string runs;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (!fs::exists(runs_[i])) continue;  // was removed
    runs += (runs.empty() ? "" : ",") + entry_of(i);
  }
  report::Content content;
  content.title = "Runs";
  content.json = fmt::format(R"({{"folder":{},"most":{},"runs":[{}]}})",
                             Json(folder_.string()).text(), most_compared, runs);
  content.connect = "; connect-src 'self'";  // for the pictures
  return {200, report::fill(report::run_list_template(), content)};
}

Reply RunsPages::page_of_run(std::size_t run) const {
  return {200, run::page_of(run::run_files(runs_[run]), machine_)};
}

Reply RunsPages::picture_of(std::size_t run) const {
  const run::RunFiles recorded = run::run_files(runs_[run]);
  config::Node resolved;
  try {
    if (fs::exists(recorded.resolved)) resolved = config::parse_file(recorded.resolved.string());
  } catch (const config::Error&) {
    // The picture is drawn without a machine. The run's own page reports the error.
  }
  return {200, report::picture(resolved), "application/json"};
}

Reply RunsPages::compared(std::string_view numbers) const {
  const auto chosen = numbers_in(numbers);
  if (!chosen || chosen->size() < 2 || chosen->size() > most_compared) return not_found();
  std::vector<std::string> folders;
  for (const std::size_t run : *chosen) {
    if (run >= runs_.size()) return not_found();
    folders.push_back(runs_[run].string());
  }
  return {200, report::page(run::compare_runs(folders, report::Align::start))};
}

namespace {

Served of_studies(const std::vector<fs::path>& files, run::Notices notices) {
  auto pages = std::make_shared<StudyPages>(files, std::move(notices));
  std::string names = files.front().string();
  if (files.size() > 1) names += " and " + files[1].string();
  return {.get = [pages](std::string_view path) { return pages->get(path); },
          .description = [names](const std::string&) { return names + "; Ctrl-C ends"; }};
}

Served of_runs(std::shared_ptr<RunsPages> pages) {
  return {.get = [pages](std::string_view path) { return pages->get(path); },
          .description =
              [pages](const std::string& url) {
                const std::size_t runs = pages->runs().size();
                return fmt::format("{}; Ctrl-C ends{}", pages->runs().front().string(),
                                   runs > 1 ? fmt::format("; {} runs at {}runs", runs, url) : "");
              }};
}

// Returns whether a folder is no run but has runs below it, so that their list is served.
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
  (void)run::page_of(run::run_files(what), machine);  // throws before the server starts
  return of_runs(std::make_shared<RunsPages>("", std::vector<fs::path>{what}, machine));
}

Served served(const std::vector<std::string>& what, const std::string& machine,
              run::Notices notices) {
  if (what.size() < 2) return served(what.empty() ? "" : what.front(), machine, std::move(notices));
  for (const std::string& file : what)
    if (what.size() > 2 || !tune::is_study(file))
      config::fail({file, 0, 0}, "", what.size() > 2 ? "a third one" : "no study's file",
                   "one run, one study, or two studies", "sinew compare for runs");
  return of_studies({what[0], what[1]}, std::move(notices));
}

}  // namespace sinew::live
