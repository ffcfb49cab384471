// identify/motion/dynamic_file.h - damping and dry friction as a parameter file, and for programs.
#pragma once

#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/config/origin.h"
#include "sinew/identify/motion/dynamic.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Returns the text of the actuator's file with the [loss] that was found. `start` are the origins
// of the actuator's values in `start_file`, which stay what they are; `files` were fitted.
std::string loss_file(const config::Origins& start, const std::string& start_file,
                      actuator::Actuator actuator, const DynamicResult& found,
                      const std::vector<std::string>& files);

// Returns what each record says by itself, by two points and by all turning points; SI, with the
// unit in the key.
Json describe(const DynamicResult& found);

}  // namespace sinew::identify
