// actuator/thesis_actuator.h - the actuator of Colbrunn (2000) with the equations' constants, for
// tests and examples without a file. Robots read robots/*/actuator.toml.
#pragma once

#include "sinew/actuator/actuator.h"
#include "sinew/actuator/braid.h"

namespace sinew::actuator {

inline constexpr double thesis_atmosphere = 101352.9322095749;  // 14.7 psi [Pa]

inline Actuator thesis_actuator() {
  Actuator a;
  a.name = "bpa";
  a.braid = braid_from_trapezoids(37, 16, 0.0014478);
  a.effectiveness = {.c0 = 0.9969,
                     .c1 = 7.251886886510462e-08,
                     .c2 = -4.2071890731793917e-13,
                     .scale = 1,
                     .argument = Effectiveness::Argument::gauge};
  a.long_end = {.length = 0.0995172, .stiffness = 87563.41762323819, .damping = 122.58878467253345};
  a.short_end = {
      .law = ShortEnd::Law::stop, .stiffness = a.long_end.stiffness, .damping = a.long_end.damping};
  a.loss = {.viscous = 3.5025367049295273, .coulomb_length = 0.00011176};
  return a;
}

}  // namespace sinew::actuator
