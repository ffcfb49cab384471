// run/muscle/muscle_setup.h - setup of one muscle of a file, with its valves, its hose and its
// supply, for a loop of the caller's own (world/driven/driven_muscle.h).
//
//   const MuscleSetup read = muscle_setup("muscle.toml");            // a rig's element
//   const MuscleSetup read = muscle_setup("robot.toml", "hip_flexor");
//   air::DrivenMuscle pull(read.muscle, read.air, read.supply, read.length, read.pressure);
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"
#include "sinew/world/driven/driven_muscle.h"

namespace sinew::run {

struct MuscleSetup {
  air::Muscle muscle;
  gas::Air air;
  gas::Supply supply;

  // Start of the muscle in the file. Length: a rig's length, a robot's mount length; 0 if the file
  // has none [m]. Absolute pressure of its air [Pa].
  double length = 0, pressure = 0;

  std::string text;         // a complete file, independent of its folder, with every source
  std::uint64_t model = 0;  // a hash of the muscle's name and all values of the file
};

// Reads a muscle of a rig, robot or experiment file, with overriding settings ("element.count=2").
// An empty `name` selects the only muscle. Throws config::Error with all faults.
MuscleSetup muscle_setup(const std::string& path, const std::string& name = "",
                         const std::vector<std::string>& sets = {});

// Returns the setup of a muscle from the text of a setup; the last name of the path is used in
// messages. Throws like muscle_setup().
MuscleSetup muscle_setup_of(const std::string& text, const std::string& path,
                            const std::string& name = "");

// State of a driven muscle as bytes, which another process can continue. It can be restored any
// number of times, by the same version of the library, on the same kind of computer, with the same
// description of the muscle.

// Returns the complete state of the muscle.
std::vector<std::byte> save(const air::DrivenMuscle& muscle, const MuscleSetup& setup);

// Restores a saved state, bit for bit. Throws std::invalid_argument, without changes, if the bytes
// are no saved state, incomplete or corrupted, or belong to another muscle or version.
void restore(air::DrivenMuscle& muscle, const MuscleSetup& setup, std::span<const std::byte> saved);

}  // namespace sinew::run
