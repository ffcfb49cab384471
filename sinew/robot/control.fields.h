// robot/control.fields.h - the keys of a joint's controller in robots/*/robot.toml.
#pragma once

#include "sinew/robot/control.h"
#include "sinew/robot/robot.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::robot {

// Visits the joint's parameters in an observer.
template <class Visitor>
void observer_fields(Visitor& v, Velocity& velocity) {
  using Estimator = Velocity::Estimator;
  const bool observer =
      velocity.estimator == Estimator::bounded_observer || velocity.estimator == Estimator::kalman;
  v.number({.name = "inertia",
            .unit = "kg m2",
            .min = 0,
            .least = 1e-16,
            .why = "a link has an inertia, a cricket's too",
            .optional = true,
            .doc = "observers: of everything that turns with the joint"},
           velocity.inertia);
  v.number({.name = "damping",
            .unit = "N m s/rad",
            .min = 0,
            .optional = true,
            .doc = "observers: viscous, as they take it"},
           velocity.damping);
  v.flag({.name = "tensions",
          .optional = true,
          .doc = "observers: true, the torque of the measured tensions is known"},
         velocity.tensions);
  v.number({.name = "acceleration",
            .unit = "rad/s2",
            .min = observer ? 1e-9 : 0.0,
            .optional = !observer,
            .doc = "not in the model: bounded observer, the largest; kalman, its deviation"},
           velocity.acceleration);
  v.number({.name = "speed_limit",
            .unit = "rad/s",
            .min = 0,
            .optional = true,
            .doc = "bounded observer: no speed is larger; 0: none"},
           velocity.speed_limit);
  v.number({.name = "noise",
            .unit = "count",
            .min = 0,
            .max = 1000,
            .optional = true,
            .doc = "kalman: of the angle, in addition to its rounding"},
           velocity.noise);
  if (observer && velocity.inertia <= 0 && (velocity.tensions || velocity.damping > 0))
    units::report_conflict(v, "inertia", "none", "the joint's, for damping or tensions",
                           "inertia = \"0.01 kg m2\"");
}

template <class Visitor>
void fields(Visitor& v, Velocity& velocity) {
  using Estimator = Velocity::Estimator;
  v.choice({.name = "estimator", .doc = "of the speed that velocity_gain works on, 6.5, 7.3"},
           velocity.estimator,
           {{"difference", Estimator::difference},
            {"weighted average", Estimator::weighted_average},
            {"bounded observer", Estimator::bounded_observer},
            {"kalman", Estimator::kalman},
            {"sensor", Estimator::sensor}});
  v.integer({.name = "samples",
             .min = 2,
             .max = 16,
             .optional = true,
             .doc = "weighted average: angles looked at"},
            velocity.samples);
  v.numbers({.name = "weights",
             .unit = "1/s",
             .optional = true,
             .doc = "weighted average: newest first, their sum 0; absent: a least-squares line"},
            velocity.weights);
  observer_fields(v, velocity);
}

template <class Visitor>
void fields(Visitor& v, PressureLaw& law) {
  v.number({.name = "bias",
            .unit = "1",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "duty of a 3-way valve, share of a regulator's range, without errors"},
           law.bias);
  v.number({.name = "angle_integral",
            .unit = "1/(count s)",
            .min = 0,
            .optional = true,
            .doc = "regulators: integral gain of the angle law"},
           law.angle_integral);
  v.number({.name = "stiffness_integral",
            .unit = "1/(N m s/rad)",
            .min = 0,
            .optional = true,
            .doc = "regulators: integral gain of the stiffness law"},
           law.stiffness_integral);
}

// Visits the board of a joint, of an air cylinder and of a fixed sensor.
template <class Visitor>
void board_field(Visitor& v, int& board) {
  v.integer({.name = "board",
             .min = 0,
             .max = max_boards,
             .optional = true,
             .doc = "of the low level that it is on, from 1; 0: the next that has room"},
            board);
}

// Visits the controller's parameters other than the gains.
template <class Visitor>
void controller_fields(Visitor& v, Velocity& velocity, StiffnessSource& source, PressureLaw& law) {
  v.choice({.name = "stiffness_source",
            .optional = true,
            .doc = "K_act of [58]: both tensions [27], one, both pressures [26]; none: U_k = 0"},
           source,
           {{"forces", StiffnessSource::forces},
            {"flexor force", StiffnessSource::flexor_force},
            {"extensor force", StiffnessSource::extensor_force},
            {"pressures", StiffnessSource::pressures},
            {"none", StiffnessSource::none}});
  v.group({.name = "velocity", .optional = true, .doc = "how the joint's speed is found"},
          [&](auto& g) { fields(g, velocity); });
  v.group({.name = "pressure_law",
           .optional = true,
           .doc = "of a joint with 3-way valves or regulators"},
          [&](auto& g) { fields(g, law); });
}

}  // namespace sinew::robot
