#include "cli/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <vector>

#include "cli/figure_files.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace fs = std::filesystem;

namespace {

// The only files that --force may remove.
constexpr std::string_view known_files[] = {log_name,     "log.mcap.tmp", resolved_name,
                                            summary_name, measured_name,  "report.html"};

[[noreturn]] void refuse(const fs::path& where, std::string found, std::string expected,
                         std::string try_this = "") {
  config::fail({where.string(), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

int highest_number(const fs::path& folder) {
  int highest = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size())
      highest = std::max(highest, number);
  }
  return highest;
}

std::vector<std::string> contents(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

void make_folders(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) refuse(folder, problem.message(), "a folder that can be made", "-o elsewhere");
}

fs::path next_run_folder(const std::string& experiment) {
  const fs::path parent = fs::path("runs") / experiment;
  make_folders(parent);
  for (int number = highest_number(parent) + 1;; ++number) {
    const fs::path folder = parent / std::to_string(number);
    std::error_code problem;
    if (fs::create_directory(folder, problem)) return folder;
    if (problem) refuse(folder, problem.message(), "a folder that can be made", "-o elsewhere");
  }
}

fs::path chosen_run_folder(const fs::path& folder, bool force) {
  if (fs::exists(folder) && !fs::is_directory(folder))
    refuse(folder, "a file", "a folder", "-o with another name");
  make_folders(folder);

  std::vector<std::string> names = contents(folder);
  if (names.empty()) return folder;
  if (!force) {
    if (names.size() > 4) names.resize(4), names.back() = "…";
    refuse(folder, fmt::format("{}", fmt::join(names, ", ")), "an empty folder",
           "another one, or --force to replace the run in it");
  }
  for (const std::string_view name : known_files) fs::remove(folder / name);
  remove_figures(folder / figures_name);
  return folder;
}

RecordedRun recorded_run(const fs::path& named) {
  if (!fs::exists(named))
    refuse(named, "nothing", "the folder of a run, or its log", "the path, or sinew run first");
  const fs::path folder = fs::is_directory(named) ? named : named.parent_path();
  const fs::path log = fs::is_directory(named) ? named / log_name : named;
  if (!fs::exists(log))
    refuse(named, "no log.mcap", "the folder of a run", "a run with log.enabled=true");
  return {log, folder / resolved_name};
}

fs::path machine_of(const RecordedRun& run, const std::string& instead) {
  const fs::path file = instead.empty() ? run.resolved : fs::path(instead);
  if (!fs::exists(file))
    refuse(file, "nothing", "what was run", "--machine with the run's resolved.toml");
  return file;
}

void refuse_to_overwrite(const fs::path& file, bool force) {
  if (fs::is_directory(file)) refuse(file, "a folder", "the name of a file", "a name inside of it");
  if (force || !fs::exists(file)) return;
  refuse(file, "a file", "a name that is free", "another one, or --force to replace it");
}

void write_file(const fs::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out) return;
  const fs::path folder = file.parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    refuse(file, "no folder " + folder.string(), "one that exists", "mkdir -p " + folder.string());
  refuse(file, "an error while writing", "room for the file", "another folder");
}

}  // namespace sinew::cli
