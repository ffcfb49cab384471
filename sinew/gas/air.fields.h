// gas/air.fields.h - the keys of [air] in robots/*/robot.toml: name, unit, range, meaning.
#pragma once

#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Air& air) {
  v.number({.name = "atmosphere",
            .unit = "Pa abs",
            .min = 1e4,
            .max = 2e5,
            .doc = "pressure of the surroundings, P_atm"},
           air.atmosphere);
  v.number({.name = "temperature",
            .unit = "K",
            .min = 200,
            .max = 400,
            .doc = "temperature upstream of every orifice, and of air at rest"},
           air.temperature);
  v.number({.name = "polytropic_exponent",
            .unit = "1",
            .min = 1,
            .max = 1.6667,
            .doc = "n of a chamber [39]: 1 isothermal, 1.4 adiabatic"},
           air.polytropic_exponent);
  v.number({.name = "gas_constant",
            .unit = "J/(kg K)",
            .min = 1,
            .max = 1e4,
            .optional = true,
            .doc = "gas constant R of air [44]"},
           air.gas_constant);
  v.number({.name = "wall_time",
            .unit = "s",
            .min = 0,
            .max = 1e6,
            .optional = true,
            .doc = "time constant of heat exchange with the walls, in place of n; 0: n applies"},
           air.wall_time);
  if (air.wall_time > 0 && air.wall_time < 1e-4)
    units::report_conflict(v, "wall_time", "less than 0.1 ms", "at least that, or 0",
                           "polytropic_exponent = 1 for isothermal air");
}

template <class Visitor>
void fields(Visitor& v, Supply& supply) {
  v.choice({.name = "kind", .doc = "constant: the pressure never falls; tank: it empties"},
           supply.kind, {{"constant", Supply::Kind::constant}, {"tank", Supply::Kind::tank}});
  v.number({.name = "pressure",
            .unit = "Pa abs",
            .min = 1e4,
            .max = 2e6,
            .doc = "pressure upstream of the inlets"},
           supply.pressure);
  const bool tank = supply.kind == Supply::Kind::tank;
  v.number({.name = "volume",
            .unit = "m3",
            .min = tank ? 1e-9 : 0.0,
            .optional = !tank,
            .doc = "tank: volume before the regulator"},
           supply.volume);
  v.number({.name = "initial_pressure",
            .unit = "Pa abs",
            .min = 0,
            .max = 1e8,
            .optional = !tank,
            .doc = "tank: pressure before the run"},
           supply.initial_pressure);
  if (!tank && (supply.volume > 0 || supply.initial_pressure > 0))
    units::report_conflict(v, supply.volume > 0 ? "volume" : "initial_pressure",
                           "a key of kind = \"tank\"", "pressure alone");
}

// Visits the whole table: air and supply.
template <class Visitor>
void fields(Visitor& v, Air& air, Supply& supply) {
  fields(v, air);
  v.group({.name = "supply", .doc = "supply of compressed air"},
          [&](auto& g) { fields(g, supply); });
}

}  // namespace sinew::gas
