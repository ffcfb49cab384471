// robot/robot.fields.h - the keys of robots/*/robot.toml: name, unit, range and meaning of each.
//
// See units/field.h for what a visitor has. The table [air] belongs to gas; what `files` names is
// put beside these tables by config/compose.h.
#pragma once

#include "sinew/robot/control.fields.h"
#include "sinew/robot/robot.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"

namespace sinew::robot {

template <class Visitor>
void fields(Visitor& v, Trolley& trolley) {
  v.flag({.name = "present", .doc = "false: the first joint is fixed to the world"},
         trolley.present);
  v.number({.name = "total_mass",
            .unit = "kg",
            .min = 0,
            .doc = "everything that moves along the track, links and foot included"},
           trolley.total_mass);
  v.number({.name = "drag", .unit = "N", .min = 0, .doc = "dry, against the motion"}, trolley.drag);
  v.number({.name = "breakaway",
            .unit = "N",
            .min = 0,
            .optional = true,
            .doc = "dry friction at rest, where it is above the drag"},
           trolley.breakaway);
  v.number({.name = "track_length", .unit = "m", .min = 0, .doc = "from the start to the stop"},
           trolley.track_length);
  v.number({.name = "stop_stiffness", .unit = "N/m", .min = 0, .doc = "of the track's end"},
           trolley.stop_stiffness);
  v.number({.name = "stop_damping", .unit = "N s/m", .min = 0, .doc = "of the track's end"},
           trolley.stop_damping);
  v.number({.name = "payload",
            .unit = "kg",
            .min = 0,
            .optional = true,
            .doc = "rides on the trolley, beside the total mass"},
           trolley.payload);
}

template <class Visitor>
void fields(Visitor& v, Rollers& rollers) {
  const auto at = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "m", .doc = doc}, value);
  };
  v.flag({.name = "present", .doc = "false: no load is reported"}, rollers.present);
  at("front", "ahead of the first joint", rollers.front);
  at("rear", "ahead of the first joint, below 0", rollers.rear);
  at("height", "of the track above the first joint, cylinder extended", rollers.height);
  v.number({.name = "counterweight", .unit = "kg", .min = 0, .doc = "part of the total mass"},
           rollers.counterweight);
  at("counterweight_at", "ahead of the first joint", rollers.counterweight_at);
  at("center_of_mass", "of the trolley without it, ahead of the first joint",
     rollers.center_of_mass);
  at("center_of_mass_up", "the same, above the first joint", rollers.center_of_mass_up);
}

template <class Visitor>
void fields(Visitor& v, Cylinder::Chamber& chamber) {
  const auto bit = units::Field{
      .name = "bit", .min = 0, .max = 15, .optional = true, .doc = "of the output port"};
  v.number({.name = "dead_volume",
            .unit = "m3",
            .min = 0,
            .doc = "of the chamber at its end of the stroke, with its hoses"},
           chamber.dead_volume);
  v.group({.name = "inlet", .optional = true, .doc = "the valve that fills"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, chamber.inlet);
    g.integer(bit, chamber.inlet_bit);
  });
  v.group({.name = "exhaust", .optional = true, .doc = "the valve that empties"}, [&](auto& g) {
    g.text({.name = "valve", .doc = "name in the valves file"}, chamber.exhaust);
    g.integer(bit, chamber.exhaust_bit);
  });
}

// What a position loop and a regulator need.
template <class Visitor>
void mode_fields(Visitor& v, Cylinder& c) {
  const auto share = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "1", .min = 0, .max = 1, .optional = true, .doc = doc}, value);
  };
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 0,
            .optional = true,
            .doc = "regulator: what the chamber `down` is kept at"},
           c.pressure);
  v.number({.name = "position_gain",
            .unit = "1/count",
            .min = 0,
            .optional = true,
            .doc = "valves: of the position loop, B.1"},
           c.position_gain);
  share("up_feedforward", "valves: duty of both valves of `up` at no error, B.1", c.up_feedforward);
  share("down_feedforward", "valves: the same of `down`", c.down_feedforward);
}

