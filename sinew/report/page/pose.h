// report/page/pose.h - how the machine stood at every row of a log: the part of the scene that
// moves.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/report/page/channels.h"

namespace sinew::report {

struct Poses {
  std::vector<analysis::Column> angle;  // of every joint [rad]; empty: not known
  analysis::Column trolley, lift;       // of the body [m]; zeros where it does not move
  bool is_true = false;                 // as simulated, not as measured

  // Does the log say how the machine stood?
  bool known() const { return !angle.empty(); }
};

// True angles where the log has them, else measured ones. A joint of which a log of hardware says
// nothing stays at its rest angle, if another one is known.
Poses poses(const analysis::Machine& machine, const analysis::Record& record);

// Length of a muscle by its cams, at those angles of the robot's joints  [m].
double length_by_cams(const robot::Robot& robot, const robot::Muscle& muscle,
                      const std::vector<double>& angles);

}  // namespace sinew::report
