// run/bring_up/trial.h - a short run on a board that tries one thing: duties are commanded stage
// after stage, and the sensors' readings are recorded.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/control/joint/command.h"
#include "sinew/control/link/configuration.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::run {

// The readings of all sensors in a period, by the board's channels.
struct Sample {
  double time = 0;  // since the stage began [s]
  std::vector<double> counts;
  std::vector<signals::Status> status;
};

struct Stage {
  double seconds = 0;                   // longest duration
  std::vector<control::Duties> duties;  // one per joint of the board; if fewer: the others rest
  std::function<bool(const Sample&)> ends = {};  // ends the stage earlier if it returns true
};

// The samples of one stage. `before` and `after` are means over its first and last 50 ms.
struct Recording {
  std::vector<Sample> samples;

  // Returns its duration [s], and a channel's mean at its two ends [count].
  double seconds() const { return samples.empty() ? 0 : samples.back().time; }
  double before(std::size_t channel) const;
  double after(std::size_t channel) const;
};

struct Trial {
  std::vector<Recording> stages;
  std::string problem;  // why it ended early; empty: it did not
  std::string found;    // the board's fault before the trial; empty: no fault that matters
};

// Thrown after the operator stopped a trial; the board has vented.
struct Stopped {};

// The ways in which a trial may end.
enum class End { by_plan, at_once };  // at_once: an emergency stop

// Arms the board, executes the stages and ends the run, after which the board vents. `lead` is the
// lead of commands (remote_boards.h). Throws plant::BoardError if the board cannot be armed or
// sends another number of sensors, and Stopped in the period in which `stops` returns true.
Trial run_trial(plant::RemoteBoard& board, const link::Configuration& configuration, int lead,
                const std::vector<Stage>& stages, End end = End::by_plan,
                const std::function<bool()>& stops = {});

// Records the board's telemetry for some seconds while nothing runs. Throws plant::BoardError if
// the board sends nothing or has lost its configuration, for example after a reset.
Recording listen(plant::RemoteBoard& board, const link::Configuration& configuration,
                 double seconds);

}  // namespace sinew::run
