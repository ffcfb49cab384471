// robot/robot.fields.h - the keys of robots/*/robot.toml: name, unit, range and meaning of each.
//
// units/field.h describes the visitor. The table [air] belongs to gas; config/compose.h reads the
// tables in the files that `files` names.
#pragma once

#include "sinew/robot/body.fields.h"
#include "sinew/robot/control.fields.h"
#include "sinew/robot/muscle.fields.h"
#include "sinew/robot/robot.h"
#include "sinew/robot/sensor.fields.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::robot {

// Visits the stiffness law's [27] assumptions about the muscles.
template <class Visitor>
void stiffness_fields(Visitor& v, LowLevel& low) {
  v.number(
      {.name = "stiffness_pole_clamp",
       .unit = "rad",
       .min = -20,
       .max = 0.7,
       .doc = "nearer to the pole of [27] the last stiffness is held; -800 deg: never, as in B.1"},
      low.stiffness_pole_clamp);
  constexpr double never = -12;  // [rad]: no muscle gets that far beyond its pole
  if (low.stiffness_pole_clamp < 0 && low.stiffness_pole_clamp > never)
    units::report_conflict(v, "stiffness_pole_clamp", "a distance below 0",
                           "at least 0 deg, or -800 deg for never", "\"10 deg\"");
  v.number({.name = "assumed_thread_length",
            .unit = "m",
            .min = 0,
            .max = 10,
            .least = 1e-4,
            .why = "a braid from a cricket's size to an elephant's",
            .optional = true,
            .doc = "b in the stiffness law; 0: the actuator's"},
           low.assumed_thread_length);
  v.number({.name = "assumed_mount_length",
            .unit = "m",
            .min = 0,
            .max = 10,
            .least = 1e-4,
            .why = "a braid from a cricket's size to an elephant's",
            .optional = true,
            .doc = "free length in the stiffness law; 0: the muscle's"},
           low.assumed_mount_length);
  v.number(
      {.name = "stiffness_factor",
       .unit = "1",
       .min = 0,
       .max = 1e6,
       .least = 1e-6,
       .why = "5.5 for the leg",
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
            .max = 3600,
            .why = "a run does not take hours",
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
  v.number({.name = "command_rate",
            .unit = "rad/s",
            .min = 1e-3,
            .max = 1e6,
            .optional = true,
            .doc = "of a desired angle: a command that is faster is rejected; absent: any"},
           low.command_rate);
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
  v.number({.name = "gravity",
            .unit = "m/s2",
            .min = 0,
            .max = 100,
            .why = "Jupiter has 25 m/s2",
            .optional = true,
            .doc = "downwards"},
           robot.gravity);

  v.group(
      {.name = "trolley", .optional = true, .doc = "what carries the first joint along the track"},
      [&](auto& g) { fields(g, robot.trolley); });
  v.group({.name = "rollers", .optional = true, .doc = "where the trolley's weight rests, 7.2"},
          [&](auto& g) { fields(g, robot.rollers); });
  v.group({.name = "cylinder", .optional = true, .doc = "joint 0, between trolley and body, 4.2"},
          [&](auto& g) { fields(g, robot.cylinder); });
  v.each({.name = "link", .doc = "from the first joint outwards, a parent before its children"},
         robot.links, [](auto& g, Link& link) { fields(g, link); });
  v.each({.name = "leg", .optional = true, .doc = "of a robot with several"}, robot.legs,
         [](auto& g, Leg& leg) { fields(g, leg); });
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
  v.each({.name = "sensor", .doc = "on each board ascending in tick"}, robot.sensors,
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