template <class Visitor>
void fields(Visitor& v, Cylinder& c) {
  const auto length = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "m", .min = 0, .doc = doc}, value);
  };
  v.flag({.name = "present", .doc = "false: the first joint keeps its height"}, c.present);
  v.choice({.name = "mode", .doc = "locked: at the extended stop"}, c.mode,
           {{"locked", Cylinder::Mode::locked},
            {"regulator", Cylinder::Mode::regulator},
            {"valves", Cylinder::Mode::valves}});
  length("bore", "of the cylinder", c.bore);
  length("rod_diameter", "of its rod, on the side of `up`", c.rod_diameter);
  length("stroke", "upwards from the extended stop", c.stroke);
  v.number({.name = "body_mass",
            .unit = "kg",
            .min = 0,
            .doc = "moves up and down beside links and foot; part of the total mass"},
           c.body_mass);
  v.number({.name = "friction", .unit = "N", .min = 0, .doc = "of piston and bearings, dry"},
           c.friction);
  v.number({.name = "damping", .unit = "N s/m", .min = 0, .doc = "viscous"}, c.damping);
  v.number({.name = "stop_stiffness", .unit = "N/m", .min = 0, .doc = "of the stroke's ends"},
           c.stop_stiffness);
  v.number({.name = "stop_damping", .unit = "N s/m", .min = 0, .doc = "of the stroke's ends"},
           c.stop_damping);
  v.group({.name = "up", .doc = "the chamber that pushes the body up, on the rod's side"},
          [&](auto& g) { fields(g, c.up); });
  v.group({.name = "down", .doc = "the chamber that pushes the body down"},
          [&](auto& g) { fields(g, c.down); });
  mode_fields(v, c);
}

template <class Visitor>
void fields(Visitor& v, Link& link) {
  v.number({.name = "length", .unit = "m", .min = 1e-3, .doc = "joint to joint, or joint to foot"},
           link.length);
  v.number({.name = "mass", .unit = "kg", .min = 0, .doc = "without what is named elsewhere"},
           link.mass);
  v.number({.name = "center_of_mass", .unit = "m", .min = 0, .doc = "from the proximal joint"},
           link.center_of_mass);
  v.number({.name = "inertia", .unit = "kg m2", .min = 0, .doc = "about the centre of mass"},
           link.inertia);
}

template <class Visitor>
void fields(Visitor& v, Foot& foot) {
  v.flag({.name = "present", .doc = "false: nothing ever touches the ground"}, foot.present);
  v.number({.name = "mass", .unit = "kg", .min = 0, .doc = "at the end of the last link"},
           foot.mass);
  v.number({.name = "radius", .unit = "m", .min = 0, .doc = "of a disc about the ankle"},
           foot.radius);
  v.number(
      {.name = "friction", .unit = "1", .min = 0, .max = 10, .doc = "Coulomb, static = sliding"},
      foot.friction);
  v.each({.name = "point", .optional = true, .doc = "discs in place of the one at the link's end"},
         foot.points, [](auto& g, Foot::Point& p) {
           g.number({.name = "along", .unit = "m", .doc = "from the last joint along its link"},
                    p.along);
           g.number({.name = "across", .unit = "m", .doc = "to the left of the link's direction"},
                    p.across);
           g.number({.name = "radius", .unit = "m", .min = 0, .doc = "of the disc"}, p.radius);
         });
}

template <class Visitor>
void fields(Visitor& v, Ground& ground) {
  v.flag({.name = "present", .doc = "false: the leg hangs in the air"}, ground.present);
  v.number({.name = "height",
            .unit = "m",
            .doc = "of the ankle point at contact, below the first joint"},
           ground.height);
  v.number({.name = "normal_stiffness", .unit = "N/m", .min = 0, .doc = "of the contact"},
           ground.normal_stiffness);
  v.number({.name = "normal_damping", .unit = "N s/m", .min = 0, .doc = "of the contact"},
           ground.normal_damping);
}

// What only a joint with muscles has.
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
            .doc = "of a rotary damper beside it, 7.3"},
           joint.damper);
  v.number({.name = "spring", .unit = "N m/rad", .min = 0, .optional = true, .doc = "about it"},
           joint.spring);
  v.number({.name = "spring_angle",
            .unit = "rad",
            .min = 0,
            .max = turn,
            .optional = true,
            .doc = "where the spring pulls nothing"},
           joint.spring_angle);
  if (joint.kind == Joint::Kind::driven) driven_fields(v, joint);
}

