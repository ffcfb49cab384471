// units/shell.h - words of a command for a shell, in messages that name a command.
#pragma once

#include <string>

namespace sinew::units {

// Returns whether a shell reads the word as it is written.
inline bool is_plain_word(const std::string& word) {
  return word.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
             "-_./:=@%+,") == word.npos;
}

// Returns the path as one word of a command, in quotes where necessary, and with "./" where it
// would be taken for an option.
inline std::string shell_word(const std::string& word) {
  if (word.starts_with('-')) return shell_word("./" + word);
  if (!word.empty() && is_plain_word(word)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace sinew::units
