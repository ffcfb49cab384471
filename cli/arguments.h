// cli/arguments.h - quantities on the command line: "3.4in", "60 psi gauge", and ranges of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/units/field.h"

namespace sinew::cli {

// Range says how small and how large a quantity may be, in the SI unit that is asked for, and why.
// Both ends belong to it, except a `low` that the quantity must be above.
struct Range {
  double low = -units::unbounded;
  double high = units::unbounded;
  std::string_view why = "";
  bool above = false;
};

constexpr Range above_zero(double high, std::string_view why) { return {0, high, why, true}; }
constexpr Range from_zero(double high, std::string_view why) { return {0, high, why}; }

// Up to here air is the ideal gas of the laws within about 5 %.
inline constexpr double greatest_pressure = 2e7;  // absolute [Pa]
inline constexpr Range air_pressure = above_zero(
    greatest_pressure, "absolute pressures are positive, and above it air is no ideal gas");
Range gauge_air_pressure(double atmosphere);
inline constexpr Range air_volume = from_zero(1000, "room for air in a laboratory");
inline constexpr Range polytropic = {1, 5.0 / 3, "from isothermal to adiabatic"};
inline constexpr Range pulses = above_zero(1e4, "a pulse has at least a tick of 0.1 ms");

// One quantity in SI; throws config::Error that begins with the option's name.
double argument(std::string_view option, std::string_view text, std::string_view unit,
                double atmosphere, const Range& range = {});

// Returns the number that the command line gave; throws config::Error where it is out of range.
double number_argument(std::string_view option, double value, const Range& range);

// "2.5in:3.9in:0.1in", first and last included; or one quantity. A pressure's step is a difference:
// "20 psi gauge:110 psi gauge:10 psi".
struct Values {
  std::vector<double> si;
  std::string display;  // the unit that was written, for columns of a table
};
Values arguments(std::string_view option, std::string_view text, std::string_view unit,
                 double atmosphere, const Range& range = {});

// Returns the unit behind the number of a quantity that was understood: "in" of "3.4 in"; "1" for
// none.
std::string unit_text(std::string_view text);

// "-2 in, -13 in": as many quantities as there are commas and one.
std::vector<double> argument_list(std::string_view option, std::string_view text,
                                  std::string_view unit, const Range& range = {});

}  // namespace sinew::cli
