// identify/pair/pair_file.h - what was found of a pair, for programs and as a part of a robot.
#pragma once

#include <string>

#include "sinew/config/node.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Returns stiffness, sensors and trapped air; SI, with the unit in the key.
Json describe(const PairResult& found);

// Returns `robot` with damping and dry friction of the joint of that name, whose pair it was; of a
// law without one of them that one is not in it. Throws Refusal for a slide, which is no joint.
std::string pair_file(const PairResult& found, const std::string& joint, const std::string& source,
                      config::Node robot);

}  // namespace sinew::identify
