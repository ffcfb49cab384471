// run/simulation/valve_commands.h - what a recording says of its valves, as edges for a machine.
//
// A recording has a valve's edges, /valve/<muscle>/<inlet|exhaust>/open, or its commanded duty in
// each period, /muscle/<muscle>/<inlet|exhaust>_duty. Edges are taken as they are. From duties they
// are made as the low level makes them (control/joint/pulse_train.h): by its timing table, at its
// laws' ticks, after its vent at the start. A period without a sample keeps the last duty.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// All that the valves of a machine were told.
struct ValveCommands {
  std::vector<signals::Edge> edges;  // in ascending time
  std::vector<std::string> rebuilt;  // the topics of duties that edges were made from
  signals::Tick end = 0;             // of the recording
};

// Throws config::Error, naming every topic that is missing, where a valve has neither edges nor
// duties; `name` is the recording's.
ValveCommands valve_commands(const experiment::Experiment& experiment,
                             const signals::Table& recorded, const std::string& name = "recording");

// Returns the duty topics by the machine's valves: 2 x muscle + (0 inlet | 1 exhaust), then the
// four of a cylinder; and the topics of their edges.
std::vector<std::string> duty_topics(const experiment::Experiment& experiment);
std::vector<std::string> edge_topics(const experiment::Experiment& experiment);

}  // namespace sinew::run
