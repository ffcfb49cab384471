// cli/run_folder.h - where a run is kept: log.mcap, resolved.toml, summary.json, measured.csv,
// report.html.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::cli {

inline constexpr std::string_view log_name = "log.mcap";
inline constexpr std::string_view resolved_name = "resolved.toml";
inline constexpr std::string_view measured_name = "measured.csv";  // of a test stand
inline constexpr std::string_view summary_name = "summary.json";
inline constexpr std::string_view figures_name = "figures";  // a folder

// With those above it; there already is fine. Throws config::Error where it cannot be made.
void make_folders(const std::filesystem::path& folder);

// runs/<experiment>/<n>, n one above the highest there is: no number is ever used again while its
// folder stands, also when several runs start at once.
std::filesystem::path next_run_folder(const std::string& experiment);

// The folder that was asked for, made where it is missing. One that holds anything is refused,
// unless `force`; then the files of an earlier run are removed from it, and nothing else.
std::filesystem::path chosen_run_folder(const std::filesystem::path& folder, bool force);

// What `sinew analyze`, `export` and `replay` are given: a run's folder, or its log alone.
struct RecordedRun {
  std::filesystem::path log;
  std::filesystem::path resolved;  // need not exist
};
RecordedRun recorded_run(const std::filesystem::path& named);

// The run's resolved.toml, or `instead` where it is not empty; throws config::Error where there is
// no such file.
std::filesystem::path machine_of(const RecordedRun& run, const std::string& instead);

// Throws config::Error where the file exists, unless `force`.
void refuse_to_overwrite(const std::filesystem::path& file, bool force);

void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace sinew::cli
