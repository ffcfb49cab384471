// analysis/absent.h - keys of a summary that no run of a machine has, found by the names in them.
#pragma once

#include <optional>
#include <string_view>

#include "sinew/analysis/record/machine.h"
#include "sinew/units/mistake.h"

namespace sinew::analysis {

// Returns why no run of the machine has a figure of this key: the machine lacks its joint, muscle,
// sensor, phase or leg, or it is a figure of one leg without the leg's name, or the passiveness of
// muscles with regulators. Returns nothing for other keys; whether a run has them is known after
// it.
std::optional<units::Mistake> absent(std::string_view key, const Machine& machine);

}  // namespace sinew::analysis
