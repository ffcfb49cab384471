// report/page/picture.h - a small picture of the machine of a run, to be told by in a list: an SVG
// drawing from the side, as the machine stands when it starts.
#pragma once

#include <string>

#include "sinew/config/node.h"

namespace sinew::report {

// Draws a robot with its links, muscles and feet, or the muscle of a test stand; a curve stands for
// what was not run on a machine of which the file tells. Its colors serve on light and on dark.
std::string picture(const config::Node& resolved);

}  // namespace sinew::report
