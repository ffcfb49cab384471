// config/text_file.h - reading of a whole file as text.
#pragma once

#include <string>

namespace sinew::config {

// Returns the content. Throws Error with `expected`, the kind of file, if it cannot be read.
std::string read_text_file(const std::string& path, const std::string& expected);

}  // namespace sinew::config
