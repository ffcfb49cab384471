#include "sinew/run/folder/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "sinew/run/folder/figure_files.h"

namespace sinew::run {

namespace fs = std::filesystem;

namespace {

// The only files that force=true may replace, if they are those of a run.
struct KnownFile {
  std::string_view name, mark;
  FileKind::At at = FileKind::At::anywhere;
  bool makes_a_run = true;  // whether a folder with this file alone contains a run
};
constexpr KnownFile known_files[] = {
    {log_name, "sinew"},
    {resolved_name, "format=\"sinew.experiment/"},
    {summary_name, summary_kind.mark, summary_kind.at},
    {measured_name, "time[s],", FileKind::At::start, false},
    {mapping_name, "format=\"sinew.mapping/", FileKind::At::anywhere, false},
    {report_name, report_kind.mark, report_kind.at, false},
};

// Returns the names of these files, with those that a killed process leaves.
std::vector<std::string> known_names() {
  std::vector<std::string> names{std::string(log_name) + ".tmp"};
  for (const KnownFile& file : known_files)
    names.insert(names.end(), {std::string(file.name), log::hidden_name(file.name)});
  return names;
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

OutputFolder next_run_folder(const std::string& experiment) {
  const fs::path parent = fs::path("runs") / experiment;
  make_folders(parent);
  for (int number = highest_number(parent) + 1;; ++number) {
    const fs::path folder = parent / std::to_string(number);
    std::error_code problem;
    if (fs::create_directory(folder, problem)) return OutputFolder(folder);
    if (problem) refuse(folder, problem.message(), "a folder that can be made", "another folder");
  }
}

// Returns whether the folder contains a run. Throws config::Error if a file has the name of one of
// a run but is not that.
bool holds_a_run(const fs::path& folder, const std::vector<fs::path>& inputs) {
  const bool is_run = fs::exists(folder / unfinished_name) ||
                      std::ranges::any_of(known_files, [&](const KnownFile& file) {
                        return file.makes_a_run && fs::exists(folder / file.name);
                      });
  for (const auto& [name, mark, at, makes_a_run] : known_files) {
    const FileKind kind{"file of a run", "such a file", mark, at,
                        "another folder, or to move that file elsewhere"};
    refuse_to_overwrite(folder / name, true, kind, inputs);
    if (!is_run && fs::exists(folder / name))
      refuse(folder / name, "a file without a run", "an empty folder, or that of a run",
             std::string(kind.otherwise));
  }
  return is_run;
}

// Removes the files of an earlier incomplete run, and no others, before the next one.
void clear_unfinished(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  std::vector<std::string> known = known_names();
  known.insert(known.end(), {".replaced", log::hidden_name(".replaced")});
  for (const std::string& name : names_in(folder))
    if (std::ranges::find(known, name) == known.end())
      refuse(folder, name, "nothing but a run that did not end", "to move it elsewhere");
  for (const std::string& name : known) fs::remove(folder / name);
}

}  // namespace

OutputFolder run_folder(const std::string& path, bool force, const std::string& experiment,
                        const std::vector<fs::path>& inputs) {
  if (path.empty()) return next_run_folder(experiment);
  const fs::path folder = path;
  if (fs::exists(folder) && !fs::is_directory(folder))
    refuse(folder, "a file", "a folder", "another name");
  OutputFolder out(folder);

  std::vector<std::string> names = names_in(folder);
  if (names.empty()) return out;
  if (!force) {
    if (names.size() > 4) names.resize(4), names.back() = "…";
    refuse(folder, fmt::format("{}", fmt::join(names, ", ")), "an empty folder",
           "another one, or force=true to replace the run in it");
  }
  if (!holds_a_run(folder, inputs)) return out;
  clear_unfinished(folder / unfinished_name);
  out.stage(std::string(unfinished_name));
  return out;
}

void commit_run(OutputFolder& folder) {
  std::vector<std::string> replaced = known_names();
  for (const std::string& name : figures_in(folder.path() / figures_name))
    replaced.push_back((fs::path(figures_name) / name).string());
  folder.commit(replaced);
}

std::string where_left(const OutputFolder& folder) {
  if (!folder.staged()) return "";
  const std::string before = folder.path().string() + ": holds what was there before";
  if (names_in(folder.work()).empty()) return "\n" + before;
  return fmt::format("\n{}; what this run left is in {}", before, folder.work().string());
}

void write_into(const OutputFolder& folder, std::string_view name, std::string_view text) {
  write_file(folder.work() / name, text, log::Replacement::Sync::later);
}

RunFiles run_files(const fs::path& named) {
  finish_replacing(fs::is_directory(named) ? named : named.parent_path());
  if (!fs::exists(named))
    refuse(named, "nothing", "the folder of a run, or its log", "the path, or sinew run first");
  const fs::path folder = fs::is_directory(named) ? named : named.parent_path();
  const fs::path log = fs::is_directory(named) ? named / log_name : named;
  if (!fs::exists(log))
    refuse(named, "no log.mcap", "the folder of a run", "a run with log.enabled=true");
  return {log, folder / resolved_name};
}

fs::path machine_of(const RunFiles& run, const std::string& instead) {
  const fs::path file = instead.empty() ? run.resolved : fs::path(instead);
  if (!fs::exists(file))
    refuse(file, "nothing", "what was run", "machine=resolved.toml of the run");
  return file;
}

}  // namespace sinew::run
