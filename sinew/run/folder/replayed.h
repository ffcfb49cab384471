// run/folder/replayed.h - a run that is kept, replayed: its readings through today's controller, or
// its valves' commands through today's plant; where what comes out parts from what was recorded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/align/parting.h"
#include "sinew/analysis/measures/valves.h"
#include "sinew/run/folder/notices.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// The part that is tried: recorded readings are fed to the controller, or commands to the plant.
enum class ReplayOf { controller, plant };

// Which run is replayed, and how.
struct ReplayRequest {
  std::string run;      // its folder, or its log
  std::string machine;  // what was run, in place of the folder's
  ReplayOf of = ReplayOf::controller;
  std::vector<std::string> sets;      // "key=value" in place of the machine's
  std::optional<std::string> folder;  // keeps the replay as a run; empty: runs/<experiment>/<n>
  bool force = false;                 // replace the run that is in the folder
  double band = 0.05;                 // share of a channel's range beyond which it has parted
};

// Holds what came of a replay.
struct Replayed {
  ReplayOf of = ReplayOf::controller;
  double duration = 0;                          // [s]
  analysis::EdgeComparison edges;               // of a controller
  std::vector<analysis::Parting> partings;      // of a plant
  std::vector<std::string> rebuilt;             // duties that edges were made from
  double band = 0;                              // as of the request
  std::string cause;                            // why it ended early; empty where it did not
  std::optional<std::filesystem::path> folder;  // where it is kept

  // Does the controller decide every edge again, or the plant stay within the band throughout?
  bool agrees() const;
};

// Throws config::Error where the run cannot be read, or lacks what is to be fed, naming its topics.
Replayed replay_run(const ReplayRequest& request, const Notices& notices = {});

// "format": "sinew.replay/1", in SI.
std::string to_json(const Replayed& replayed);

// As tables for people; `width` in letters, 0: any.
std::string text_of(const Replayed& replayed, const units::ShownUnits& units, std::size_t width);

}  // namespace sinew::run
