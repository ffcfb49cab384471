// tune/sensitivity_text.h - what a sensitivity study says, for people.
#pragma once

#include <string>

#include "sinew/tune/sensitivity_table.h"

namespace sinew::tune {

// Returns the figure's mean and standard deviation in a line, and under it a table with a line for
// each range, of three digits, with intervals; one line where the figure has no answer.
std::string text_of(const Design& design, const Sweep& runs, const FigureSensitivity& figure);

}  // namespace sinew::tune
