#include <cmath>

#include "sinew/control/gait/legs.h"
#include "sinew/experiment/experiment.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

using signals::Tick;

Tick last_tick(const Experiment& e) {
  // One tick more than the run of a stand takes, so that its last instant is sampled too.
  if (e.stand) return std::llround(e.stand->duration / signals::tick_seconds) + 1;
  const double vent = e.plan.finish == gait::Plan::Finish::vent ? e.robot.low_level.vent_time : 0.0;
  const auto brain_ticks = std::llround(e.plan.brain_period / signals::tick_seconds);
  const Tick plan = gait::periods(e.robot, e.plan) * brain_ticks;
  // One period for the last valves to shut, and for a sample of where the plan has led to.
  const Tick last = e.robot.low_level.pwm_ticks;
  return plan + std::llround(vent / signals::tick_seconds) + last;
}

}  // namespace sinew::experiment
