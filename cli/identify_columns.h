// cli/identify_columns.h - `sinew identify METHOD --columns` and `--template FILE.csv`: what a
// method's table must hold. They are asked before there are data, so that the line needs nothing
// else that the method requires: it becomes one of `sinew identify columns METHOD`.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace sinew::cli {

void add_identify_columns(Command identify, Action& action);

// Returns the words of a line. Where they ask a method of `identify` for its columns, they are
// those of `identify columns`, and what else the line says is left out, as `--help` does. The
// option --columns with a value behind it is another matter: a header.
std::vector<std::string> with_columns_first(std::vector<std::string> words);

}  // namespace sinew::cli
