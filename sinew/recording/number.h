// recording/number.h - parsing of a table cell as a number: decimal commas, thousands separators,
// and words for a missing value.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::recording {

// Number format of a table.
struct NumberStyle {
  char decimal = '.';
  char thousands = '\0';  // '\0': no separator; ' ': any kind of blank
};

// Returns the number, or nothing if the text is not a number. "nan" and "inf" are numbers here.
std::optional<double> number_in(std::string_view text, NumberStyle style = {});

// Returns whether the text means a missing value: empty, "-", "NaN", "NA", "#N/A", "OL" and
// similar.
bool is_missing(std::string_view text);

// Possible meanings of the commas and points of a text.
struct SeparatorEvidence {
  bool number = false;     // a number in some format
  bool comma = false;      // the comma can only be the decimal mark
  bool point = false;      // the point can only be the decimal mark
  bool either = false;     // "1,234": its comma is a thousands separator or the decimal mark
  bool thousands = false;  // certainly with thousands separators: "1.234,5", "1 234"
};
SeparatorEvidence separator_evidence_in(std::string_view text);

// Returns advice for a cell that is not a number in the table's format; empty if no advice is
// known.
std::string hint_for(std::string_view text, NumberStyle style);

}  // namespace sinew::recording
