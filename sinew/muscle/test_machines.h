// muscle/test_machines.h - muscles for tests.
#pragma once

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/muscle/muscle.h"

namespace sinew::muscle {

inline constexpr double inch = 0.0254;

inline gas::Valve valve(double area) {
  gas::Valve v{.name = "valve"};
  v.flow.area = area;
  v.opening_delay = 0.3e-3;
  v.closing_delay = 0.5e-3;
  return v;
}

// Two of the thesis's actuators in a bundle; `variation` changes every parameter a little.
inline Muscle bundle(double variation) {
  Muscle m{.name = "bundle", .actuator = actuator::thesis_actuator()};
  m.actuator.braid.thread_length *= 1 + 0.02 * variation;
  m.actuator.effectiveness.scale = 1 - 0.1 * variation;
  m.actuator.bladder = {.stiffness = 300 * variation, .rest_length = 3.15 * inch};
  m.count = 2;
  m.external_volume = 4e-6 * (1 + variation);
  m.inlet = valve(5e-7);
  m.exhaust = valve(2e-6);
  return m;
}

}  // namespace sinew::muscle
