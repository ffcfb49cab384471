// run/controllers/columns.h - what a run's log holds: every topic with where its numbers come from.
//
// What hardware would log as well comes first, what only a simulation knows (/true/...) last, then
// the valves, whose edges are logged one by one. A topic is there if the machine has the part.
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

  const MachineSeen* seen = nullptr;
  const gait::MachineMeasured* measured = nullptr;
  std::span<const gait::Desired> desired = {};  // by leg

  const Drive* drive = nullptr;
};

// A column of a run's table.
struct Column {
  signals::Topic topic;                                     // of one or two fields
  std::function<void(const Snapshot&, double* out)> value;  // no heap, no exceptions

  // When it has a value; NaN else. `never`: not with this experiment's plan.
  enum class Given { always, at_times, never } given = Given::always;

  // Does only a simulation know it?
  bool of_truth() const { return topic.name.starts_with("/true/"); }
};

// In the order in which the recorder writes them.
std::vector<Column> columns(const experiment::Experiment& experiment);

// Of those, and after them of the valves by their index: 2 x muscle + (0 inlet | 1 exhaust), then
// the four of a cylinder. Of a sweep of duties what each stand settled at.
std::vector<signals::Topic> topics(const experiment::Experiment& experiment);

}  // namespace sinew::run
