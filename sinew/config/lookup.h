// config/lookup.h - a value of a tree by its key, as origins name it.
#pragma once

#include <string_view>

#include "sinew/config/node.h"

namespace sinew::config {

// Returns the value under "reported[0].accept" or "joint.hip.damping"; nullptr where the tree has
// none.
const Node* value_at(const Node& root, std::string_view path);

}  // namespace sinew::config
