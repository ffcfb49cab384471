// cli/help.h - `sinew help`: commands by purpose, the arguments and options of each command, and
// pages about what all of them share; and what is wrong with a line.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace sinew::cli {

// The text of --help of any command.
class Help final : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override;
};

// Returns how a command is called: "sinew new KIND NAME [OPTIONS]".
std::string usage_of(const CLI::App& command);

// Returns the command that prints the help of `words`: "sinew help identify static".
std::string help_command(const std::string& words);

// Returns the line's words with a last `help` in front: `sinew identify static help` is `sinew help
// identify static`.
std::vector<std::string> with_help_first(std::vector<std::string> words, const CLI::App& program);

// Returns what is wrong with the line that `program` has read and for which CLI11 threw `error`: a
// problem in each line, and after them the command that prints the help.
std::string problems_of_line(const CLI::App& program, const CLI::ParseError& error);

}  // namespace sinew::cli
