// units/spelling.h - common spellings of units: "psig", "Nm", "°C", "mm²", "U/min".
//
// Sinew's own files have one spelling per unit. Tables from laboratories have many, most of them
// unambiguous; `lb` for a force is ambiguous, and `bar` lacks the reference of a pressure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::units {

// Unit of Sinew, and its number in one of the other unit: "mbar" is 0.001 "bar". The factor
// differs from 1 for units that Sinew does not have.
struct Spelling {
  std::string unit;
  double factor = 1;
};

// Returns the possible meanings of the text, likeliest first: {"psi gauge"} for "psig", {"1/min",
// "rpm"} for "1/min". A text in Sinew's own spelling is the first. Empty: unknown unit.
std::vector<Spelling> spellings(std::string_view unit);

// Returns whether the text is a unit in Sinew's spelling, with or without "gauge", "abs" or "diff".
bool is_unit(std::string_view unit);

}  // namespace sinew::units
