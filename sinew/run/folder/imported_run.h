// run/folder/imported_run.h - a recording of a laboratory as the folder of a run: log.mcap,
// resolved.toml, summary.json, report.html as any run leaves them, and mapping.toml, which says
// what its columns were taken for.
//
//   run::ImportRequest request{.files = {"rig.csv"}, .experiment = "experiments/one-joint.toml"};
//   request.mapping.columns = {{.name = "Winkel", .channel = "/joint/elbow/angle", .unit = "deg"}};
//   const auto kept = run::import_run(request);
//
// resolved.toml is the experiment's, with [[imported]] for each file. What a recording lacks and
// has otherwise is filled in (filled_channels.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sinew/experiment/imported.h"
#include "sinew/recording/mapping.h"
#include "sinew/run/folder/kept_run.h"

namespace sinew::run {

// A request: recordings, what they are of, and where the run is kept.
struct ImportRequest {
  std::vector<std::string> files;             // recordings: CSV, MCAP, MATLAB
  std::string experiment;                     // what was run: its robot, or its test stand
  std::vector<std::string> sets;              // "key=value" in place of the file's
  std::string mapping_file;                   // sinew.mapping/1; empty: none
  recording::Mapping mapping;                 // besides, and in place of the file's
  bool join_at_end = false;                   // files follow each other; else they are side by side
  std::map<std::string, std::string> shifts;  // file -> "0.12 s", by which it is later
  std::vector<std::string> values;            // "[PART:]CHANNEL=VALUE" of a whole file
  std::string save_mapping;  // a file for what the columns were taken for; empty: none
  std::string folder;        // as RunRequest's
  bool force = false;
  std::atomic<std::int64_t>* read = nullptr;  // counts the bytes of a table while it is read
};

// Keeps recordings of a machine as a run. Throws
// config::Error and log::Error; then there is no folder.
Kept import_run(const ImportRequest& request, const Notices& notices = {});

// Returns what a recording can hold of that machine: what a run logs, and what instruments measure
// besides.
std::vector<signals::Topic> importable_topics(const experiment::Experiment& experiment);

// Returns what [[imported]] says of a file, without what was taken of it. Throws log::Error.
experiment::ImportedFile imported_file(const std::string& path, const std::string& kind);

// Keeps a table that came from these files as a run of `e`. `mapping`: the text of mapping.toml;
// empty: there is none.
Kept keep_imported(const signals::Table& table, const experiment::Experiment& e,
                   std::vector<experiment::ImportedFile> files, const std::string& mapping,
                   const RunRequest& where, const Notices& notices = {});

}  // namespace sinew::run
