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
  v.number({.name = "stiffness_pole_clamp",
            .unit = "rad",
            .min = -20,
            .max = 0.7,
            .doc = "angle from the pole of [27] within which the last stiffness is kept; -800 deg: "
                   "never, as in B.1"},
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
            .why = "no braid is shorter or longer",
            .optional = true,
            .doc = "thread length b that the stiffness law assumes; 0: the actuator's"},
           low.assumed_thread_length);
  v.number({.name = "assumed_mount_length",
            .unit = "m",
            .min = 0,
            .max = 10,
            .least = 1e-4,
            .why = "no braid is shorter or longer",
            .optional = true,
            .doc = "free length that the stiffness law assumes; 0: the muscle's mount_length"},
           low.assumed_mount_length);
  v.number({.name = "stiffness_factor",
            .unit = "1",
            .min = 0,
            .max = 1e6,
            .least = 1e-6,
            .why = "5.5 for the leg",
            .optional = true,
            .doc = "factor from tension counts per length count to lbf in/rad, 5.5 in B.1; 0: from "
                   "the scales"},
           low.stiffness_factor);
}

template <class Visitor>
void fields(Visitor& v, LowLevel& low) {
  v.integer({.name = "pwm_ticks",
             .min = 2,
             .max = 65535,
             .doc = "ticks of 100 us per pulse period; one tick is the smallest step of the duty"},
            low.pwm_ticks);
  v.integer({.name = "output_delay",
             .min = 1,
             .max = 100,
             .doc = "ticks from a law's result to the edge of its valve"},
            low.output_delay);
  v.choice({.name = "duty_rounding",
            .doc = "duties that are truncated to whole percents; B.1 truncates each law's"},
           low.rounding,
           {{"truncate each law", LowLevel::Rounding::truncate_each_law},
            {"truncate sum", LowLevel::Rounding::truncate_sum},
            {"none", LowLevel::Rounding::none}});
  stiffness_fields(v, low);
  v.text({.name = "valve_timing",
          .optional = true,
          .doc = "closing and opening tick for each duty (B.4), from files.valve_timing; absent: "
                 "closes at the duty, opens at 100"},
         low.valve_timing);
  v.number({.name = "vent_time",
            .unit = "s",
            .min = 0,
            .max = 3600,
            .why = "a run does not take hours",
            .optional = true,
            .doc = "time with open exhausts at the end, before all valves shut"},
           low.vent_time);
  units::optional_share(
      v, "dead_band",
      "duty below which a valve stays shut (B.1: \"some value\"), in whole percents",
      low.dead_band);
  v.integer({.name = "hold_limit",
             .min = 0,
             .max = 1'000'000,
             .optional = true,
             .doc = "consecutive bad readings of one sensor that end the run; 0: no limit"},
            low.hold_limit);
  v.number(
      {.name = "command_rate",
       .unit = "rad/s",
       .min = 1e-3,
       .max = 1e6,
       .optional = true,
       .doc = "largest rate of a desired angle; a faster command is rejected; absent: no limit"},
      low.command_rate);
  units::optional_amount(
      v, "interrupt_time", "s",
      "duration of an interrupt with a law, thesis 5.2; above 1 % of the period: an "
      "overrun; 0: unknown",
      low.interrupt_time);
}

template <class Visitor>
void fields(Visitor& v, Robot& robot) {
  v.text(
      {.name = "robot_name", .doc = "name of the robot; in the robot's own file the key is `name`"},
      robot.name);
  v.number({.name = "gravity",
            .unit = "m/s2",
            .min = 0,
            .max = 100,
            .why = "Jupiter has 25 m/s2",
            .optional = true,
            .doc = "acceleration of gravity, downwards"},
           robot.gravity);

  v.group({.name = "trolley",
           .optional = true,
           .doc = "trolley that carries the first joint along the track"},
          [&](auto& g) { fields(g, robot.trolley); });
  v.group({.name = "rollers",
           .optional = true,
           .doc = "rollers that carry the trolley's weight, thesis 7.2"},
          [&](auto& g) { fields(g, robot.rollers); });
  v.group({.name = "cylinder",
           .optional = true,
           .doc = "air cylinder that moves the first joint up and down, thesis 4.2"},
          [&](auto& g) { fields(g, robot.cylinder); });
  v.each(
      {.name = "link", .doc = "links from the first joint outwards, a parent before its children"},
      robot.links, [](auto& g, Link& link) { fields(g, link); });
  v.each({.name = "leg", .optional = true, .doc = "legs of a robot with several"}, robot.legs,
         [](auto& g, Leg& leg) { fields(g, leg); });
  v.group({.name = "foot", .optional = true, .doc = "foot at the end of the last link"},
          [&](auto& g) { fields(g, robot.foot); });
  v.group({.name = "ground", .optional = true, .doc = "level ground below the foot"},
          [&](auto& g) { fields(g, robot.ground); });
  v.each({.name = "joint", .doc = "joints, one per link, in the same order"}, robot.joints,
         [](auto& g, Joint& joint) { fields(g, joint); });
  v.each({.name = "muscle",
          .doc = "muscles: a flexor and an extensor per driven joint, or one of them against "
                 "a spring or the weight"},
         robot.muscles, [](auto& g, Muscle& muscle) { fields(g, muscle); });

  v.group({.name = "converter", .doc = "analogue-to-digital converter of each board"},
          [&](auto& g) { fields(g, robot.converter); });
  v.each({.name = "sensor", .doc = "sensors, on each board in ascending order of tick"},
         robot.sensors, [](auto& g, Sensor& sensor) { fields(g, sensor); });
  v.group({.name = "low_level", .doc = "timing and rounding of the joint controller"},
          [&](auto& g) { fields(g, robot.low_level); });
  v.group({.name = "thesis",
           .optional = true,
           .doc = "peculiarities of the thesis and its code; true: reproduced"},
          [&](auto& g) {
            g.flag({.name = "knee_lengths_swapped",
                    .optional = true,
                    .doc = "true: joints whose flexion lowers the angle use wrong lengths in [27], "
                           "as in B.1"},
                   robot.thesis.knee_lengths_swapped);
          });
}

}  // namespace sinew::robot
