// config/spelling.h - units as other people write them: "psig", "Nm", "°C", "mm²", "U/min".
//
// Sinew's own files have one spelling for a unit. Tables of laboratories have many, and most of
// them can mean one thing only; `lb` for a force is none of these, and `bar` does not say against
// what a pressure is measured.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::config {

// A unit of Sinew, and how many of it are one of the other's: "mbar" is 0.001 "bar". A factor comes
// with units that Sinew does not have.
struct Spelling {
  std::string unit;
  double factor = 1;
};

// Returns what the text can mean as a unit, likeliest first: {"psi gauge"} for "psig", {"1/min",
// "rpm"} for "1/min". A text in Sinew's own spelling comes first as it is. Empty: it is no unit
// that is known.
std::vector<Spelling> spellings(std::string_view unit);

// Is the text a unit in Sinew's own spelling, with or without "gauge", "abs" or "diff"?
bool is_unit(std::string_view unit);

}  // namespace sinew::config
