// experiment/experiment.fields.h - the keys of experiments/*.toml that belong to the run. The
// keys of the tables of robot and plan are in the field tables of their folders.
#pragma once

#include <string_view>

#include "sinew/actuator/actuator.fields.h"
#include "sinew/control/gait/plan.fields.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/fault.h"
#include "sinew/experiment/stand.fields.h"
#include "sinew/gas/air.fields.h"
#include "sinew/gas/valve.fields.h"
#include "sinew/robot/robot.fields.h"
#include "sinew/robot/wiring/wiring.fields.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::experiment {

// Keys of an experiment's list [[fault]].

// Visits the amount, with a unit and range that follow from the fault's kind.
template <class Visitor>
void amount_field(Visitor& v, Fault& fault) {
  const std::string_view unit = unit_of_amount(fault.what);
  if (unit.empty()) return;
  const bool share = unit == "1";
  v.number({.name = "amount",
            .unit = unit,
            .min = share || fault.what == Fault::What::noise ? 0.0 : -4095.0,
            .max = share ? 1.0 : 4095.0,
            .optional = share,
            .doc = "offset, slip: added counts; noise: standard deviation; dropout: share of the "
                   "readings, absent: all"},
           fault.amount);
}

// Visits the size of a leak.
template <class Visitor>
void leak_fields(Visitor& v, Fault& fault) {
  v.number(
      {.name = "area",
       .unit = "m2",
       .min = 0,
       .max = 1e-3,
       .least = 1e-15,
       .why = "no muscle is wider",
       .optional = true,
       .doc =
           "effective area of the hole; ruptured, absent: a tenth of an actuator's cross-section"},
      fault.area);
  if (fault.what == Fault::What::ruptured) return;
  v.number({.name = "conductance",
            .unit = "kg/(s Pa)",
            .min = 0,
            .max = 1e-5,
            .why = "a larger leak is a hole, which has an area",
            .optional = true,
            .doc = "leaking: mass flow per pressure difference, through a seat or a porous wall"},
           fault.conductance);
  units::optional_share(v, "share", "leaking: share of the valve's area that stays open",
                        fault.share);
  if (!(fault.area > 0 || fault.conductance > 0 || fault.share > 0))
    units::report_conflict(v, "area", "no leak",
                           "an area, a conductance, or the share of a valve's area",
                           "area = \"0.1 mm2\"");
}

// Visits the keys of a fault of the air, except its part and its times.
template <class Visitor>
void air_fields(Visitor& v, Fault& fault) {
  using What = Fault::What;
  if (fault.what == What::leaking || fault.what == What::ruptured) leak_fields(v, fault);
  if (fault.what == What::failed)
    v.number({.name = "pressure",
              .unit = "Pa abs",
              .min = 1e3,
              .max = 2e6,
              .why = "air of a line, no vacuum",
              .optional = true,
              .doc = "failed: pressure of the supply's line; absent: the room's"},
             fault.pressure);
}

template <class Visitor>
void fields(Visitor& v, Fault& fault) {
  using What = Fault::What;
  units::amount(v, "at", "s", "time at which it begins", fault.at);
  v.number({.name = "for",
            .unit = "s",
            .min = 1e-4,
            .optional = true,
            .doc = "duration; absent: to the end of the run"},
           fault.lasts);
  v.text({.name = "of", .doc = "a sensor, a valve as in hip_flexor.inlet, a muscle, or supply"},
         fault.of);
  v.choice({.name = "what",
            .doc = "sensor: open (top count), short (0), stuck, offset, slip (stays), noise, "
                   "dropout; valve: stuck open, stuck shut, leaking; muscle: leaking, ruptured, "
                   "blocked (its hose); supply: failed"},
           fault.what,
           {{"open", What::open},
            {"short", What::shorted},
            {"stuck", What::stuck},
            {"offset", What::offset},
            {"slip", What::slip},
            {"noise", What::noise},
            {"dropout", What::dropout},
            {"stuck open", What::stuck_open},
            {"stuck shut", What::stuck_shut},
            {"leaking", What::leaking},
            {"ruptured", What::ruptured},
            {"blocked", What::blocked},
            {"failed", What::failed}});
  amount_field(v, fault);
  air_fields(v, fault);
  if (fault.what == What::slip && fault.lasts > 0)
    units::report_conflict(v, "for", "a slip that ends", "a slip, which stays, or an offset",
                           "what = \"offset\"");
}

// Keys of [log].

