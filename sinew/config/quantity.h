// config/quantity.h - "62 psi gauge": a number with its unit, between text and SI.
//
// A field says what it wants in SI: "m", "N m/rad", "1" for a plain number, and for a pressure
// "Pa abs", "Pa gauge" or "Pa diff". Text for a pressure must say the same word; gauge and absolute
// are converted into each other with the atmosphere, a difference stands alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/units/constants.h"

namespace sinew::config {

// The text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

// Why a text is not the wanted quantity; the parts of a Problem that the text decides.
struct Mistake {
  std::string found;
  std::string expected;
  std::string try_this;
};

// A quantity in SI, or why the text is none.
struct Parsed {
  double si = 0;
  std::optional<Mistake> mistake;
};

// `unit` is a field's unit. A bare number is right for "1" only. `before` is the text that stood in
// its place, where there was one: what lacks a unit was likely meant in that one's.
Parsed parse_quantity(std::string_view text, std::string_view unit,
                      double atmosphere = units::atmosphere, std::string_view before = {});

// The same for callers without a file: throws Error, which calls the text `key`.
double quantity(std::string_view text, std::string_view unit, std::string_view key = "",
                double atmosphere = units::atmosphere);

// The mistake of a bare number where a unit is needed: "3.15" for "m". Proposes the unit of
// `before`, or else those usual ones in which such a robot may have the number: "164 mm" for 164.
Mistake missing_unit(std::string_view number, std::string_view unit, std::string_view before = {});

// Units in which people write a quantity of the field's unit, that one included: {"m", "mm", "in"}
// for "m", {"%/count", "1/count"} for "1/count".
std::vector<std::string> usual_units(std::string_view unit);

// Shortest text that reads back to the same double: "0.08001 m", "0.55" for unit "1".
std::string format_quantity(double si, std::string_view unit);

// For people: in another unit of the same dimension, rounded: "3.15 in", "62 psi gauge".
std::string format_quantity(double si, std::string_view unit, std::string_view display,
                            int significant_digits = 6, double atmosphere = units::atmosphere);

// The number alone, in `display`.
double convert(double si, std::string_view unit, std::string_view display,
               double atmosphere = units::atmosphere);

std::string format_number(double value);  // shortest that brings back the same bits

// Unit of the k-th coefficient of a polynomial: ("1", "Pa", 2) -> "1/Pa2", ("m", "m", 2) -> "1/m".
std::string coefficient_unit(std::string_view unit, std::string_view per, int k);

// Unit of a difference between two such quantities: "Pa abs" -> "Pa diff".
std::string_view difference_unit(std::string_view unit);

// "Pa abs" -> "Pa abs (pressure)", "N m/rad" -> "N m/rad (joint stiffness)", "1" -> "a number".
std::string describe_unit(std::string_view unit);
std::string describe_finite(std::string_view unit);  // "a finite number of m (length)"

// Quantities without the digits that reading left behind.
//
//   "0.035 %/count" is 0.00035000000000000005 1/count: the nearest double to 0.035, divided by 100,
//   is not the nearest one to 0.00035. Nobody wrote those digits, yet they are the bits.

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
