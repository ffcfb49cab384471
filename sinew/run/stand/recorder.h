// run/stand/recorder.h - watches a run on the stand and fills the channel table.
//
// What hardware would log as well comes first, then what only a simulation knows (/true/...), then
// the valves, whose edges are logged one by one. The table is reserved before the run.
#pragma once

#include <functional>
#include <vector>

#include "sinew/plant/slide/stand.h"
#include "sinew/run/stand/drive.h"
#include "sinew/signals/table.h"

namespace sinew::rig {

struct Snapshot {
  const DriveSeen& seen;
  const plant::StandTruth& truth;
  double time = 0;  // [s]
};

struct Column {
  signals::Topic topic;                          // of one field
  std::function<double(const Snapshot&)> value;  // no heap, no exceptions
};

std::vector<Column> columns(const Experiment& experiment);
std::vector<signals::Topic> valve_topics(const Experiment& experiment);

class Recorder {
 public:
  Recorder(const Experiment& experiment, const Controller& controller, plant::Stand& stand,
           signals::Tick end, bool every_tick);

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
