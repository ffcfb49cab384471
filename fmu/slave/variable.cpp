#include "fmu/slave/variable.h"

namespace sinew::fmu {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_identifier(const std::string& word) {
  if (word.empty() || !is_letter(word[0])) return false;
  for (const char c : word)
    if (!is_letter(c) && !is_digit(c)) return false;
  return true;
}

}  // namespace

std::string structured(const std::string& channel) {
  std::string out, word;
  const auto add = [&] {
    if (word.empty()) return;
    if (!out.empty()) out += '.';
    out += is_identifier(word) ? word : "'" + word + "'";
    word.clear();
  };
  for (const char c : channel) {
    if (c == '/' || c == '.')
      add();
    else
      word += c;
  }
  add();
  return out;
}

}  // namespace sinew::fmu
