// live/runs_pages.h - the pages of recorded runs, for a server.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/live/server.h"

namespace sinew::live {

// Returns the folders below `folder` with a log, the newest first.
std::vector<std::filesystem::path> runs_below(const std::filesystem::path& folder);

// Returns what stands at a path: "/" is the page of the first run, "/run/3" of the one with that
// number in the list, "/runs" the list. `machine`: what was run, in place of each resolved.toml;
// may be empty. A run that cannot be read answers with status 500 and the error's words.
Reply answer(std::string_view path, const std::vector<std::filesystem::path>& runs,
             const std::string& machine);

}  // namespace sinew::live
