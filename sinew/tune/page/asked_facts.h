// tune/page/asked_facts.h - what the text of a study's question (results/asked.h) says of its
// columns and of every run. Until the file says it itself.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sinew/tune/results/asked.h"

namespace sinew::tune {

// Returns the value of a fact, "0.1.0" of `sinew`; empty where there is none.
std::string fact(const Asked& asked, const std::string& name);

// Returns how many facts have that name.
std::size_t count(const Asked& asked, const std::string& name);

// Returns what every run has in place of the experiment's file as it is now, "key=value" each, in
// SI; nothing where the file cannot be read, or is another one altogether.
std::vector<std::string> sets_of(const Asked& asked);

}  // namespace sinew::tune
