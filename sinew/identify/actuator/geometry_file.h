// identify/actuator/geometry_file.h - a braid as an actuator's parameter file, and for programs.
#pragma once

#include <string>

#include "sinew/actuator/braid.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Returns the text of an actuator's file with that braid, its ends guessed as the thesis's: the
// mesh ends where its threads lie straight, and nothing is lost yet. `report` gives the intervals
// of what was fitted; nullptr: it was counted.
std::string braid_file(const actuator::Braid& braid, const std::string& name,
                       const std::string& source, const Report* report = nullptr);

// Returns thread length, turns and shortest length; SI, with the unit in the key.
Json describe(const actuator::Braid& braid);

}  // namespace sinew::identify
