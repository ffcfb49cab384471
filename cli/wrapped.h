// cli/wrapped.h - text for people in lines that fit: the terminal's, or 100 letters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sinew::cli {

// A word and what it is, side by side.
struct Row {
  std::string title, words;
};

// Returns rows in two columns, the first of at least `title_width` letters.
std::string table(const std::vector<Row>& rows, std::size_t title_width = 0);

// Returns a paragraph in lines, each with `indent` blanks before it.
std::string wrapped(std::string_view text, std::size_t indent = 0);

}  // namespace sinew::cli