// Keys of a cam; `moment_arm` and `cam` in the table that the cord belongs to.
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
void fields(Visitor& v, Hose& hose) {
  v.choice({.name = "law", .optional = true, .doc = "by conductance, or a pipe with friction"},
           hose.law,
           {{"none", Hose::Law::none}, {"iso6358", Hose::Law::iso6358}, {"pipe", Hose::Law::pipe}});
  const auto number = [&](std::string_view name, std::string_view unit, Hose::Law law, double min,
                          double max, std::string_view doc, double& value) {
    const bool needed = hose.law == law;
    v.number({.name = name,
              .unit = unit,
              .min = needed ? min : 0.0,
              .max = max,
              .optional = !needed,
              .doc = doc},
             value);
    if (!needed && value > 0)
      units::complain(v, name, "a key of another law",
                      law == Hose::Law::pipe ? "law = \"pipe\"" : "law = \"iso6358\"");
  };
  using Law = Hose::Law;
  number("sonic_conductance", "m3/(s Pa)", Law::iso6358, 1e-15, 1, "iso6358: C, with its fittings",
         hose.sonic_conductance);
  number("critical_pressure_ratio", "1", Law::iso6358, 0, 0.999, "iso6358: b",
         hose.critical_pressure_ratio);
  number("length", "m", Law::pipe, 1e-6, 1000, "pipe", hose.length);
  number("inner_diameter", "m", Law::pipe, 1e-6, 1, "pipe", hose.inner_diameter);
  v.number({.name = "volume",
            .unit = "m3",
            .min = 0,
            .optional = true,
            .doc = "of its air, as a chamber between valves and muscle; 0: none"},
           hose.volume);
  if (hose.law == Law::none && hose.volume > 0)
    units::complain(v, "volume", "a hose that resists nothing", "a law",
                    "external_volume for air that is one with the muscle's");
}

template <class Visitor>
void fields(Visitor& v, Leak& leak) {
  v.number(
      {.name = "area", .unit = "m2", .min = 0, .optional = true, .doc = "of a hole, effective"},
      leak.area);
  v.number({.name = "conductance",
            .unit = "kg/(s Pa)",
            .min = 0,
            .optional = true,
            .doc = "mass flow per gauge pressure, of a porous wall"},
           leak.conductance);
}

template <class Visitor>
void fields(Visitor& v, Muscle& muscle) {
  v.text({.name = "joint", .doc = "the joint it pulls"}, muscle.joint);
  v.choice({.name = "role", .doc = "which way"}, muscle.role,
           {{"flexor", Muscle::Role::flexor}, {"extensor", Muscle::Role::extensor}});
  v.text({.name = "actuator", .doc = "name in the actuator file"}, muscle.actuator);
  v.integer({.name = "count", .min = 1, .max = 100, .doc = "actuators in parallel"}, muscle.count);
  v.number({.name = "mount_length", .unit = "m", .min = 1e-3, .doc = "at the joint's rest angle"},
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

  const auto bit = units::Field{.name = "bit", .min = 0, .max = 15, .doc = "of the output port"};
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
          [&](auto& g) { fields(g, muscle.hose); });
  v.group({.name = "leak", .optional = true, .doc = "to the room"},
          [&](auto& g) { fields(g, muscle.leak); });
}

template <class Visitor>
void fields(Visitor& v, Converter& converter) {
  v.integer({.name = "bits", .min = 1, .max = 12, .doc = "of a conversion"}, converter.bits);
  v.number({.name = "full_scale", .unit = "V", .min = 1e-3, .doc = "voltage of the top count"},
           converter.full_scale);
}

