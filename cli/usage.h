// cli/usage.h - a line that the program does not understand, and in which words it says so.
//
// CLI11 stops at the first thing that is wrong and speaks of its own terms. Here the line is looked
// at once more, and every problem told: `--untis: found no such option of sinew compare; …`.
#pragma once

#include <string>

#include "cli/options.h"

namespace CLI {
class ParseError;
}

namespace sinew::cli {

// Returns what is wrong with the line that `program` has read and for which CLI11 threw `error`:
// one problem a line, and behind them where to read on.
std::string problems_of_line(const CLI::App& program, const CLI::ParseError& error);

// Returns the words that lead to a command, "sinew identify static".
std::string words_to(const CLI::App& command);

// Returns a command as it was described, with those below it, and an option of any command.
CommandTree tree_of(const CLI::App& command);
CommandTree::Shape shape_of(const CLI::Option& option);

}  // namespace sinew::cli
