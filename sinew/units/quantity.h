// units/quantity.h - conversion of quantities, "62 psi gauge", between text and SI.
//
// A field's unit is in SI: "m", "N m/rad", "1" for a plain number, and for a pressure "Pa abs", "Pa
// gauge" or "Pa diff". A pressure's text must have a reference as well; gauge and absolute
// pressures are converted into each other with the atmosphere, a difference is not.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "sinew/units/constants.h"
#include "sinew/units/mistake.h"

namespace sinew::units {

// Quantity in SI, or the reason why the text is not a quantity.
struct Parsed {
  double si = 0;
  std::optional<Mistake> mistake;
};

// Parses a quantity in a field's unit. A number without a unit is valid only for "1". Gauge
// pressures refer to `room` [Pa]. `before` is the text that was replaced, if any: its unit is
// suggested if the new text lacks one.
Parsed parse_quantity(std::string_view text, std::string_view unit, double room = atmosphere,
                      std::string_view before = {});

// Returns the mistake of a number without a unit: "3.15" for "m". Suggests the unit of `before`, or
// else the usual units in which the number is plausible for a robot: "164 mm" for 164.
Mistake missing_unit(std::string_view number, std::string_view unit, std::string_view before = {});

// Number at the beginning of a text, and the unit after it as it is written.
struct NumberAndUnit {
  double number = 0;
  std::string_view unit;
  std::errc error{};  // without a number, or one in the range of double: the others are empty
};

// Splits "0.004 1/count" after its number, which may have a sign.
NumberAndUnit split_number(std::string_view text);

// Returns the unit that a valid quantity was written with: "in" of "3.4 in"; "1" for none.
std::string written_unit(std::string_view text);

// Returns the usual units of a quantity, including the field's own: {"m", "mm", "in"} for "m",
// {"%/count", "1/count"} for "1/count".
std::vector<std::string> usual_units(std::string_view unit);

// Returns the shortest text that reads back to the same double: "0.08001 m", "0.55" for unit "1".
std::string format_quantity(double si, std::string_view unit);

// Formats a quantity rounded, in another unit of the same dimension: "3.15 in", "62 psi gauge".
std::string format_quantity(double si, std::string_view unit, std::string_view display,
                            int significant_digits = 6, double room = atmosphere);

// Returns "0 m to 1 m", "at least 0 m" or "at most 1 m"; empty if neither end is finite.
std::string range_text(double low, double high, std::string_view unit);

// Returns the number in the unit `display`.
double convert(double si, std::string_view unit, std::string_view display,
               double room = atmosphere);

std::string format_number(double value);              // shortest with the same bits
std::string format_number(double value, int digits);  // rounded to so many significant digits
double with_digits(double value, int digits);         // rounded so; infinity and NaN unchanged

// Returns the unit of a polynomial's coefficient k: ("1", "Pa", 2) -> "1/Pa2", ("m", "m", 2) ->
// "1/m".
std::string coefficient_unit(std::string_view unit, std::string_view per, int k);

// Returns the unit of a difference of two such quantities: "Pa abs" -> "Pa diff".
std::string_view difference_unit(std::string_view unit);

// Returns the unit with its dimension: "Pa abs" -> "Pa abs (pressure)", "N m/rad" -> "N m/rad
// (joint stiffness)", "1" -> "a number".
std::string describe_unit(std::string_view unit);
std::string describe_finite(std::string_view unit);  // "a finite number of m (length)"

// Quantities without digits that are caused by conversion.
//
//   "0.035 %/count" is 0.00035000000000000005 1/count: the nearest double to 0.035, divided by 100,
//   is not the nearest one to 0.00035. These digits were never written, but the bits have them.

// Returns the shortest text that reads back to the same bits: in SI or, if that takes sixteen
// digits or more, in a usual unit of such a quantity: "0.035 %/count". It depends only on the bits,
// so equal values have equal texts.
std::string short_quantity(double si, std::string_view unit);

// Returns the quantity in SI for display, with at most fifteen digits: "0.00035 1/count".
std::string rounded_quantity(double si, std::string_view unit);

// Returns a quantity for a message, in the unit of the text `written`, "80 mm", or in `otherwise`
// if that is a unit of another kind. Gauge pressures refer to `room` [Pa].
std::string quantity_like(std::string_view written, double si, std::string_view unit,
                          std::string_view otherwise, double room = atmosphere);

}  // namespace sinew::units
