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
#include "sinew/live/study_pages.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/report/page/content.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/tune/page/study_view.h"

extern char** environ;

namespace sinew::live {

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
