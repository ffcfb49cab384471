#include "sinew/run/card/plan_table.h"

#include <algorithm>
#include <optional>

namespace sinew::run {

using signals::Tick;

bool measures(const gait::Plan& plan) {
  return std::ranges::any_of(plan.phases, [](const gait::Phase& phase) {
    return !phase.until.measure.empty() || phase.ground_force.given();
  });
}

PlanTable::PlanTable(const Controllers& controllers, Tick last)
    : period_(controllers.scan().period) {
  HighLevel high = *controllers.gait();
  const MachineState at_rest = controllers.boards().state();
  const Board& board = controllers.boards().each().front();
  for (Tick t = 0; t < last; t += period_) {
    commands_.push_back(board.own(high.update(at_rest, t)));
    desired_.push_back(high.desired().front());
    if (high.finished()) vents_at_ = std::min(vents_at_, t);
  }
  unreachable_periods_ = high.legs().unreachable_periods();
}

}  // namespace sinew::run
