// identify/actuator/test_muscle.h - muscle that the tests of static laws measure.
#pragma once

#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

inline constexpr double test_rest_length = 0.25;  // [m]

// Returns a muscle similar to commercial ones: 10 mm, with a bladder that saturates and a
// threshold.
inline StaticSetting test_muscle() {
  StaticSetting s =
      setting_of({.rest_length = test_rest_length, .full_scale = 540, .top_pressure = 6.5e5});
  s.actuator.braid = {.thread_length = 0.28, .turns = 3.0};
  s.actuator.effectiveness.threshold = 4e4;
  s.actuator.bladder.stiffness = 900;
  s.actuator.bladder.saturating_tension = 110;
  s.actuator.bladder.saturation_length = 0.006;
  return s;
}

}  // namespace sinew::identify