// What a sensor really does. The unit of `scale` follows its kind.
template <class Visitor>
void real_fields(Visitor& v, Sensor& sensor) {
  if (sensor.kind == Sensor::Kind::angle)
    v.number({.name = "scale", .unit = "rad/V", .doc = "of the potentiometer"}, sensor.scale);
  if (sensor.kind == Sensor::Kind::tension)
    v.number({.name = "scale", .unit = "V/N", .doc = "of the transducer"}, sensor.scale);
  if (sensor.kind == Sensor::Kind::pressure)
    v.number({.name = "scale", .unit = "V/Pa", .doc = "of the transducer"}, sensor.scale);
  if (sensor.kind == Sensor::Kind::velocity)
    v.number({.name = "scale", .unit = "V s/rad", .doc = "of the spindle"}, sensor.scale);
  if (sensor.kind == Sensor::Kind::cylinder)
    v.number({.name = "scale", .unit = "m/V", .doc = "of the potentiometer"}, sensor.scale);
  v.number({.name = "at_rest",
            .unit = "count",
            .min = 0,
            .max = 65535,
            .doc = "at the rest angle, at no tension, or always"},
           sensor.at_rest);
  v.number(
      {.name = "noise", .unit = "count", .min = 0, .optional = true, .doc = "standard deviation"},
      sensor.noise);
}

// What the controller takes it for.
template <class Visitor>
void assumed_fields(Visitor& v, Sensor& sensor) {
  if (sensor.kind == Sensor::Kind::angle)
    v.number({.name = "scale", .unit = "count/rad", .doc = "767 in B.1, 714 by 4.5"},
             sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::tension)
    v.number({.name = "scale", .unit = "V/N", .doc = "one for all transducers in B.1"},
             sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::pressure)
    v.number({.name = "scale", .unit = "V/Pa", .doc = "of the transducer"}, sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::velocity)
    v.number({.name = "scale", .unit = "V s/rad", .doc = "of the spindle"}, sensor.assumed_scale);
  if (sensor.kind == Sensor::Kind::cylinder)
    v.number({.name = "scale", .unit = "count/m", .doc = "of its travel"}, sensor.assumed_scale);
  v.number({.name = "at_rest",
            .unit = "count",
            .min = 0,
            .max = 65535,
            .optional = true,
            .doc = "at the rest angle, at no tension, or always"},
           sensor.assumed_at_rest);
}

template <class Visitor>
void fields(Visitor& v, Sensor& sensor) {
  v.choice({.name = "kind", .doc = "what it measures; fixed: something that does not move"},
           sensor.kind,
           {{"angle", Sensor::Kind::angle},
            {"tension", Sensor::Kind::tension},
            {"fixed", Sensor::Kind::fixed},
            {"pressure", Sensor::Kind::pressure},
            {"velocity", Sensor::Kind::velocity},
            {"cylinder", Sensor::Kind::cylinder}});
  v.text({.name = "of",
          .optional = true,
          .doc = "joint of an angle or velocity, muscle of a tension or pressure"},
         sensor.of);
  v.integer({.name = "channel", .min = 0, .max = 255, .doc = "of the converter board"},
            sensor.channel);
  v.integer({.name = "tick",
             .min = 1,
             .max = 65535,
             .doc = "of the period, when it is read; the conversion starts a tick earlier"},
            sensor.tick);
  v.group({.name = "real", .doc = "what the hardware does"},
          [&](auto& g) { real_fields(g, sensor); });
  v.group({.name = "assumed", .optional = true, .doc = "what the controller believes"},
          [&](auto& g) { assumed_fields(g, sensor); });
}

// What the stiffness law [27] takes the muscles for.
template <class Visitor>
void stiffness_fields(Visitor& v, LowLevel& low) {
  v.number(
      {.name = "stiffness_pole_clamp",
       .unit = "rad",
       .min = -20,
       .max = 0.7,
       .doc = "nearer to the pole of [27] the last stiffness is held; -800 deg: never, as in B.1"},
      low.stiffness_pole_clamp);
  v.number({.name = "assumed_thread_length",
            .unit = "m",
            .min = 0,
            .optional = true,
            .doc = "b in the stiffness law; 0: the actuator's"},
           low.assumed_thread_length);
  v.number({.name = "assumed_mount_length",
            .unit = "m",
            .min = 0,
            .optional = true,
            .doc = "free length in the stiffness law; 0: the muscle's"},
           low.assumed_mount_length);
  v.number(
      {.name = "stiffness_factor",
       .unit = "1",
       .min = 0,
       .optional = true,
       .doc = "tension counts/length counts to lbf in/rad, 5.5 in B.1; 0: from the assumed scales"},
      low.stiffness_factor);
}

