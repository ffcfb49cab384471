// run/folder/imported_run.h - import of a laboratory's recording as the folder of a run: log.mcap,
// resolved.toml, summary.json and report.html like those of any run, and mapping.toml, which states
// the channel of each column.
//
//   run::ImportRequest request{.files = {"rig.csv"}, .experiment = "experiments/one-joint.toml"};
//   request.mapping.columns = {{.name = "Winkel", .channel = "/joint/elbow/angle", .unit = "deg"}};
//   const auto kept = run::import_run(request);
//
// resolved.toml is that of the experiment, with [[imported]] for each file. Missing channels are
// calculated from the recorded ones where possible.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sinew/experiment/imported.fields.h"
#include "sinew/recording/mapping.h"
#include "sinew/robot/robot.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// The recordings, their machine, and the folder of the run.
struct ImportRequest {
  std::vector<std::string> files;             // recordings: CSV, MCAP, MATLAB
  std::string experiment;                     // experiment that was run: its robot, or its test
                                              // stand
  std::vector<std::string> sets;              // "key=value", overrides the file's
  std::string mapping_file;                   // sinew.mapping/1; empty: none
  recording::Mapping mapping;                 // in addition to mapping_file's, and overriding it
  bool join_at_end = false;                   // files follow each other in time; else they are
                                              // parallel
  std::map<std::string, std::string> shifts;  // file -> "0.12 s", its delay
  std::vector<std::string> values;            // "[PART:]CHANNEL=VALUE", constant over a file
  std::string save_mapping;  // output file for the mapping that was used; empty: not written
  std::string folder;        // as in RunRequest
  bool force = false;
  std::atomic<std::int64_t>* read = nullptr;  // counts the bytes of a table that have been read
};

// Stores recordings of a machine as a run. Throws config::Error and log::Error; no folder is left
// then.
StoredRun import_run(const ImportRequest& request, const Notices& notices = {});

// Returns the topics that a recording of the machine can contain: those that a run logs and
// those of additional instruments.
std::vector<signals::Topic> importable_topics(const experiment::Experiment& experiment);

// Returns the [[imported]] entry of a file, without its columns. Throws log::Error.
experiment::ImportedFile imported_file(const std::string& path, const std::string& kind);

// Stores a table that came from these files as a run of `e`. `mapping` is the text of mapping.toml;
// empty: no such file.
StoredRun store_imported(const signals::Table& table, const experiment::Experiment& e,
                         std::vector<experiment::ImportedFile> files, const std::string& mapping,
                         const RunRequest& where, const Notices& notices = {});

// Completion of a recording's missing channels.
//
// A laboratory records angles in degrees; a replay feeds the controller with the counts of its
// converter. Each is calculated from the other by the scales that the controller assumes, or for a
// force by the transducer's own scale:
//
//   angle   = rest_angle + (count - assumed.at_rest) / assumed.scale
//   tension = (count - assumed.at_rest) / (scale counts_per_volt)
//   gauge   = (count - assumed.at_rest) / (assumed.scale counts_per_volt)
//   travel  = (count - assumed.at_rest) / assumed.scale
//
// Counts are rounded and limited to the converter's range.

// Adds /sensor/<name>/count if its quantity is recorded, and the quantity if the counts are
// recorded and it is among `logged`, the topics that a run logs. The description of an added
// channel states its origin. `atmosphere` [Pa]. Returns a sentence for each kind of change, and for
// counts beyond the converter's range.
std::vector<std::string> fill_channels(signals::Table& table, const robot::Robot& robot,
                                       double atmosphere,
                                       const std::vector<signals::Topic>& logged);

}  // namespace sinew::run
