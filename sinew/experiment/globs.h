// experiment/globs.h - selection of topics by patterns such as "/joint/*/angle".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/signals/table.h"

namespace sinew::experiment {

// Returns whether the pattern matches the text; * matches any characters, "/" included.
bool matches(std::string_view pattern, std::string_view text);

// Returns the topics, in their order, that a pattern selects: by its own name or as a topic below
// it
// ("/joint/hip"). Throws config::Error for a pattern without a topic; `where` and `key` are the
// list's place.
std::vector<std::string> select(const std::vector<std::string>& patterns,
                                const std::vector<std::string_view>& topics,
                                const config::Location& where, const std::string& key = "");

// Returns the names of all topics, in the table's order.
std::vector<std::string_view> names_of(const signals::Table& table);

}  // namespace sinew::experiment
