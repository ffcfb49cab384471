// config/write/toml_text.h - a text as TOML writes one.
#pragma once

#include <string>
#include <string_view>

namespace sinew::config {

// Returns the text between double quotes. TOML is UTF-8: what of the text is none is replaced.
std::string toml_string(std::string_view text);

}  // namespace sinew::config
