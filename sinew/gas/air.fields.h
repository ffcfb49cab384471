// gas/air.fields.h - the keys of [air] in robots/*/robot.toml: name, unit, range, meaning.
#pragma once

#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/units/field.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Air& air) {
  v.number(
      {.name = "atmosphere", .unit = "Pa abs", .min = 1e4, .max = 2e5, .doc = "P_atm around it"},
      air.atmosphere);
  v.number({.name = "temperature",
            .unit = "K",
            .min = 200,
            .max = 400,
            .doc = "upstream of every orifice, and of air at rest"},
           air.temperature);
  v.number({.name = "polytropic_exponent",
            .unit = "1",
            .min = 1,
            .max = 1.6667,
            .doc = "n of a chamber: 1 isothermal, 1.4 adiabatic [39]"},
           air.polytropic_exponent);
  v.number({.name = "gas_constant",
            .unit = "J/(kg K)",
            .min = 1,
            .max = 1e4,
            .optional = true,
            .doc = "R of air [44]"},
           air.gas_constant);
}

template <class Visitor>
void fields(Visitor& v, Supply& supply) {
  v.choice({.name = "kind", .doc = "constant: a regulator that never gives way"}, supply.kind,
           {{"constant", Supply::Kind::constant}});
  v.number(
      {.name = "pressure", .unit = "Pa abs", .min = 1e4, .max = 2e6, .doc = "upstream of inlets"},
      supply.pressure);
}

// The whole table: air, and where it comes from.
template <class Visitor>
void fields(Visitor& v, Air& air, Supply& supply) {
  fields(v, air);
  v.group({.name = "supply", .doc = "compressed air"}, [&](auto& g) { fields(g, supply); });
}

}  // namespace sinew::gas
