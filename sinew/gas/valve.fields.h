// gas/valve.fields.h - the keys of [valve.*] in robots/*/valves.toml: name, unit, range, meaning.
//
// units/field.h describes the visitor, units/report_conflict.h the messages for keys that exclude
// each other.
#pragma once

#include <vector>

#include "sinew/gas/valve.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Flow& flow) {
  v.choice({.name = "law",
            .doc = "orifice: [42]-[44]; appendix-a: the same with its rounded coefficients; "
                   "iso6358: ISO 6358"},
           flow.law,
           {{"orifice", Flow::Law::orifice},
            {"appendix-a", Flow::Law::appendix_a},
            {"iso6358", Flow::Law::iso6358}});

  const bool orifice = flow.law != Flow::Law::iso6358;
  v.number({.name = "area",
            .unit = "m2",
            .min = 0,
            .optional = !orifice,
            .doc = "orifice: effective area A_p C_q of the open valve [42], [43]"},
           flow.area);
  v.number({.name = "efficiency",
            .unit = "1",
            .min = 0,
            .max = 1,
            .why = "a share of the ideal flow",
            .optional = true,
            .doc = "orifice: factor of the flow, thesis 3.4"},
           flow.efficiency);

  v.number({.name = "sonic_conductance",
            .unit = "m3/(s Pa)",
            .min = 0,
            .optional = orifice,
            .doc = "iso6358: C, choked volume flow of reference air per upstream pressure"},
           flow.sonic_conductance);
  v.number({.name = "critical_pressure_ratio",
            .unit = "1",
            .min = 0,
            .max = 0.999,
            .optional = orifice,
            .doc = "iso6358: b, pressure ratio downstream/upstream up to which the flow is choked"},
           flow.critical_pressure_ratio);

  if (orifice && flow.sonic_conductance > 0) {
    units::report_conflict(v, "sonic_conductance", "a key of law = \"iso6358\"",
                           "area and efficiency");
  }
  if (!orifice && flow.area > 0) {
    units::report_conflict(v, "area", "a key of law = \"orifice\" or \"appendix-a\"",
                           "sonic_conductance and critical_pressure_ratio");
  }
}

// Visits the keys of the shutter's motion: delay.h.
template <class Visitor>
void shutter_fields(Visitor& v, Valve& valve) {
  v.choice({.name = "profile",
            .optional = valve.kind == Valve::Kind::regulator,
            .doc = "motion of the shutter after the electrical edge"},
           valve.profile,
           {{"ideal", Valve::Profile::ideal},
            {"dead time", Valve::Profile::dead_time},
            {"ramp", Valve::Profile::ramp}});
  v.number({.name = "opening_delay",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "time from current on to motion of the shutter"},
           valve.opening_delay);
  v.number({.name = "closing_delay",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "time from current off to motion of the shutter"},
           valve.closing_delay);
  v.number({.name = "opening_ramp",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "profile ramp: time from shut to open"},
           valve.opening_ramp);
  v.number({.name = "closing_ramp",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "profile ramp: time from open to shut"},
           valve.closing_ramp);
  if (valve.profile != Valve::Profile::ramp && (valve.opening_ramp > 0 || valve.closing_ramp > 0)) {
    units::report_conflict(v, "profile", "a ramp's time with another profile", "\"ramp\"");
  }
}

template <class Visitor>
void fields(Visitor& v, Circuit& c) {
  units::amount(v, "resistance", "ohm", "R of coil and series resistors", c.resistance);
  units::amount(v, "inductance", "H", "L of the coil", c.inductance);
  units::amount(v, "hold_voltage", "V", "voltage while it is on", c.hold_voltage);
  units::optional_amount(v, "boost_voltage", "V", "speed-up: voltage during the boost",
                         c.boost_voltage);
  units::optional_amount(v, "release_voltage", "V",
                         "voltage against the current after it is switched off", c.release_voltage);
  units::optional_amount(v, "motion_voltage", "V", "back-EMF of the opening shutter",
                         c.motion_voltage);
  units::optional_amount(v, "motion_time", "s",
                         "duration of the opening motion, until the valve is open", c.motion_time);
  if ((c.resistance > 0) != (c.inductance > 0))
    units::report_conflict(v, "resistance", "a resistance or an inductance without the other",
                           "both above zero", R"(resistance = "12 ohm", inductance = "6 mH")");
}

