// run/folder/run_folder.h - where a run is kept: log.mcap, resolved.toml, summary.json,
// measured.csv, report.html.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/run/folder/output_folder.h"

namespace sinew::run {

inline constexpr std::string_view log_name = "log.mcap";
inline constexpr std::string_view resolved_name = "resolved.toml";
inline constexpr std::string_view measured_name = "measured.csv";  // of a test stand
inline constexpr std::string_view summary_name = "summary.json";
inline constexpr std::string_view mapping_name = "mapping.toml";     // of an import
inline constexpr std::string_view fault_log_name = "fault-log.csv";  // as a board has kept it
inline constexpr std::string_view figures_name = "figures";          // a folder

inline constexpr std::string_view unfinished_name = "unfinished";  // a folder: the next run

// Returns the folder where a run is kept, locked for this process. `asked` is made where it is
// missing; one that holds anything is refused, unless `force`. Where a run is in it already, the
// new one is written into unfinished/ within, until commit_run().
//
// Where `asked` is empty it is runs/<experiment>/<n>, n one above the highest there is. No number
// is ever used again while its folder stands, also when several runs start at once. Throws
// config::Error for a folder that cannot be made, is refused, or that another process writes to.
OutputFolder run_folder(const std::string& asked, bool force, const std::string& experiment);

// Says that the run is whole: it takes the place of an earlier one's files, and of nothing else.
// Throws config::Error where a file cannot take its place; the next process that comes to the
// folder does the rest.
void commit_run(OutputFolder& folder);

// Returns what stands where, for the error of a run that did not become whole; empty where nothing
// was there before it.
std::string where_left(const OutputFolder& folder);

// Writes a file of the run. Throws log::Error.
void write_into(const OutputFolder& folder, std::string_view name, std::string_view text);

// The files of a run that is kept.
struct RecordedRun {
  std::filesystem::path log;
  std::filesystem::path resolved;  // need not exist
};

// Finds the files of a run by its folder or its log. Finishes a replacement that a killed process
// left half done there. Throws config::Error where there is no run, or none with a log.
RecordedRun recorded_run(const std::filesystem::path& named);

// Returns the run's resolved.toml, or `instead` where it is not empty. Throws config::Error where
// there is no such file.
std::filesystem::path machine_of(const RecordedRun& run, const std::string& instead);

}  // namespace sinew::run
