// report/page/picture.h - the machine of a run in its initial pose, for the picture in a list of
// runs.
#pragma once

#include <string>

#include "sinew/config/node.h"

namespace sinew::report {

// Returns what web/src/run_list.js draws, as JSON: {"scene", "atmosphere", "samples", "data"}, the
// scene with one sample (content.h), null if it has no links; {"stand": true} for a test stand; {}
// if the file does not describe a machine.
std::string picture(const config::Node& resolved);

}  // namespace sinew::report
