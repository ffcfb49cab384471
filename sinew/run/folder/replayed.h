// run/folder/replayed.h - replay of a stored run: its readings are fed to the present controller,
// or its valve commands to today's plant, and the result is compared with the recording.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/align/divergence.h"
#include "sinew/analysis/measures/valves.h"
#include "sinew/run/folder/notices.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// The part that is tested: the controller is fed with recorded readings, the plant with commands.
enum class ReplayOf { controller, plant };

// The run and the options of its replay.
struct ReplayRequest {
  std::string run;      // its folder, or its log
  std::string machine;  // description of the run, replaces the folder's
  ReplayOf of = ReplayOf::controller;
  std::vector<std::string> sets;      // "key=value", overrides the machine's
  std::optional<std::string> folder;  // stores the replay as a run; empty: runs/<experiment>/<n>
  bool force = false;                 // replaces the run in the folder
  double band = 0.05;                 // deviation, as a share of a channel's range, at which it has
                                      // parted
};

// The result of a replay.
struct Replayed {
  ReplayOf of = ReplayOf::controller;
  double duration = 0;                            // [s]
  analysis::EdgeComparison edges;                 // result of a controller
  std::vector<analysis::Divergence> divergences;  // result of a plant
  std::vector<std::string> rebuilt;               // duties that edges were calculated from
  double band = 0;                                // as requested
  std::string cause;                              // why it ended early; empty: it did not
  std::optional<std::filesystem::path> folder;    // folder of the stored replay

  // Returns whether the controller decided every edge again, or the plant stayed within the band.
  bool agrees() const;
};

// Throws config::Error if the run cannot be read, or lacks the required inputs; names their topics.
Replayed replay_run(const ReplayRequest& request, const Notices& notices = {});

// Returns JSON with "format": "sinew.replay/1", in SI.
std::string to_json(const Replayed& replayed);

// Returns tables of text of at most `width` letters; 0: any.
std::string text_of(const Replayed& replayed, const units::ShownUnits& units, std::size_t width);

}  // namespace sinew::run
