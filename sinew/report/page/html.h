// report/page/html.h - escaping of text in HTML.
#pragma once

#include <string>
#include <string_view>

namespace sinew::report {

// Escapes text for use between tags and in attributes with double quotes.
std::string escaped(std::string_view text);

}  // namespace sinew::report
