// config/setting.h - quantity that is set by its name: "60 psi gauge" for the setting `pressure`,
// within the range of such a quantity.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/origin.h"
#include "sinew/units/constants.h"
#include "sinew/units/field.h"

namespace sinew::config {

// Range of a quantity in the requested SI unit, with its reason. Both ends are included, except
// `low` if `above` is set.
struct Range {
  double low = -units::unbounded;
  double high = units::unbounded;
  std::string_view why = "";
  bool above = false;
};

// Return a range up to `high` without and with zero; `why` is the reason for the bound.
constexpr Range above_zero(double high, std::string_view why) { return {0, high, why, true}; }
constexpr Range from_zero(double high, std::string_view why) { return {0, high, why}; }

// Up to this pressure air is an ideal gas within about 5 %.
inline constexpr double greatest_pressure = 2e7;  // absolute [Pa]
inline constexpr Range air_pressure = above_zero(
    greatest_pressure, "absolute pressures are positive, and above it air is no ideal gas");
constexpr Range gauge_air_pressure(double atmosphere) {
  return {-atmosphere, greatest_pressure - atmosphere, air_pressure.why, true};
}
inline constexpr Range air_volume = from_zero(1000, "room for air in a laboratory");
inline constexpr Range polytropic = {1, 5.0 / 3, "from isothermal to adiabatic"};
inline constexpr Range pulses = above_zero(1e4, "a pulse has at least a tick of 0.1 ms");

// Returns a quantity without a file in SI. Throws Error, in which the text is called `key`.
double quantity(std::string_view text, std::string_view unit, std::string_view key = "",
                double atmosphere = units::atmosphere);

// Returns a quantity for a message, in the unit of the value at that path, or in `otherwise` if it
// is a default. Gauge pressures refer to `room` [Pa].
std::string quantity_like(const Origins& origins, std::string_view path, double si,
                          std::string_view unit, std::string_view otherwise,
                          double room = units::atmosphere);

// Returns the quantity in SI; gauge pressures refer to `atmosphere` [Pa]. Throws Error that begins
// with the setting's name.
double quantity_setting(std::string_view name, std::string_view text, std::string_view unit,
                        double atmosphere = units::atmosphere, const Range& range = {});

// Quantities of "2.5in:3.9in:0.1in", first and last included, or of one quantity.
struct QuantityRange {
  std::vector<double> si;
  std::string unit;  // unit as written, for a column of a table
};

// Returns the quantities of a range. The step of pressures is a difference: "20 psi gauge:110 psi
// gauge:10 psi". Throws Error as above.
QuantityRange range_setting(std::string_view name, std::string_view text, std::string_view unit,
                            double atmosphere = units::atmosphere, const Range& range = {});

// Returns the quantities of "-2 in, -13 in". Throws Error as above.
std::vector<double> list_setting(std::string_view name, std::string_view text,
                                 std::string_view unit, const Range& range = {});

// Throws Error that begins with the setting's name.
[[noreturn]] void refuse_setting(std::string_view name, const std::string& found,
                                 const std::string& expected, const std::string& try_this = "");

// Returns the number; throws Error like quantity_setting() if it is out of range.
double number_setting(std::string_view name, double value, const Range& range);

// Splits a text at its commas, without the blanks after them: "6 lb, 11 lb".
std::vector<std::string> at_commas(const std::string& text);

}  // namespace sinew::config
