// control/gait/test_walk.h - plan of the thesis's walk, [65]-[70] and table 6-2.
#pragma once

#include "sinew/control/gait/plan.h"
#include "sinew/robot/test_leg.h"

namespace sinew::gait::test {

using robot::test::degree;
using robot::test::inch;

inline Phase phase(const std::string& name, double duration) {
  Phase phase;
  phase.name = name;
  phase.duration = duration;
  phase.joints.resize(2);
  return phase;
}

inline Plan walk(const robot::Robot& robot, double step = 1.5) {
  Phase swing = phase("swing", step);
  swing.x = {.from = -6.5 * inch, .to = 3 * inch, .polynomial = {}, .of = Coordinate::Of::s};
  swing.y.polynomial = {-11.75 * inch, -0.2571, -0.081 / inch};
  swing.y.of = Coordinate::Of::x;

  Phase plant = phase("foot_plant", 0.03);
  plant.thesis_duration = 0.01;
  plant.x = {.from = 3 * inch, .to = 2 * inch, .polynomial = {}, .of = Coordinate::Of::s};
  plant.y.polynomial = {-14 * inch, 0.25};
  plant.y.of = Coordinate::Of::x;

  Phase propulsion = phase("propulsion", step);
  propulsion.x = {.from = 2 * inch, .to = -6.5 * inch, .polynomial = {}, .of = Coordinate::Of::s};
  propulsion.y.polynomial = {-13.5 * inch};

  Plan plan = plan_for(robot);
  plan.joints[0].stiffness = 3.95;
  plan.joints[1].stiffness = 2.26;
  plan.phases = {swing, plant, propulsion};
  plan.sequence = {"swing", "foot_plant", "propulsion"};
  plan.repeat = 4;
  return plan;
}

}  // namespace sinew::gait::test
