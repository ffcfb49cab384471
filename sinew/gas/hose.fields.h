// gas/hose.fields.h - the keys of a hose: name, unit, range, meaning.
#pragma once

#include "sinew/gas/hose.h"
#include "sinew/units/field.h"
#include "sinew/units/report_conflict.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Hose& hose) {
  v.choice({.name = "law",
            .optional = true,
            .doc = "law of flow: a conductance, or a pipe with friction"},
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
      units::report_conflict(v, name, "a key of another law",
                             law == Hose::Law::pipe ? "law = \"pipe\"" : "law = \"iso6358\"");
  };
  using Law = Hose::Law;
  number("sonic_conductance", "m3/(s Pa)", Law::iso6358, 1e-15, 1,
         "iso6358: conductance C, with fittings", hose.sonic_conductance);
  number("critical_pressure_ratio", "1", Law::iso6358, 0, 0.999, "iso6358: b",
         hose.critical_pressure_ratio);
  number("length", "m", Law::pipe, 1e-6, 1000, "pipe: length", hose.length);
  number("inner_diameter", "m", Law::pipe, 1e-6, 1, "pipe: inner diameter", hose.inner_diameter);
  v.number({.name = "volume",
            .unit = "m3",
            .min = 0,
            .least = 1e-12,
            .why = "a chamber holds air",
            .optional = true,
            .doc = "air volume as a chamber between valves and muscle; 0: no chamber"},
           hose.volume);
  if (hose.law == Law::none && hose.volume > 0)
    units::report_conflict(v, "volume", "a hose that resists nothing", "a law",
                           "external_volume for air that is one with the muscle's");
}

}  // namespace sinew::gas
