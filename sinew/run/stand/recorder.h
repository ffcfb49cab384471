// run/stand/recorder.h - watches a run on the stand and fills the channel table.
//
// What hardware would log as well comes first, then what only a simulation knows (/true/...), then
// the valves, whose edges are logged one by one. The table is reserved before the run.
#pragma once

#include <functional>
#include <vector>

#include "sinew/run/stand/drive.h"
#include "sinew/signals/table.h"
#include "sinew/world/stand.h"

namespace sinew::rig {

// Everything that can be recorded at one instant.
struct Snapshot {
  const DriveSeen& seen;
  const plant::StandTruth& truth;
  double time = 0;  // [s]
};

struct Column {
  signals::Topic topic;                          // of one field
  std::function<double(const Snapshot&)> value;  // no heap, no exceptions
};

// Returns what is recorded of the stand, in the order of its table; and the topics of its valves.
std::vector<Column> columns(const Experiment& experiment);
std::vector<signals::Topic> valve_topics(const Experiment& experiment);

class Recorder {
 public:
  // Looks at the controller and the stand, which outlive it, up to the tick `end`; at each tick
  // where `every_tick`.
  Recorder(const Experiment& experiment, const Controller& controller, plant::Stand& stand,
           signals::Tick end, bool every_tick);

  // The loop's side: a command, an edge, the instant of a sample, and the next tick at which there
  // is one.
  void command(signals::Tick) noexcept {}
  void edge(const signals::Edge& edge) noexcept;
  void sample(signals::Tick t) noexcept;
  signals::Tick next(signals::Tick t) const noexcept { return every_tick_ ? t + 1 : next_; }

  // What was recorded. Once, after the run.
  signals::Table take();

 private:
  const Controller& controller_;
  plant::Stand& stand_;
  std::vector<Column> columns_;
  std::vector<signals::Topic> valves_;
  std::vector<double> rows_;
  std::vector<std::int64_t> row_time_ns_;
  std::vector<signals::Edge> edges_;
  signals::Tick period_ = 10, next_ = 0;
  bool every_tick_ = false, complete_ = true;
};

}  // namespace sinew::rig
