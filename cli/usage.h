// cli/usage.h - what is wrong with a line that the program does not understand.
//
// CLI11 stops at the first problem and names types and internal terms. Here the line is examined
// again and every problem is reported: `--untis: found no such option of sinew compare; …`.
#pragma once

#include <string>

#include "cli/command.h"

namespace sinew::cli {

// Returns what is wrong with the line that `program` has read and for which CLI11 threw `error`: a
// problem in each line, and after them the command that prints the help.
std::string problems_of_line(const CLI::App& program, const CLI::ParseError& error);

}  // namespace sinew::cli
