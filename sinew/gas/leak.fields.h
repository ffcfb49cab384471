// gas/leak.fields.h - the keys of a leak: name, unit, range, meaning.
#pragma once

#include "sinew/gas/leak.h"
#include "sinew/units/field.h"

namespace sinew::gas {

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

}  // namespace sinew::gas