template <class Visitor>
void fields(Visitor& v, Log& log) {
  v.flag({.name = "enabled", .optional = true, .doc = "false: only summary.json is written"},
         log.enabled);
  v.texts(
      {.name = "channels", .optional = true, .doc = "recorded topics; * matches any characters"},
      log.channels);
  v.number({.name = "period",
            .unit = "s",
            .min = 1e-4,
            .optional = true,
            .doc = "time between samples, a multiple of 0.1 ms; every valve edge is logged"},
           log.period);
}

template <class Visitor>
void fields(Visitor& v, Start& start) {
  v.named_numbers({.name = "joint_angles", .unit = "rad", .doc = "angle of every joint"},
                  start.joint_angles);
  v.texts({.name = "blocked", .optional = true, .doc = "joints that are held at their start angle"},
          start.blocked);
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 1e3,
            .max = 2e6,
            .why = "air of a muscle, no vacuum",
            .doc = "pressure of the air in every muscle"},
           start.pressure);
  v.number({.name = "trolley", .unit = "m", .optional = true, .doc = "position along the track"},
           start.trolley);
  units::optional_amount(v, "lift", "m", "height of the body above the cylinder's extended stop",
                         start.lift);
  units::optional_amount(v, "settle", "s", "time with open exhausts before the first phase",
                         start.settle);
}

template <class Visitor>
void fields(Visitor& v, PulseTable& p) {
  constexpr double never = 65535;
  v.numbers(
      {.name = "closing", .unit = "1", .min = 0, .max = never, .doc = "closing tick for each duty"},
      p.closing);
  v.numbers(
      {.name = "opening", .unit = "1", .min = 0, .max = never, .doc = "opening tick for each duty"},
      p.opening);
}

// Describes the air of the machine.
template <class Visitor>
void air_of_machine(Visitor& v, Experiment& e) {
  v.group({.name = "air", .doc = "atmosphere and supply"},
          [&](auto& g) { gas::fields(g, e.air, e.supply); });
}

// Describes the pulses of the low level.
template <class Visitor>
void pulses_of_machine(Visitor& v, Experiment& e) {
  v.group({.name = "pulses",
           .optional = true,
           .doc = "low_level.valve_timing as numbers, in a resolved file"},
          [&](auto& g) { fields(g, e.pulses); });
}

// Visits the machine's keys. These come before the plan's, whose tables are named after its joints.
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
  air_of_machine(v, e);
  if (!e.stand) pulses_of_machine(v, e);
}

// Visits the keys of the machine that a file of that kind contains.
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
  v.group({.name = "plant_steps", .optional = true, .doc = "time steps of the simulation"},
          [&](auto& g) {
            g.number({.name = "body",
                      .unit = "s",
                      .min = 1e-6,
                      .max = 5e-3,
                      .optional = true,
                      .doc = "longest time step of the body's motion"},
                     e.body_step);
          });
  v.group({.name = "start", .doc = "state of the machine at time 0"},
          [&](auto& g) { fields(g, e.start); });
  gait::fields(v, e.plan);
}

template <class Visitor>
void run_fields(Visitor& v, Experiment& e) {
  v.text({.name = "title", .doc = "title of the experiment"}, e.title);
  v.text({.name = "reproduces", .optional = true, .doc = "section and figures of the thesis"},
         e.reproduces);
  if (!e.stand)
    v.text({.name = "plant", .optional = true, .doc = "kind of world: planar"}, e.plant);
  v.integer({.name = "seed", .min = 0, .optional = true, .doc = "seed of the sensors' noise"},
            e.seed);
  if (e.stand)
    fields(v, *e.stand);
  else
    robot_run_fields(v, e);
  v.group({.name = "log", .optional = true, .doc = "recorded channels"}, [&](auto& g) {
    fields(g, e.log);
    if (!e.stand)
      g.flag({.name = "gains", .optional = true, .doc = "true: also the gains in effect"},
             e.log.gains);
  });
  v.group({.name = "page", .optional = true, .doc = "display of the run"},
          [&](auto& g) { config::fields(g, e.page); });
  v.list({.name = "fault", .optional = true, .doc = "faults during the run"}, e.faults,
         [](auto& g, Fault& f) { fields(g, f); });
  v.list({.name = "reported", .optional = true, .doc = "published values, printed with the run's"},
         e.reported, [](auto& g, config::Reported& r) {
           config::fields(g, r);
           config::check_class(g, r);
         });
}

}  // namespace sinew::experiment
