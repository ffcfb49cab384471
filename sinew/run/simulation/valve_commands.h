// run/simulation/valve_commands.h - valve commands of a recording, as edges for a machine.
//
// A recording has a valve's edges, /valve/<muscle>/<inlet|exhaust>/open, or its commanded duty in
// each period, /muscle/<muscle>/<inlet|exhaust>_duty. Edges are used unchanged. Duties are
// converted into edges as by the low level (control/joint/pulse_train.h): with its timing table, at
// the ticks of its laws, after its vent at the start. A period without a sample keeps the last
// duty.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// All commands of a machine's valves.
struct ValveCommands {
  std::vector<signals::Edge> edges;  // in ascending time
  std::vector<std::string> rebuilt;  // topics of duties that edges were calculated from
  signals::Tick end = 0;             // end of the recording
};

// Throws config::Error, with the names of all missing topics, if a valve has neither edges nor
// duties; `name` is the recording's.
ValveCommands valve_commands(const experiment::Experiment& experiment,
                             const signals::Table& recorded, const std::string& name = "recording");

// Return the topics of the duties by the machine's valves: 2 x muscle + (0 inlet | 1 exhaust), then
// the four of a cylinder; and the topics of their edges.
std::vector<std::string> duty_topics(const experiment::Experiment& experiment);
std::vector<std::string> edge_topics(const experiment::Experiment& experiment);

}  // namespace sinew::run
