// config/field_words.h - what the reader's messages say of a field: its default, what it may hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/units/field.h"

namespace sinew::config {

// A default as it would be written. A number that is none stands for a key without a value of its
// own: "not set".
std::string default_text(double value, std::string_view unit);
std::string joined(const std::vector<double>& values, std::string_view unit);

// Says what a number has to be, with the ends that the field itself has: "m (length), at least 0
// m".
std::string number_text(const units::Field& field);

// Says it for a whole number: "a whole number, 1 to 8".
std::string whole_text(const units::Field& field);

// The words of a choice: `"raises angle" or "lowers angle"`.
std::string words_text(const std::vector<std::string_view>& words);

// "0 m to 1 m: a foot is no longer"; the text alone where there is no reason.
std::string with_reason(std::string text, std::string_view why);

// Returns the range that the value breaks, the field's own or else its unit's; empty if it breaks
// none.
std::string out_of_bounds(const units::Field& field, double value);

}  // namespace sinew::config
