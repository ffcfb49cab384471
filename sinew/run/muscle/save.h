// run/muscle/save.h - a driven muscle as bytes, which go on in another process.
//
// A save is of one version of the library, on one kind of computer, and of one description: another
// muscle's is refused. Any number of restores.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/run/muscle/muscle_setup.h"
#include "sinew/world/driven/driven_muscle.h"

namespace sinew::run {

// Returns everything that the muscle's future depends on.
std::vector<std::byte> save(const air::DrivenMuscle& muscle, const MuscleSetup& setup);

// Goes back, or on, to where it was saved, bit for bit. Throws std::invalid_argument, and changes
// nothing, for what is no save, is cut off or spoilt, or is of another muscle or another version.
void restore(air::DrivenMuscle& muscle, const MuscleSetup& setup, std::span<const std::byte> saved);

}  // namespace sinew::run
