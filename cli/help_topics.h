// cli/help_topics.h - pages of `sinew help` about what all commands share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::cli {

// Returns the words of the pages, and the same as "units, files or next".
std::vector<std::string> topics_of_help();
std::string names_of_topics();

// Returns a page; empty where there is none of that word.
std::string topic(std::string_view word);

}  // namespace sinew::cli
