// run/controllers/columns.h - the columns of a run's log: every topic, with the function that gives
// its values.
//
// Topics that hardware logs as well come first, then those of a simulation only (/true/...), then
// the valves, whose edges are logged one by one. A topic exists if the machine has the part.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/legs.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/controllers/boards.h"
#include "sinew/run/controllers/drive.h"
#include "sinew/signals/table.h"
#include "sinew/world/machine.h"

namespace sinew::run {

// Everything that can be recorded at one instant. `drive` is nullptr for a robot, `measured` for a
// stand.
struct Snapshot {
  double time = 0;  // [s]
  const plant::Truths* true_of = nullptr;

  const MachineState* controller = nullptr;
  const gait::MachineMeasured* measured = nullptr;
  std::span<const gait::Desired> desired = {};  // one per leg

  const Drive* drive = nullptr;
};

// A column of a run's table.
struct Column {
  signals::Topic topic;                                     // has one or two fields
  std::function<void(const Snapshot&, double* out)> value;  // no heap, no exceptions

  // When it has a value; NaN otherwise. `never`: never under this experiment's plan.
  enum class Given { always, at_times, never } given = Given::always;
  bool is_of_motion = false;  // a true value that follows from the motion alone

  // Returns whether only a simulation can provide it.
  bool is_simulated_only() const { return topic.name.starts_with("/true/"); }
};

// Returns the columns in the order in which the recorder writes them.
std::vector<Column> columns(const experiment::Experiment& experiment);

// Returns the topics of the columns, followed by those of the valves by their index: 2 x muscle +
// (0 inlet | 1 exhaust), then the four of a cylinder. For a sweep of duties, returns the settled
// values of each stand instead.
std::vector<signals::Topic> topics(const experiment::Experiment& experiment);
// Returns the same, given the experiment's columns.
std::vector<signals::Topic> topics(const experiment::Experiment& experiment,
                                   std::span<const Column> columns);

}  // namespace sinew::run
