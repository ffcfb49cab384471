// run/folder/muscle_figures.h - the characteristic of a muscle as figures: tension over length at
// several pressures, by the law of its file.
#pragma once

#include <filesystem>
#include <vector>

#include "sinew/report/figures/figure.h"
#include "sinew/units/shown.h"

namespace sinew::run {

// Returns whether the path names a TOML file, which may hold muscles, and not a run.
bool is_muscle_file(const std::filesystem::path& named);

// Returns a figure for each actuator of the file, of a robot's or of one actuator, from its
// shortest to its greatest length. Throws config::Error for a file without actuators.
std::vector<report::Figure> muscle_figures(const std::filesystem::path& file,
                                           const units::ShownUnits& units);

}  // namespace sinew::run
