// report/page/html.h - text that stands in a page as it was typed.
#pragma once

#include <string>
#include <string_view>

namespace sinew::report {

// For text between tags and in attributes with double quotes.
std::string escaped(std::string_view text);

}  // namespace sinew::report
