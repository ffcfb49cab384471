// experiment/globs.h - which topics "/joint/*/angle" means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/signals/table.h"

namespace sinew::experiment {

// * stands for any run of characters, "/" included.
bool matches(std::string_view pattern, std::string_view text);

// True for each topic that a pattern means: itself, or all below it ("/joint/hip"). Throws
// config::Error for a pattern that means none, `where` and `key` being the list's.
std::vector<bool> select(const std::vector<std::string>& patterns,
                         const std::vector<std::string_view>& topics, const config::Location& where,
                         const std::string& key = "");

// Returns the names of all topics, in the table's order.
std::vector<std::string_view> names_of(const signals::Table& table);

}  // namespace sinew::experiment
