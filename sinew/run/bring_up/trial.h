// run/bring_up/trial.h - a short run on a board that tries one thing: duties from outside, stage
// after stage, and what the sensors said to them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/control/joint/command.h"
#include "sinew/control/link/configuration.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::run {

// What all sensors say in a period, by the board's channels.
struct Sample {
  double time = 0;  // since the stage began [s]
  std::vector<double> counts;
  std::vector<signals::Status> status;
};

struct Stage {
  double seconds = 0;                   // for so long
  std::vector<control::Duties> duties;  // of each of the board's joints; fewer: the others rest
  std::function<bool(const Sample&)> ends = {};  // or until this says so
};

// One stage's samples. `before` and `after` are means over its first and last 50 ms.
struct Recording {
  std::vector<Sample> samples;

  // Returns how long it lasted  [s]; and what the channel read at its two ends  [count].
  double seconds() const { return samples.empty() ? 0 : samples.back().time; }
  double before(std::size_t channel) const;
  double after(std::size_t channel) const;
};

struct Trial {
  std::vector<Recording> stages;
  std::string problem;  // why it ended before its end; empty: it did not
  std::string found;    // the fault that the board was in before it; empty: none that matters
};

// Somebody has asked for a stop in the middle of a trial; the board has vented.
struct Stopped {};

// How a trial may end.
enum class End { by_plan, at_once };  // at once: as a person asks for it in an emergency

// Arms the board, works off the stages and ends the run: the board vents. `lead` is that of
// commands (remote_boards.h). Throws plant::BoardError where the board does not come to an armed
// state or tells of other sensors, and Stopped as soon as `stops` says so in a period.
Trial try_out(plant::RemoteBoard& board, const link::Configuration& configuration, int lead,
              const std::vector<Stage>& stages, End end = End::by_plan,
              const std::function<bool()>& stops = {});

// Hears the board for so long while nothing runs. Throws plant::BoardError where it says nothing,
// or has left what it was told, as after a reset.
Recording listen(plant::RemoteBoard& board, const link::Configuration& configuration,
                 double seconds);

}  // namespace sinew::run
