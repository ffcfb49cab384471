// units/letters.h - blanks, small letters, quotes and typing errors of a text.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::units {

// Returns the text without blanks and tabs at its ends.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Returns the text with the capitals of ASCII as small letters.
inline std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// Returns the text with each word between the separators replaced by `replacement(word)`.
template <class Replacement>
std::string with_words(std::string_view text, std::string_view separators,
                       const Replacement& replacement) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    out += replacement(text.substr(at, end - at));
    out += text.substr(end, 1);
    at = end + 1;
  }
  return out;
}

// Returns the text in double quotes, shortened if it is too long for a message.
std::string in_quotes(std::string_view text);

// Returns the candidate most similar to `word`; empty if no candidate is close enough for a typing
// error.
std::string_view closest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace sinew::units
