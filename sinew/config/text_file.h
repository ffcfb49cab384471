// config/text_file.h - a file as one text.
#pragma once

#include <string>

namespace sinew::config {

// Throws Error, which says what was expected there, where it cannot be read.
std::string read_text_file(const std::string& path, const std::string& expected);

}  // namespace sinew::config
