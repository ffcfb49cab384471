// air/test_machines.h - muscles for tests.
#pragma once

#include <vector>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/air/cylinder.h"
#include "sinew/air/muscle.h"

namespace sinew::air {

inline constexpr double inch = 0.0254, bar = 1e5;

inline gas::Valve valve(double area) {
  gas::Valve v{.name = "valve"};
  v.flow.area = area;
  v.opening_delay = 0.3e-3;
  v.closing_delay = 0.5e-3;
  return v;
}

// Returns a bundle of two of the thesis's actuators; `variation` changes every parameter a little.
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

inline gas::Hose iso_hose(double conductance, double volume = 0) {
  return {.law = gas::Hose::Law::iso6358,
          .sonic_conductance = conductance,
          .critical_pressure_ratio = 0.4,
          .volume = volume};
}

inline Cylinder thesis_cylinder() {
  Cylinder c{.bore = 0.627 * inch, .rod_diameter = 0.1875 * inch, .stroke = 2 * inch};
  c.dead_volume = {1e-6, 1.5e-6};
  for (const Side side : {up, down}) {
    c.inlet[side] = valve(4e-7);
    c.exhaust[side] = valve(5e-7);
  }
  return c;
}

// Returns muscles with every option: hoses of all kinds, leaks, a 3-way valve, a regulator.
inline std::vector<Muscle> everything() {
  std::vector<Muscle> muscles;
  for (int i = 0; i < 6; ++i) muscles.push_back(bundle(0.1 * i));
  muscles[0].hose = iso_hose(2e-9);
  muscles[1].hose = iso_hose(3e-9, 3e-6);
  muscles[2].hose = {.law = gas::Hose::Law::pipe, .length = 0.5, .inner_diameter = 2.5e-3};
  muscles[3].inlet.kind = gas::Valve::Kind::three_way;
  muscles[3].hose = muscles[2].hose;
  muscles[4].inlet.kind = gas::Valve::Kind::regulator;
  muscles[4].inlet.regulator = {.range = 6 * bar, .time_constant = 0.02};
  muscles[5].leak = {.area = 1e-8, .conductance = 1e-11};
  muscles[1].leak = {.area = 2e-8};
  return muscles;
}

}  // namespace sinew::air
