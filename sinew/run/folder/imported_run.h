// run/folder/imported_run.h - a recording of a laboratory as the folder of a run: log.mcap,
// resolved.toml, summary.json, report.html as any run leaves them, and mapping.toml, which says
// what its columns were taken for.
//
//   run::ImportRequest request{.files = {"rig.csv"}, .experiment = "experiments/one-joint.toml"};
//   request.mapping.columns = {{.name = "Winkel", .channel = "/joint/elbow/angle", .unit = "deg"}};
//   const auto kept = run::import_run(request);
//
// resolved.toml is the experiment's, with [[imported]] for each file. What a recording lacks and
// has otherwise is filled in.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sinew/experiment/imported.h"
#include "sinew/recording/mapping.h"
#include "sinew/robot/robot.h"
#include "sinew/run/folder/kept_run.h"
#include "sinew/signals/table.h"

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

// What a recording of a machine lacks and what it has says.
//
// A laboratory records angles in degrees; a replay feeds the controller with the counts of its
// converter. Either follows from the other by the scales that the controller believes, of a
// transducer for forces by its own:
//
//   angle   = rest_angle + (count - assumed.at_rest) / assumed.scale
//   tension = (count - assumed.at_rest) / (scale counts_per_volt)
//   gauge   = (count - assumed.at_rest) / (assumed.scale counts_per_volt)
//   travel  = (count - assumed.at_rest) / assumed.scale
//
// Counts are whole, and end with the converter.

// Adds /sensor/<name>/count where its quantity is there, and the quantity where the counts are, if
// it is among the `logged`, those that a run logs; what was added says so in its description.
// `atmosphere` [Pa]. Returns a sentence for each kind of
// thing that was done, and for counts beyond the converter's ends.
std::vector<std::string> fill_channels(signals::Table& table, const robot::Robot& robot,
                                       double atmosphere,
                                       const std::vector<signals::Topic>& logged);

}  // namespace sinew::run
