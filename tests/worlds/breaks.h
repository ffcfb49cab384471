// tests/worlds/breaks.h - faults of the air for planar subjects: all kinds of faults, in the first
// 0.7 s, at instants that are not on a grid, one after the other and several at once.
#pragma once

#include <vector>

#include "sinew/experiment/fault.h"

namespace sinew::worlds {

using Fault = experiment::Fault;
using Breaks = std::vector<Fault>;

// Faults of shutters and seats alone: they only change the valves' effective areas.
inline Breaks of_valves() {
  using What = Fault::What;
  return {
      {.at = 0.0213377, .lasts = 0.2, .of = "hip_flexor.inlet", .what = What::stuck_open},
      {.at = 0.0517, .lasts = 0.31, .of = "knee_flexor.exhaust", .what = What::stuck_shut},
      {.at = 0.1, .of = "knee_extensor.inlet", .what = What::leaking, .share = 0.05},
      {.at = 0.3, .lasts = 0.1, .of = "hip_flexor.inlet", .what = What::stuck_shut},
  };
}

// The other faults, most of which need more than valves. The supply fails below and at the room's
// pressure: a muscle whose inlet is open then empties through it.
inline Breaks of_everything() {
  using What = Fault::What;
  return {
      {.at = 0.0113377,
       .lasts = 0.3,
       .of = "hip_extensor.exhaust",
       .what = What::leaking,
       .area = 2e-8},
      {.at = 0.0423, .lasts = 0.05, .of = "supply", .what = What::failed, .pressure = 2e5},
      {.at = 0.1, .of = "hip_flexor", .what = What::leaking, .area = 1e-8, .conductance = 1e-11},
      {.at = 0.123456, .lasts = 0.2, .of = "knee_extensor", .what = What::blocked},
      {.at = 0.2, .lasts = 0.15, .of = "knee_flexor.inlet", .what = What::stuck_open},
      {.at = 0.25, .lasts = 0.1, .of = "knee_flexor", .what = What::ruptured},
      {.at = 0.5003, .of = "supply", .what = What::failed},
  };
}

// Faults of a cylinder's valves.
inline Breaks of_the_cylinder() {
  using What = Fault::What;
  return {
      {.at = 0.0213377, .lasts = 0.2, .of = "cylinder_up.inlet", .what = What::stuck_open},
      {.at = 0.1517, .lasts = 0.31, .of = "cylinder_down.exhaust", .what = What::stuck_shut},
      {.at = 0.3, .of = "cylinder_down.inlet", .what = What::leaking, .area = 2e-8},
  };
}

}  // namespace sinew::worlds
