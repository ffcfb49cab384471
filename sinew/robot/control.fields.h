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
            .why = "every link has an inertia",
            .optional = true,
            .doc = "observers: inertia of all parts that turn with the joint"},
           velocity.inertia);
  units::optional_amount(v, "damping", "N m s/rad",
                         "observers: viscous damping in the observer's model", velocity.damping);
  v.flag({.name = "tensions",
          .optional = true,
          .doc = "observers: true: the model includes the torque of the measured tensions"},
         velocity.tensions);
  v.number({.name = "acceleration",
            .unit = "rad/s2",
            .min = observer ? 1e-9 : 0.0,
            .optional = !observer,
            .doc = "acceleration outside the model: its bound (bounded observer) or standard "
                   "deviation (kalman)"},
           velocity.acceleration);
  units::optional_amount(v, "speed_limit", "rad/s", "bounded observer: largest speed; 0: no limit",
                         velocity.speed_limit);
  v.number({.name = "noise",
            .unit = "count",
            .min = 0,
            .max = 1000,
            .optional = true,
            .doc = "kalman: standard deviation of the angle, in addition to its rounding"},
           velocity.noise);
  if (observer && velocity.inertia <= 0 && (velocity.tensions || velocity.damping > 0))
    units::report_conflict(v, "inertia", "none", "the joint's, for damping or tensions",
                           "inertia = \"0.01 kg m2\"");
}

template <class Visitor>
void fields(Visitor& v, Velocity& velocity) {
  using Estimator = Velocity::Estimator;
  v.choice({.name = "estimator",
            .doc = "estimator of the speed that velocity_gain multiplies, thesis 6.5, 7.3"},
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
             .doc = "weighted average: number of angles"},
            velocity.samples);
  v.numbers({.name = "weights",
             .unit = "1/s",
             .optional = true,
             .doc = "weighted average: newest first, sum 0; absent: those of a least-squares line"},
            velocity.weights);
  observer_fields(v, velocity);
}

template <class Visitor>
void fields(Visitor& v, PressureLaw& law) {
  units::optional_share(
      v, "bias", "duty of a 3-way valve, or share of a regulator's range, at zero error", law.bias);
  units::optional_amount(v, "angle_integral", "1/(count s)",
                         "regulators: gain of the integral in the angle law", law.angle_integral);
  units::optional_amount(v, "stiffness_integral", "1/(N m s/rad)",
                         "regulators: gain of the integral in the stiffness law",
                         law.stiffness_integral);
}

// Visits the board of a joint, of an air cylinder and of a fixed sensor.
template <class Visitor>
void board_field(Visitor& v, int& board) {
  v.integer({.name = "board",
             .min = 0,
             .max = max_boards,
             .optional = true,
             .doc = "board of the joint controller, from 1; 0: the next that has room"},
            board);
}

// Visits the controller's parameters other than the gains.
template <class Visitor>
void controller_fields(Visitor& v, Velocity& velocity, StiffnessSource& source, PressureLaw& law) {
  v.choice({.name = "stiffness_source",
            .optional = true,
            .doc = "sensors that give K_act of [58]: tensions [27], one tension, or pressures "
                   "[26]; none: U_k = 0"},
           source,
           {{"forces", StiffnessSource::forces},
            {"flexor force", StiffnessSource::flexor_force},
            {"extensor force", StiffnessSource::extensor_force},
            {"pressures", StiffnessSource::pressures},
            {"none", StiffnessSource::none}});
  v.group({.name = "velocity", .optional = true, .doc = "estimate of the joint's speed"},
          [&](auto& g) { fields(g, velocity); });
  v.group({.name = "pressure_law",
           .optional = true,
           .doc = "law of a joint with 3-way valves or regulators"},
          [&](auto& g) { fields(g, law); });
}

}  // namespace sinew::robot
