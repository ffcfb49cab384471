// files/new_muscle.h - a muscle that somebody has measured, put into the text of a new robot.
#pragma once

#include <string>

namespace sinew::files {

// Returns the text of the robot's template with the first actuator of `file` for its muscles, and
// with what follows from it: both ends are mounted half way between the lengths that it was
// measured at, the moment arm lets 20 deg take half of that way, load cell and supply reach as far
// as its force and its pressures. `reference` is how the new robot calls the file, between quotes;
// numbers are in mm, N, bar where `metric`, else in in, lbf, psi. Throws config::Error where the
// file is no actuator's.
std::string with_muscle(std::string text, const std::string& file, const std::string& reference,
                        bool metric);

}  // namespace sinew::files
