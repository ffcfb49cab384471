// cli/shipped_files.h - files that come with Sinew by the names that help and `sinew list` show:
// "experiments/walk-test-1.toml" is read from any folder.
#pragma once

#include <string>
#include <vector>

namespace sinew::cli {

// Returns the words of a line with such names as paths of Sinew's own files, where the current
// folder has no file of that name. A file that a command writes keeps its name: what follows
// --output, --out or -o, and the words of `new` and `migrate`.
std::vector<std::string> with_shipped_files(std::vector<std::string> words);

}  // namespace sinew::cli
