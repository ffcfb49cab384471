// tune/page/asked_facts.h - what the text of a study's question (results/asked.h) says of its
// columns and of every run.
#pragma once

#include <cstddef>
#include <string>

#include "sinew/tune/results/asked.h"

namespace sinew::tune {

// Returns the value of a fact, "0.1.0" of `sinew`; empty where there is none.
std::string fact(const Asked& asked, const std::string& name);

// Returns how many facts have that name.
std::size_t count(const Asked& asked, const std::string& name);

}  // namespace sinew::tune
