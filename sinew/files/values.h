// files/values.h - values of a file as used, and their origins.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/units/shown.h"

namespace sinew::files {

struct Values {
  config::Node in_si;       // values of the whole file
  config::Origins origins;  // origins of the selected values
};

// Reads an experiment, rig, robot, actuator, valves, wiring or mapping file with settings applied
// ("joint.hip.angle_gain=0.3 %/count") and selects the values whose key is among `keys` or begins
// with one of them; an empty `keys` selects all. Throws config::Error with all faults, and for a
// key that selects nothing.
Values values(const std::string& path, const std::vector<std::string>& sets = {},
              const std::vector<std::string>& keys = {});

// Returns a table with a line for each value: as written, in SI or in `shown`, its place, its
// source.
std::string text_of(const Values& values, const units::ShownUnits* shown = nullptr);

// Returns a JSON array with an object for each value.
std::string json_of(const Values& values);

}  // namespace sinew::files
