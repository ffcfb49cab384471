// recording/conversion.h - conversion of a file's numbers to a quantity in SI.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "sinew/config/quantity.h"

namespace sinew::recording {

// value = slope x number + offset; a pressure may have an offset.
struct Conversion {
  double slope = 1, offset = 0;

  // Convert a number of the file to SI, and a value in SI to a number of the file.
  double operator()(double number) const {
    return slope == 1 && offset == 0 ? number : offset + slope * number;
  }
  double back(double si) const { return (si - offset) / slope; }
};

// Unit of a file's numbers as Sinew reads it.
struct FileUnit {
  Conversion conversion;
  std::string shown;  // in Sinew's spelling; empty: Sinew has no such unit
};

// Returns the unit for a quantity whose SI unit is `wanted`, by the first meaning of the text with
// the quantity's dimension; without such a meaning the advice for a message, which may be empty.
// Gauge pressures refer to `atmosphere` [Pa].
std::variant<FileUnit, std::string> file_unit(const std::string& unit, const std::string& wanted,
                                              double atmosphere);

// Parses a difference that is added to a quantity, "200 mm".
config::Parsed parse_offset(const std::string& text, const std::string& wanted, double atmosphere);

}  // namespace sinew::recording
