// tune/optimizer/candidate_file.h - a candidate as an experiment of its own, for `sinew run` and
// all other commands.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/tune/optimizer/optimize.h"

namespace sinew::tune {

// Returns the text of an experiment file for the path `file`: the tuning's experiment with the
// candidate's values, their source and the goals reached. Its paths are relative to the folder of
// `file`. Throws config::Error if the tuning's experiment cannot be read.
std::string experiment_of(const Tuning& tuning, const Candidate& candidate,
                          const std::filesystem::path& file);

}  // namespace sinew::tune
