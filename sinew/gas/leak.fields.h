// gas/leak.fields.h - the keys of a leak: name, unit, range, meaning.
#pragma once

#include "sinew/gas/leak.h"
#include "sinew/units/field.h"

namespace sinew::gas {

template <class Visitor>
void fields(Visitor& v, Leak& leak) {
  units::optional_amount(v, "area", "m2", "effective area of a hole", leak.area);
  units::optional_amount(v, "conductance", "kg/(s Pa)",
                         "mass flow per gauge pressure through a porous wall", leak.conductance);
}

}  // namespace sinew::gas