// Visits the keys of a valve's limits and its coil: delay.h, coil_current.h.
template <class Visitor>
void drive_fields(Visitor& v, Valve& valve) {
  const auto seconds = [](auto& g, std::string_view name, std::string_view doc, double& value) {
    g.number({.name = name, .unit = "s", .min = 0, .max = 1, .optional = true, .doc = doc}, value);
  };
  v.choice({.name = "drive", .optional = true, .doc = "drive of the coil's current, thesis 4.3"},
           valve.drive,
           {{"standard", Valve::Drive::standard}, {"speed-up", Valve::Drive::speed_up}});
  v.group({.name = "speed_up", .optional = true, .doc = "delays with drive speed-up"},
          [&](auto& g) {
            seconds(g, "opening_delay", "with speed-up, in place of the standard one",
                    valve.speed_up.opening);
            seconds(g, "closing_delay", "with speed-up, in place of the standard one",
                    valve.speed_up.closing);
          });
  v.group({.name = "coil", .optional = true, .doc = "electrical power"}, [&](auto& g) {
    units::optional_amount(g, "power", "W", "power while it is on, or is held", valve.coil.power);
    units::optional_amount(g, "boost_power", "W", "speed-up: power at the start of a pulse",
                           valve.coil.boost_power);
    seconds(g, "boost_time", "speed-up: longest time with that power", valve.coil.boost_time);
  });
  v.group(
      {.name = "circuit", .optional = true, .doc = "constants that determine the coil's current"},
      [&](auto& g) { fields(g, valve.circuit); });
  if (valve.drive == Valve::Drive::speed_up && valve.profile != Valve::Profile::ideal &&
      !(valve.speed_up.opening > 0 && valve.speed_up.closing > 0))
    units::report_conflict(v, "speed_up", "not both delays of the drive",
                           "what this valve has with it",
                           "speed_up = { opening_delay = \"0.5 ms\", closing_delay = \"0.5 ms\" }");
  if (valve.drive == Valve::Drive::standard && valve.coil.boost_time > 0 &&
      !(valve.speed_up.opening > 0 || valve.speed_up.closing > 0))
    units::report_conflict(v, "coil", "a boost without the drive or the delays of speed-up",
                           "drive = \"speed-up\"");
}

template <class Visitor>
void limit_fields(Visitor& v, Valve& valve) {
  const auto slope = [&](std::string_view name, std::string_view doc, double& value) {
    v.number({.name = name, .unit = "s/Pa", .optional = true, .doc = doc}, value);
  };
  slope("opening_delay_slope", "opening delay per pressure difference over the valve",
        valve.opening_delay_slope);
  slope("closing_delay_slope", "closing delay per pressure difference over the valve",
        valve.closing_delay_slope);
  v.number({.name = "max_frequency",
            .unit = "Hz",
            .min = 0,
            .least = 1e-3,
            .why = "a slower shutter does not move within a run",
            .optional = true,
            .doc = "highest frequency that the shutter follows, thesis 4.3; 0: no limit"},
           valve.max_frequency);
  units::optional_amount(
      v, "fails_above", "Pa diff",
      "pressure difference above which it does not open, thesis 4.3; 0: no limit",
      valve.fails_above);
  v.number({.name = "rated_switchings",
            .unit = "1",
            .min = 0,
            .least = 1,
            .why = "openings are counted",
            .optional = true,
            .doc = "number of openings that the valve is made for; 0: not given"},
           valve.rated_switchings);
}

template <class Visitor>
void regulator_fields(Visitor& v, Valve& valve) {
  Regulator& r = valve.regulator;
  v.group({.name = "regulator", .optional = true, .doc = "for kind regulator"}, [&](auto& g) {
    g.number({.name = "range",
              .unit = "Pa diff",
              .min = 0,
              .max = 2e6,
              .optional = true,
              .doc = "gauge pressure at the full setpoint"},
             r.range);
    g.number({.name = "time_constant",
              .unit = "s",
              .min = 0,
              .max = 10,
              .least = 1e-5,
              .why = "a shorter lag is 0",
              .optional = true,
              .doc = "time constant of the outlet's pressure; 0: no lag"},
             r.time_constant);
  });
  const bool regulates = valve.kind == Valve::Kind::regulator;
  if (regulates && !(r.range > 0))
    units::report_conflict(v, "regulator", "no range", "the gauge pressure at its full set point",
                           "regulator = { range = \"100 psi diff\" }");
  if (!regulates && (r.range > 0 || r.time_constant > 0))
    units::report_conflict(v, "regulator", "another kind of valve", "kind = \"regulator\"");
}

template <class Visitor>
void fields(Visitor& v, Valve& valve) {
  v.choice({.name = "kind",
            .doc = "2-way: open or shut; 3-way: supply or atmosphere; regulator: a set pressure"},
           valve.kind,
           {{"2-way", Valve::Kind::two_way},
            {"3-way", Valve::Kind::three_way},
            {"regulator", Valve::Kind::regulator}});
  v.group({.name = "flow", .doc = "mass flow through the open valve"},
          [&](auto& g) { fields(g, valve.flow); });
  v.number({.name = "linear_below",
            .unit = "1",
            .min = 0,
            .max = 0.1,
            .optional = true,
            .doc = "pressure difference / upstream pressure below which the flow is linear in it"},
           valve.flow.linear_below);
  shutter_fields(v, valve);
  drive_fields(v, valve);
  limit_fields(v, valve);
  regulator_fields(v, valve);
}

// Visits all valves of a file.
template <class Visitor>
void fields(Visitor& v, std::vector<Valve>& valves) {
  v.each({.name = "valve", .doc = "valves, by name"}, valves,
         [](auto& g, Valve& valve) { fields(g, valve); });
}

}  // namespace sinew::gas
