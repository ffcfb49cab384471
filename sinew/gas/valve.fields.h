// gas/valve.fields.h - the keys of [valve.*] in robots/*/valves.toml: name, unit, range, meaning.
//
// See units/field.h for what a visitor has, units/complain.h for keys that do not go together.
#pragma once

#include <vector>

#include "sinew/gas/valve.h"
#include "sinew/units/complain.h"
#include "sinew/units/field.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Flow& flow) {
  v.choice({.name = "law", .doc = "orifice [42]-[44], or ISO 6358"}, flow.law,
           {{"orifice", Flow::Law::orifice}, {"iso6358", Flow::Law::iso6358}});

  const bool orifice = flow.law == Flow::Law::orifice;
  v.number({.name = "area",
            .unit = "m2",
            .min = 0,
            .optional = !orifice,
            .doc = "orifice: A_p C_q lumped, of the open valve [42], [43]"},
           flow.area);
  v.number({.name = "efficiency",
            .unit = "1",
            .min = 0,
            .max = 2,
            .optional = true,
            .doc = "orifice: times the flow, 3.4"},
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
            .doc = "iso6358: b, downstream/upstream at and below which the flow is choked"},
           flow.critical_pressure_ratio);

  if (orifice && flow.sonic_conductance > 0) {
    units::complain(v, "sonic_conductance", "a key of law = \"iso6358\"", "area and efficiency");
  }
  if (!orifice && flow.area > 0) {
    units::complain(v, "area", "a key of law = \"orifice\"",
                    "sonic_conductance and critical_pressure_ratio");
  }
}

// When it opens: delay.h.
template <class Visitor>
void shutter_fields(Visitor& v, Valve& valve) {
  v.choice({.name = "profile", .doc = "how the shutter moves after the electrical edge"},
           valve.profile,
           {{"ideal", Valve::Profile::ideal},
            {"dead time", Valve::Profile::dead_time},
            {"ramp", Valve::Profile::ramp}});
  v.number({.name = "opening_delay",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "from current on until the shutter moves"},
           valve.opening_delay);
  v.number({.name = "closing_delay",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "from current off until the shutter moves"},
           valve.closing_delay);
  v.number({.name = "opening_ramp",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "profile ramp: from shut to open"},
           valve.opening_ramp);
  v.number({.name = "closing_ramp",
            .unit = "s",
            .min = 0,
            .max = 1,
            .optional = true,
            .doc = "profile ramp: from open to shut"},
           valve.closing_ramp);
  if (valve.profile != Valve::Profile::ramp && (valve.opening_ramp > 0 || valve.closing_ramp > 0)) {
    units::complain(v, "profile", "a ramp's time with another profile", "\"ramp\"");
  }
}

template <class Visitor>
void fields(Visitor& v, Valve& valve) {
  v.choice({.name = "kind", .doc = "2-way: open or shut; 3-way: supply or atmosphere"}, valve.kind,
           {{"2-way", Valve::Kind::two_way}, {"3-way", Valve::Kind::three_way}});
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
}

// All of a file's valves.
template <class Visitor>
void fields(Visitor& v, std::vector<Valve>& valves) {
  v.each({.name = "valve", .doc = "valves, by name"}, valves,
         [](auto& g, Valve& valve) { fields(g, valve); });
}

}  // namespace sinew::gas
