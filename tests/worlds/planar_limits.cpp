// tests/worlds/planar_limits.cpp - the limits of planar subjects that are not the defaults.
#include "tests/worlds/body.h"

namespace sinew::worlds {

// Known exceptions, each with the measured figures.
Limits planar_limits(const std::string& name) {
  Limits l;
  // A short muscle with little air fills within a few milliseconds (0.19 N, 1240 Pa, 0.11 mg).
  if (name == "one_joint")
    l.preview_place = 2.7e-6, l.preview_tension = 0.22, l.preview_pressure = 1400,
    l.preview_mass = 1.3e-7;
  // A light foot on a stiff spring: within a millisecond its acceleration turns (1.2e-3 rad, 0.34
  // N; 4e-3 J of 71 J, which fall by 32 with the step's half).
  if (name == "three_joints" || name == "ankle") {
    l.preview_angle = 1.4e-3, l.preview_place = 3.5e-5, l.preview_tension = 0.4;
    l.rubbing_angle = 1.3e-3;
    l.error = l.driven_error = 3e-5, l.energy = 1e-4;
  }
  // Light toes (3.3e-5 rad; 1.8e-3 rad where they stand, in steps twice as long as the ground's
  // damper alone would bear); from 1 ms on the error is near rounding (7e-10 rad; 1.3e-8 of the
  // energy).
  if (name == "six_legs") {
    l.preview_angle = 4.5e-5, l.rubbing_angle = 2e-3;
    l.order = l.driven_order = -1, l.energy = 2e-8;
  }
  // The body accelerates on its cylinder (3.9e-5 rad, 4.0e-6 m; 1.4e-3 rad, 1.5e-4 m where the foot
  // lands). Chambers near the supply's pressure are faster than a step (9e-9 m).
  if (name == "moving_cylinder") {
    l.preview_angle = 5e-5, l.preview_place = 5e-6, l.preview_pressure = 1000;
    l.rubbing_angle = 1.7e-3, l.rubbing_place = 1.8e-4;
    l.driven_order = -1;
  }
  // The body falls on its stop, and the step is not divided where it arrives (7e-5 rad at 1 ms).
  if (name == "regulated_cylinder") l.order = l.driven_order = -3, l.error = l.driven_error = 2e-3;
  // Stretched and filled at once, a short muscle with little air (0.24 N).
  if (name == "driven_length") l.preview_tension = 0.28;
  // Never sealed: a flow that vents passes from choked to not choked to linear (order 1.9).
  if (name == "leg_3_way") l.order = 1.5;
  // Regulators have such kinks all the time (order 0.6, 2.0e-6 rad; 0.29 N, 1360 Pa, 0.21 mg).
  if (name == "regulators") {
    l.order = l.driven_order = -2, l.error = l.driven_error = 1e-5;
    l.preview_tension = 0.35, l.preview_pressure = 1600, l.preview_mass = 2.5e-7;
  }
  // Hoses add an error of their own within a step, along a length that runs on straight (8e-7 rad;
  // driven 8e-6).
  if (name == "hoses_with_air")
    l.order = l.driven_order = -2, l.error = 2e-6, l.driven_error = 2e-5;
  // The mesh's memory changes at nodes alone, so a reversal of the pressure is seen a step late
  // (order 2.7; driven 1.8 and 2.5e-6).
  if (name == "memory") l.order = 1, l.error = 1e-6, l.driven_order = 0.5, l.driven_error = 1e-5;
  // Delays and failures depend on the pressure at the last node, however old (order 0.6, 1.2e-6).
  if (name == "failing_valves") l.driven_order = -1, l.driven_error = 1e-5;
  // An inlet stands open until its muscle is full, then settles at the supply's pressure (0.20 N,
  // 1530 Pa, 0.23 mg).
  if (name == "broken_valves")
    l.preview_tension = 0.24, l.preview_pressure = 1800, l.preview_mass = 2.8e-7;
  // A muscle is lost within milliseconds, a supply at once (8.0e-5 rad, 9.3e-6 m, 0.15 N), and
  // flows turn round and change their law (order 1.3 with valves at random, 4.3e-7).
  if (name.starts_with("broken_") && name != "broken_valves") {
    l.preview_angle = 1e-4, l.preview_place = 1.2e-5, l.preview_tension = 0.18;
    l.driven_order = 0;
  }
  // Steps of 1 ms are divided while a valve is open, those of 0.25 ms less or never
  // (order 1.5, 4.0e-9 rad; broken -0.2, 4.0e-8).
  if (name == "heat") l.driven_order = 1, l.driven_error = 1e-8;
  if (name == "broken_heat") l.driven_order = -1, l.driven_error = 1e-7;
  // As of hoses without a fault (driven 1.5e-5 rad).
  if (name == "broken_hoses") l.order = l.driven_order = -2, l.error = 2e-6, l.driven_error = 3e-5;
  // A chamber whose valve is open is faster than a step (order 2.0, 2.3e-7 m).
  if (name == "broken_cylinder") l.order = 1.5, l.error = 5e-7;
  return l;
}

}  // namespace sinew::worlds
