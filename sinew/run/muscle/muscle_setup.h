// run/muscle/muscle_setup.h - one muscle of a file, with its valves, its hose and what feeds it,
// for a loop of the caller's own (world/driven/driven_muscle.h).
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

  // Where the file has it at its start: a rig's length, a robot's mount length; 0 where it does not
  // say [m]. Pressure of its air there, absolute [Pa].
  double length = 0, pressure = 0;

  std::string text;         // a file that is complete in every folder, with every source
  std::uint64_t model = 0;  // a hash of the muscle's name and all values of the file
};

// Reads a muscle of a rig, robot or experiment file, with settings over it ("element.count=2"). An
// empty `name` is the only muscle there is. Throws config::Error with all that is wrong.
MuscleSetup muscle_setup(const std::string& path, const std::string& name = "",
                         const std::vector<std::string>& sets = {});

// Returns the setup of a muscle by a setup's text; the path's last name is for messages. Throws as
// above.
MuscleSetup muscle_setup_of(const std::string& text, const std::string& path,
                            const std::string& name = "");

// A driven muscle as bytes, which go on in another process.
//
// A save is of one version of the library, on one kind of computer, and of one description: another
// muscle's is refused. Any number of restores.

// Returns everything that the muscle's future depends on.
std::vector<std::byte> save(const air::DrivenMuscle& muscle, const MuscleSetup& setup);

// Goes back, or on, to where it was saved, bit for bit. Throws std::invalid_argument, and changes
// nothing, for what is no save, is cut off or spoilt, or is of another muscle or another version.
void restore(air::DrivenMuscle& muscle, const MuscleSetup& setup, std::span<const std::byte> saved);

}  // namespace sinew::run
