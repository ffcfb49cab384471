// config/short_quantity.h - quantities without the digits that reading left behind.
//
//   "0.035 %/count" is 0.00035000000000000005 1/count: the nearest double to 0.035, divided by 100,
//   is not the nearest one to 0.00035. Nobody wrote those digits, yet they are the bits.
#pragma once

#include <string>
#include <string_view>

#include "sinew/config/origin.h"
#include "sinew/units/constants.h"

namespace sinew::config {

// Returns the shortest text that reads back to the same bits: in SI, or where that takes sixteen
// digits or more in one of the units in which people write such a quantity: "0.035 %/count". It
// follows from the bits alone, so equal values have equal texts.
std::string short_quantity(double si, std::string_view unit);

// Returns SI for people, with fifteen digits at most: "0.00035 1/count".
std::string rounded_quantity(double si, std::string_view unit);

// Returns a quantity for a message, in the unit that somebody wrote: of `written`, "80 mm", or
// where that is none of the kind, in `otherwise`. Gauges count from the `room` [Pa].
std::string quantity_like(std::string_view written, double si, std::string_view unit,
                          std::string_view otherwise, double room = units::atmosphere);

// The same, in the unit of the value at that path.
std::string quantity_like(const Origins& origins, std::string_view path, double si,
                          std::string_view unit, std::string_view otherwise,
                          double room = units::atmosphere);

}  // namespace sinew::config
