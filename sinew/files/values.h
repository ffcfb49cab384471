// files/values.h - every value of a file as it is used, and where it came from.
#pragma once

#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/units/shown.h"

namespace sinew::files {

struct Values {
  config::Node in_si;       // of the whole file
  config::Origins origins;  // of those that were asked for
};

// Reads an experiment, rig, robot, actuator, valves, wiring or mapping file, with settings over it
// ("joint.hip.angle_gain=0.3 %/count"), and chooses the values whose key is among `keys` or begins
// as one of them; no keys are all. Throws config::Error with all that is wrong, and for a key that
// chooses none.
Values values(const std::string& path, const std::vector<std::string>& sets = {},
              const std::vector<std::string>& keys = {});

// Returns a table, a line for each value: as written, in SI or in `shown`, where it stands, its
// source.
std::string text_of(const Values& values, const units::ShownUnits* shown = nullptr);

// Returns an array of JSON, an object for each value.
std::string json_of(const Values& values);

}  // namespace sinew::files
