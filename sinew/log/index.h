// log/index.h - turns a finished row of messages into an indexed file, in which a viewer can jump.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sinew/log/steady.h"

namespace sinew::log {

class Output;

using Metadata = std::vector<std::pair<std::string, std::string>>;

// Writes an indexed copy of `row` beside the file, syncs it and renames it over the file, so that
// at any instant one of the two stands there whole. Throws Error; the file then is as it was: also
// where another file has taken the place of `row`. `run`: what was run, in place of what the file
// says of it; empty: that. Of `steady` topics only the first message is kept.
void make_indexed(const Output& row, const std::filesystem::path& file, const Metadata& run = {},
                  const SteadyTopics& steady = {});

}  // namespace sinew::log
