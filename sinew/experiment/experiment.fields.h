// experiment/experiment.fields.h - the keys of experiments/*.toml that are the run's own. The
// tables of robot and plan stand in their folders' field tables.
#pragma once

#include <string_view>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/control/gait/plan.fields.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/fault.fields.h"
#include "sinew/experiment/log_table.fields.h"
#include "sinew/experiment/stand.fields.h"
#include "sinew/gas/air.fields.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/robot/robot.fields.h"
#include "sinew/robot/wiring/wiring.fields.h"
#include "sinew/units/field.h"

namespace sinew::experiment {

template <class Visitor>
void fields(Visitor& v, Start& start) {
  v.named_numbers({.name = "joint_angles", .unit = "rad", .doc = "of every joint"},
                  start.joint_angles);
  v.texts({.name = "blocked", .optional = true, .doc = "joints that are held where they start"},
          start.blocked);
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 1e3,
            .max = 2e6,
            .why = "air of a muscle, no vacuum",
            .doc = "of the air in every muscle"},
           start.pressure);
  v.number({.name = "trolley", .unit = "m", .optional = true, .doc = "along the track"},
           start.trolley);
  v.number({.name = "lift",
            .unit = "m",
            .min = 0,
            .optional = true,
            .doc = "of the body, from the cylinder's extended stop"},
           start.lift);
  v.number({.name = "settle",
            .unit = "s",
            .min = 0,
            .optional = true,
            .doc = "exhausts open, before the first phase"},
           start.settle);
}

template <class Visitor>
void fields(Visitor& v, PulseTable& p) {
  constexpr double never = 65535;
  v.numbers({.name = "closing", .unit = "1", .min = 0, .max = never, .doc = "[ticks], by duty"},
            p.closing);
  v.numbers({.name = "opening", .unit = "1", .min = 0, .max = never, .doc = "[ticks], by duty"},
            p.opening);
}

// Machine first: the plan's tables are named after its joints.
template <class Visitor>
void machine_fields(Visitor& v, Experiment& e) {
  if (e.stand) {
    v.each({.name = "actuator", .optional = true, .doc = "actuators, by name"}, e.actuators,
           [](auto& g, actuator::Actuator& a) { actuator::fields(g, a); });
    v.each({.name = "valve", .optional = true, .doc = "valves, by name"}, e.valves,
           [](auto& g, gas::Valve& valve) { gas::fields(g, valve); });
  } else {
    robot::fields(v, e.robot);
    actuator::fields(v, e.actuators);
    gas::fields(v, e.valves);
    robot::fields(v, e.wiring);
  }
  v.group({.name = "air", .doc = "atmosphere and supply"},
          [&](auto& g) { gas::fields(g, e.air, e.supply); });
  if (e.stand) return;
  v.group({.name = "pulses",
           .optional = true,
           .doc = "low_level.valve_timing as numbers, in a resolved file"},
          [&](auto& g) { fields(g, e.pulses); });
}

// What a file of that kind says of the machine.
template <class Visitor>
void machine_fields(Visitor& v, std::string_view kind, Experiment& e) {
  if (kind == "robot" || kind == "experiment") machine_fields(v, e);
  if (kind == "actuator") actuator::fields(v, e.actuators);
  if (kind == "valves") gas::fields(v, e.valves);
  if (kind == "wiring") robot::fields(v, e.wiring);
}

// Visits what is done with a robot: numerics, start and plan.
template <class Visitor>
void robot_run_fields(Visitor& v, Experiment& e) {
  v.group({.name = "plant_steps", .optional = true, .doc = "numerics"}, [&](auto& g) {
    g.number({.name = "body",
              .unit = "s",
              .min = 1e-6,
              .max = 5e-3,
              .optional = true,
              .doc = "between committed nodes"},
             e.body_step);
  });
  v.group({.name = "start", .doc = "where the machine is at time 0"},
          [&](auto& g) { fields(g, e.start); });
  gait::fields(v, e.plan);
}

template <class Visitor>
void run_fields(Visitor& v, Experiment& e) {
  v.text({.name = "title", .doc = "of the experiment"}, e.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures"}, e.reproduces);
  if (!e.stand) v.text({.name = "plant", .optional = true, .doc = "the world: planar"}, e.plant);
  v.integer({.name = "seed", .min = 0, .optional = true, .doc = "of the sensors' noise"}, e.seed);
  if (e.stand)
    fields(v, *e.stand);
  else
    robot_run_fields(v, e);
  v.group({.name = "log", .optional = true, .doc = "what is recorded"}, [&](auto& g) {
    fields(g, e.log);
    if (!e.stand)
      g.flag({.name = "gains", .optional = true, .doc = "those in effect, too"}, e.log.gains);
  });
  v.group({.name = "page", .optional = true, .doc = "how people see the run"},
          [&](auto& g) { config::fields(g, e.page); });
  v.list({.name = "fault", .optional = true, .doc = "what breaks while it runs"}, e.faults,
         [](auto& g, Fault& f) { fields(g, f); });
  v.list({.name = "reported", .optional = true, .doc = "printed beside our figures"}, e.reported,
         [](auto& g, config::Reported& r) {
           config::fields(g, r);
           config::check_class(g, r);
         });
}

}  // namespace sinew::experiment