template <class Visitor>
void fields(Visitor& v, LowLevel& low) {
  v.integer({.name = "pwm_ticks",
             .min = 2,
             .max = 65535,
             .doc = "of 100 us per period; the duty's resolution follows"},
            low.pwm_ticks);
  v.integer(
      {.name = "output_delay", .min = 1, .max = 100, .doc = "ticks between the law and its edge"},
      low.output_delay);
  v.choice({.name = "duty_rounding", .doc = "U_k and U_theta are short in B.1"}, low.rounding,
           {{"truncate each law", LowLevel::Rounding::truncate_each_law},
            {"truncate sum", LowLevel::Rounding::truncate_sum},
            {"none", LowLevel::Rounding::none}});
  stiffness_fields(v, low);
  v.text({.name = "valve_timing",
          .optional = true,
          .doc = "duty, close, open in ticks (B.4), from files.valve_timing; absent: close at "
                 "duty, open at 100"},
         low.valve_timing);
  v.number({.name = "vent_time",
            .unit = "s",
            .min = 0,
            .optional = true,
            .doc = "exhausts open at the end, then shut"},
           low.vent_time);
  v.number({.name = "dead_band",
            .unit = "1",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "duties below it are 0, B.1's \"some value\"; in whole percents"},
           low.dead_band);
  v.integer({.name = "hold_limit",
             .min = 0,
             .max = 1'000'000,
             .optional = true,
             .doc = "bad readings of a sensor in a row that end the run; 0: any number"},
            low.hold_limit);
  v.number({.name = "interrupt_time",
            .unit = "s",
            .min = 0,
            .optional = true,
            .doc = "of an interrupt with a law in it, 5.2; longer than a hundredth of the period: "
                   "an overrun. 0: not counted"},
           low.interrupt_time);
}

template <class Visitor>
void fields(Visitor& v, Robot& robot) {
  v.text({.name = "robot_name", .doc = "`name` in the file of the robot"}, robot.name);
  v.number({.name = "gravity", .unit = "m/s2", .min = 0, .optional = true, .doc = "downwards"},
           robot.gravity);

  v.group(
      {.name = "trolley", .optional = true, .doc = "what carries the first joint along the track"},
      [&](auto& g) { fields(g, robot.trolley); });
  v.group({.name = "rollers", .optional = true, .doc = "where the trolley's weight rests, 7.2"},
          [&](auto& g) { fields(g, robot.rollers); });
  v.group({.name = "cylinder", .optional = true, .doc = "joint 0, between trolley and body, 4.2"},
          [&](auto& g) { fields(g, robot.cylinder); });
  v.each({.name = "link", .doc = "from the first joint outwards"}, robot.links,
         [](auto& g, Link& link) { fields(g, link); });
  v.group({.name = "foot", .optional = true, .doc = "at the end of the last link"},
          [&](auto& g) { fields(g, robot.foot); });
  v.group({.name = "ground", .optional = true, .doc = "the table"},
          [&](auto& g) { fields(g, robot.ground); });
  v.each({.name = "joint", .doc = "one per link, in the same order"}, robot.joints,
         [](auto& g, Joint& joint) { fields(g, joint); });
  v.each({.name = "muscle", .doc = "a flexor and an extensor per joint"}, robot.muscles,
         [](auto& g, Muscle& muscle) { fields(g, muscle); });

  v.group({.name = "converter", .doc = "analogue to digital"},
          [&](auto& g) { fields(g, robot.converter); });
  v.each({.name = "sensor", .doc = "ascending in tick"}, robot.sensors,
         [](auto& g, Sensor& sensor) { fields(g, sensor); });
  v.group({.name = "low_level", .doc = "timing and rounding of the joint controller"},
          [&](auto& g) { fields(g, robot.low_level); });
  v.group({.name = "thesis", .optional = true, .doc = "true: as the thesis or its code has it"},
          [&](auto& g) {
            g.flag(
                {.name = "knee_lengths_swapped",
                 .optional = true,
                 .doc = "a joint whose flexion lowers its angle takes the wrong lengths into [27]"},
                robot.thesis.knee_lengths_swapped);
          });
}

}  // namespace sinew::robot
