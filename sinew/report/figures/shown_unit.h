// report/figures/shown_unit.h - the units in which figures show what a log holds in SI: as on the
// page (web/src/units.js), and small lengths and masses in mm and mg.
#pragma once

#include <string>
#include <string_view>

#include "sinew/units/constants.h"

namespace sinew::report {

// In whose units figures show things.
enum class UnitSystem { si, thesis };

// shown = (value + offset) * scale
struct ShownUnit {
  std::string name;  // "psi gauge"; "-" for a plain number
  double scale = 1;
  double offset = 0;  // [SI]

  // Returns the number that is shown for a value of SI.
  double of(double value) const { return (value + offset) * scale; }
};

// `unit` as in a channel's schema, "share" for a share of 1; one that is not known stays what it
// is. Pressures are absolute in SI, gauge in the thesis's units. `largest` is the greatest size of
// what is shown, in SI: of units that differ by a thousand the first one in which it is below 1000.
ShownUnit shown_unit(std::string_view unit, UnitSystem system, double largest,
                     double atmosphere = units::atmosphere);

}  // namespace sinew::report
