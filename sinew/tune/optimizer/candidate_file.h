// tune/optimizer/candidate_file.h - a candidate as an experiment of its own, which `sinew run` and
// everybody else takes.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/tune/optimizer/optimize.h"

namespace sinew::tune {

// Returns the text of an experiment that is to stand at `file`: the tuning's own, with the
// candidate's values, their source and what it reached. Paths in it are relative to that place.
// Throws config::Error where the tuning's experiment cannot be read.
std::string experiment_of(const Tuning& tuning, const Candidate& candidate,
                          const std::filesystem::path& file);

}  // namespace sinew::tune
