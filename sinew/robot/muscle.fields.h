// robot/muscle.fields.h - the keys of joints, cams and muscles.
#pragma once

#include "sinew/gas/hose.fields.h"
#include "sinew/gas/leak.fields.h"
#include "sinew/robot/control.fields.h"
#include "sinew/robot/robot.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::robot {

// Visits the keys of joints with muscles.
template <class Visitor>
void driven_fields(Visitor& v, Joint& joint) {
  v.choice({.name = "flexion", .doc = "what a shorter flexor does to the angle"}, joint.flexion,
           {{"raises angle", Joint::Flexion::raises_angle},
            {"lowers angle", Joint::Flexion::lowers_angle}});
  v.number({.name = "moment_arm", .unit = "m", .min = 1e-4, .doc = "radius of the cam"},
           joint.moment_arm);
  v.number({.name = "angle_gain", .unit = "1/count", .min = 0, .doc = "G_theta [59]"},
           joint.gains.angle);
  v.number({.name = "stiffness_gain", .unit = "1/(N m/rad)", .min = 0, .doc = "G_k [58]"},
           joint.gains.stiffness);
  v.number(
      {.name = "velocity_gain", .unit = "s/count", .min = 0, .optional = true, .doc = "G_v, 6.5"},
      joint.gains.velocity);
  controller_fields(v, joint.velocity, joint.stiffness_source, joint.pressure_law);
  v.flag(
      {.name = "enabled", .optional = true, .doc = "false: the low level leaves the joint alone"},
      joint.enabled);
  board_field(v, joint.board);
}

template <class Visitor>
void fields(Visitor& v, Stop& stop) {
  constexpr double turns = 12.6;  // two, either way [rad]
  v.numbers({.name = "angles",
             .unit = "rad",
             .min = -turns,
             .max = turns,
             .doc = "lowest and highest angle, about the rest angle"},
            stop.range);
  v.number({.name = "stiffness", .unit = "N m/rad", .min = 0, .doc = "of either end"},
           stop.stiffness);
  v.number({.name = "damping", .unit = "N m s/rad", .min = 0, .doc = "of either end"},
           stop.damping);
}

template <class Visitor>
void fields(Visitor& v, Joint& joint) {
  constexpr double turn = 6.283185307179586;

  v.choice({.name = "kind", .optional = true, .doc = "passive: no muscles, no sensors, an ankle"},
           joint.kind, {{"driven", Joint::Kind::driven}, {"passive", Joint::Kind::passive}});

  v.number({.name = "rest_angle",
            .unit = "rad",
            .min = 0,
            .max = turn,
            .doc = "where both muscles have their mount_length"},
           joint.rest_angle);
  v.number({.name = "dry_friction", .unit = "N m", .min = 0, .doc = "largest"}, joint.dry_friction);
  v.number({.name = "damping", .unit = "N m s/rad", .min = 0, .doc = "viscous"}, joint.damping);
  v.number({.name = "damper",
            .unit = "N m s/rad",
            .min = 0,
            .optional = true,
            .doc = "of a rotary damper at the joint, 7.3"},
           joint.damper);
  v.number({.name = "spring", .unit = "N m/rad", .min = 0, .optional = true, .doc = "about it"},
           joint.spring);
  v.number({.name = "spring_angle",
            .unit = "rad",
            .min = 0,
            .max = turn,
            .optional = !(joint.spring > 0),
            .doc = "where the spring pulls nothing"},
           joint.spring_angle);
  v.group({.name = "stop", .optional = true, .doc = "what it strikes at the ends of its range"},
          [&](auto& g) { fields(g, joint.stop); });
  if (joint.kind == Joint::Kind::driven) driven_fields(v, joint);
}

// Keys of a cam; `moment_arm` and `cam` are in the table of the tendon.
template <class Visitor>
void fields(Visitor& v, Cam& cam) {
  v.number({.name = "moment_arm",
            .unit = "m",
            .min = 1e-4,
            .optional = true,
            .doc = "of a round cam; absent: the joint's"},
           cam.radius);
  v.group({.name = "cam", .optional = true, .doc = "one that is not round"}, [&](auto& g) {
    g.numbers({.name = "angle", .unit = "rad", .doc = "of the joint, ascending"}, cam.angle);
    g.numbers({.name = "radius", .unit = "m", .min = 0, .doc = "there; straight in between"},
              cam.radii);
  });
}

template <class Visitor>
void fields(Visitor& v, Muscle& muscle) {
  v.text({.name = "joint", .doc = "the joint it pulls"}, muscle.joint);
  v.choice({.name = "role", .doc = "which way"}, muscle.role,
           {{"flexor", Muscle::Role::flexor}, {"extensor", Muscle::Role::extensor}});
  v.text({.name = "actuator", .doc = "name in the actuator file"}, muscle.actuator);
  v.integer({.name = "count", .min = 1, .max = 100, .doc = "actuators in parallel"}, muscle.count);
  v.number({.name = "mount_length", .unit = "m", .min = 1e-4, .doc = "at the joint's rest angle"},
           muscle.mount_length);
  fields(v, muscle.cam);
  v.group({.name = "second", .optional = true, .doc = "another joint that it runs across"},
          [&](auto& g) {
            g.text({.name = "joint", .doc = "its name"}, muscle.second.joint);
            g.choice({.name = "role", .doc = "which way it pulls there"}, muscle.second.role,
                     {{"flexor", Muscle::Role::flexor}, {"extensor", Muscle::Role::extensor}});
            fields(g, muscle.second.cam);
          });
  v.number({.name = "external_volume",
            .unit = "m3",
            .min = 0,
            .doc = "of the whole bundle, downstream of the valves"},
           muscle.external_volume);
  v.number({.name = "bladder_stiffness",
            .unit = "N/m",
            .min = 0,
            .optional = true,
            .doc = "of one actuator; absent: as in the actuator's file"},
           muscle.bladder_stiffness);
  v.number({.name = "bladder_rest_length",
            .unit = "m",
            .min = 0,
            .optional = true,
            .doc = "where the bladder pulls nothing; absent: as in the actuator's file"},
           muscle.bladder_rest_length);

  const auto bit =
      units::Field{.name = "bit", .min = 0, .max = 31, .doc = "of its board's output ports"};
  v.group({.name = "inlet", .doc = "the valve that fills"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, muscle.inlet);
    g.integer(bit, muscle.inlet_bit);
  });
  v.group({.name = "exhaust",
           .optional = true,
           .doc = "the valve that empties; none with a 3-way inlet"},
          [&](auto& g) {
            g.text({.name = "valve", .optional = true, .doc = "name in the valves file"},
                   muscle.exhaust);
            g.integer(bit, muscle.exhaust_bit);
          });
  v.group({.name = "hose", .optional = true, .doc = "between its valves and it"},
          [&](auto& g) { gas::fields(g, muscle.hose); });
  v.group({.name = "leak", .optional = true, .doc = "to the room"},
          [&](auto& g) { gas::fields(g, muscle.leak); });
}

}  // namespace sinew::robot
