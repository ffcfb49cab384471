// recording/number.h - a cell of a foreign table as a number: decimal commas, parted thousands, the
// many words for a value that is not there.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::recording {

// How a table writes its numbers.
struct NumberStyle {
  char decimal = '.';
  char thousands = '\0';  // '\0': they are not parted; ' ' stands for every kind of blank
};

// Returns the number, or nothing where the text is none. "nan" and "inf" are numbers here.
std::optional<double> number_in(std::string_view text, NumberStyle style = {});

// Does the text stand for a value that is not there? Empty, "-", "NaN", "NA", "#N/A", "OL" and
// such.
bool is_missing(std::string_view text);

// Marks tell what the commas and points of a text can be.
struct Marks {
  bool number = false;     // a number in one style or another
  bool comma = false;      // and its comma can only be the decimal mark
  bool point = false;      // its point can
  bool either = false;     // "1,234": its comma parts thousands, or is the decimal mark
  bool thousands = false;  // and its thousands are parted for certain: "1.234,5", "1 234"
};
Marks marks_in(std::string_view text);

// Says what can be done about a cell that is no number in the table's style; empty where nobody
// knows.
std::string hint_for(std::string_view text, NumberStyle style);

}  // namespace sinew::recording
