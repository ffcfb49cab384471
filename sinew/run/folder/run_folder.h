// run/folder/run_folder.h - the folder of a run: log.mcap, resolved.toml, summary.json,
// measured.csv, report.html.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/run/folder/files.h"

namespace sinew::run {

inline constexpr std::string_view log_name = "log.mcap";
inline constexpr std::string_view resolved_name = "resolved.toml";
inline constexpr std::string_view measured_name = "measured.csv";  // for a test stand
inline constexpr std::string_view summary_name = "summary.json";
inline constexpr std::string_view mapping_name = "mapping.toml";     // for an import
inline constexpr std::string_view fault_log_name = "fault-log.csv";  // as stored by a board
inline constexpr std::string_view figures_name = "figures";          // a folder

inline constexpr std::string_view report_name = "report.html";

// Kinds of a run's files that other commands write too.
inline constexpr FileKind summary_kind{"summary of a run", "such a summary",
                                       "{\"format\":\"sinew.summary/", FileKind::At::start};
inline constexpr FileKind report_kind{"page of a run", "such a page", "\"format\":\"sinew.report/"};

inline constexpr std::string_view unfinished_name = "unfinished";  // a folder: the next run, until
                                                                   // complete

// Returns the folder of a run, locked for this process. `path` is created if it is missing; a
// folder that is not empty is refused unless `force` is set. Even then it is refused if a file that
// the run would replace is not that of a run, or is one of `inputs`. If the folder contains a run,
// the new one is written into unfinished/ within it until commit_run().
//
// An empty `path` selects runs/<experiment>/<n> with the lowest n above all existing ones. A
// number is never used twice while its folder exists, even if several runs start at once. Throws
// config::Error for a folder that cannot be created, is refused, or is locked by another process.
OutputFolder run_folder(const std::string& path, bool force, const std::string& experiment,
                        const std::vector<std::filesystem::path>& inputs = {});

// Completes the run: it replaces the files of an earlier one, and no others. Throws config::Error
// if a file cannot be moved to its place; the next process that opens the folder completes the
// move.
void commit_run(OutputFolder& folder);

// Returns the places of the earlier run and of the incomplete one, for the error message of a
// run that failed; empty if there was no earlier run.
std::string where_left(const OutputFolder& folder);

// Writes a file of the run. Throws log::Error.
void write_into(const OutputFolder& folder, std::string_view name, std::string_view text);

// The files of a stored run.
struct RunFiles {
  std::filesystem::path log;
  std::filesystem::path resolved;  // need not exist
};

// Finds the files of a run by its folder or its log. Completes a move of files that a killed
// process left incomplete. Throws config::Error if there is no run, or it has no log.
RunFiles run_files(const std::filesystem::path& named);

// Returns the run's resolved.toml, or `instead` if it is not empty. Throws config::Error if the
// file does not exist.
std::filesystem::path machine_of(const RunFiles& run, const std::string& instead);

}  // namespace sinew::run
