// design/catalogue.h - valves of a file as published: their values with the bounds that the file
// states, and what it marks as not published.
//
//   range = ["0 ms", "4 ms"]                     bounds of the value: a maker's "at most"
//   guess = true, source = "not published …"     on the flow: the flow is unknown; so
//                                                is a guess without a range
//   no opening_delay                             unknown, not 0
#pragma once

#include <string>
#include <vector>

#include "sinew/design/valve.h"

namespace sinew::design {

// Returns the path of the catalogue that ships with Sinew, data/valves.toml. Throws config::Error
// if it is not found.
std::string shipped_catalogue();

// Returns the valves of a valves, robot or experiment file. Throws config::Error if it cannot be
// read.
std::vector<PublishedValve> published_valves(const std::string& path);

}  // namespace sinew::design
