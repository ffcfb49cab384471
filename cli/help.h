// cli/help.h - `sinew help`: commands by what one wants to do, each command's words and options,
// and a few pages about what all of them share.
#pragma once

#include <string>

#include "cli/options.h"

namespace sinew::cli {

// Returns what `--help` prints of a command that `words` lead to, "sinew identify static".
std::string help_of(const CommandTree& command, const std::string& words);

// Returns how a command is called: "sinew new KIND NAME [OPTIONS]".
std::string usage_of(const CommandTree& command, const std::string& words);

// Returns how its help is asked for: "sinew help identify static".
std::string help_command(const std::string& words);

// Returns the line's words with `help` before those of a command where it stands behind them:
// `sinew identify static help` asks what `sinew help identify static` does.
std::vector<std::string> with_help_first(std::vector<std::string> words,
                                         const CommandTree& program);

}  // namespace sinew::cli
