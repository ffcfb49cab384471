// report/page/picture.h - a small picture of the machine of a run, for a list: an SVG drawing from
// the side, in the initial pose.
#pragma once

#include <string>

#include "sinew/config/node.h"

namespace sinew::report {

// Draws a robot with its links, muscles and feet, or the muscle of a test stand; a curve if the
// file does not describe a machine. The colors suit light and dark backgrounds.
std::string picture(const config::Node& resolved);

}  // namespace sinew::report
