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
  v.choice({.name = "flexion", .doc = "effect of a shorter flexor on the angle"}, joint.flexion,
           {{"raises angle", Joint::Flexion::raises_angle},
            {"lowers angle", Joint::Flexion::lowers_angle}});
  v.number(
      {.name = "moment_arm", .unit = "m", .min = 1e-4, .doc = "radius of the joint's round cam"},
      joint.moment_arm);
  units::amount(v, "angle_gain", "1/count", "gain of the angle law, G_theta [59]",
                joint.gains.angle);
  units::amount(v, "stiffness_gain", "1/(N m/rad)", "gain of the stiffness law, G_k [58]",
                joint.gains.stiffness);
  units::optional_amount(v, "velocity_gain", "s/count", "gain of the velocity, G_v, thesis 6.5",
                         joint.gains.velocity);
  controller_fields(v, joint.velocity, joint.stiffness_source, joint.pressure_law);
  v.flag({.name = "enabled", .optional = true, .doc = "false: the joint is not controlled"},
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
             .doc = "lowest and highest angle, with the rest angle between them"},
            stop.range);
  units::amount(v, "stiffness", "N m/rad", "stiffness at either end", stop.stiffness);
  units::amount(v, "damping", "N m s/rad", "damping at either end", stop.damping);
}

template <class Visitor>
void fields(Visitor& v, Joint& joint) {
  constexpr double turn = 6.283185307179586;

  v.choice({.name = "kind",
            .optional = true,
            .doc = "driven: by muscles; passive: without muscles and sensors, such as an ankle"},
           joint.kind, {{"driven", Joint::Kind::driven}, {"passive", Joint::Kind::passive}});

  v.number({.name = "rest_angle",
            .unit = "rad",
            .min = 0,
            .max = turn,
            .doc = "angle at which all its muscles have their mount_length"},
           joint.rest_angle);
  units::amount(v, "dry_friction", "N m", "largest torque of the dry friction", joint.dry_friction);
  units::amount(v, "damping", "N m s/rad", "viscous damping", joint.damping);
  units::optional_amount(v, "damper", "N m s/rad",
                         "damping of a rotary damper at the joint, thesis 7.3", joint.damper);
  units::optional_amount(v, "spring", "N m/rad", "stiffness of a spring at the joint",
                         joint.spring);
  v.number({.name = "spring_angle",
            .unit = "rad",
            .min = 0,
            .max = turn,
            .optional = !(joint.spring > 0),
            .doc = "angle at which the spring has no torque"},
           joint.spring_angle);
  v.group({.name = "stop", .optional = true, .doc = "end stops of the joint"},
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
            .doc = "radius of a round cam; absent: the joint's"},
           cam.radius);
  v.group({.name = "cam", .optional = true, .doc = "cam that is not round"}, [&](auto& g) {
    g.numbers({.name = "angle", .unit = "rad", .doc = "joint angles of the points, ascending"},
              cam.angle);
    g.numbers({.name = "radius",
               .unit = "m",
               .min = 0,
               .doc = "radius at these angles, linear in between"},
              cam.radii);
  });
}

template <class Visitor>
void fields(Visitor& v, Muscle& muscle) {
  v.text({.name = "joint", .doc = "joint that it turns"}, muscle.joint);
  v.choice({.name = "role", .doc = "direction in which it turns the joint"}, muscle.role,
           {{"flexor", Muscle::Role::flexor}, {"extensor", Muscle::Role::extensor}});
  v.text({.name = "actuator", .doc = "name in the actuator file"}, muscle.actuator);
  v.integer({.name = "count", .min = 1, .max = 100, .doc = "number of actuators in parallel"},
            muscle.count);
  v.number(
      {.name = "mount_length", .unit = "m", .min = 1e-4, .doc = "length at the joint's rest angle"},
      muscle.mount_length);
  fields(v, muscle.cam);
  v.group({.name = "second", .optional = true, .doc = "second joint that the muscle crosses"},
          [&](auto& g) {
            g.text({.name = "joint", .doc = "name of that joint"}, muscle.second.joint);
            g.choice({.name = "role", .doc = "direction in which it turns that joint"},
                     muscle.second.role,
                     {{"flexor", Muscle::Role::flexor}, {"extensor", Muscle::Role::extensor}});
            fields(g, muscle.second.cam);
          });
  units::amount(v, "external_volume", "m3",
                "air volume of the whole bundle outside its actuators, behind the valves",
                muscle.external_volume);
  units::optional_amount(v, "bladder_stiffness", "N/m",
                         "stiffness of one actuator's bladder; absent: the actuator file's",
                         muscle.bladder_stiffness);
  units::optional_amount(v, "bladder_rest_length", "m",
                         "length at which the bladder has no tension; absent: the actuator file's",
                         muscle.bladder_rest_length);

  const auto bit =
      units::Field{.name = "bit", .min = 0, .max = 31, .doc = "bit of its board's output ports"};
  v.group({.name = "inlet", .doc = "inlet valve, which fills"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, muscle.inlet);
    g.integer(bit, muscle.inlet_bit);
  });
  v.group({.name = "exhaust",
           .optional = true,
           .doc = "exhaust valve, which empties; absent with a 3-way inlet"},
          [&](auto& g) {
            g.text({.name = "valve", .optional = true, .doc = "name in the valves file"},
                   muscle.exhaust);
            g.integer(bit, muscle.exhaust_bit);
          });
  v.group({.name = "hose", .optional = true, .doc = "hose between valves and muscle"},
          [&](auto& g) { gas::fields(g, muscle.hose); });
  v.group({.name = "leak", .optional = true, .doc = "leak to the room"},
          [&](auto& g) { gas::fields(g, muscle.leak); });
}

}  // namespace sinew::robot
