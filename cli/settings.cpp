#include "cli/settings.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace sinew::cli {

namespace {

// Settings that give each name a value, `names.load=NAME`, and what their options are called.
struct Renamed {
  std::string_view setting, option;
};
constexpr Renamed renamed[] = {{"names", "map"}, {"units", "unit"}};

// The settings that messages of the library name. A word that is not here stays a word: "time=0" is
// no option.
constexpr std::string_view settings[] = {
    "actuator", "align",      "bits",   "columns",   "conductance",     "down",
    "exponent", "flexion",    "force",  "frequency", "full_scale",      "drop_incomplete",
    "hold_out", "keep_force", "known",  "largest",   "external_volume", "flexor_length",
    "length",   "lever",      "load",   "machine",   "model",           "moment_arm",
    "names",    "per_volume", "port",   "pressure",  "rest_length",     "root",
    "sensors",  "units",      "volume", "where"};

// Settings that can be the subject of a problem, at the begin of a line.
constexpr std::string_view subjects[] = {"known", "model", "names", "sensors", "units", "where"};

bool is_one_of(std::string_view word, const auto& words) {
  return std::ranges::find(words, word) != std::end(words);
}

bool is_letter_of_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string option_of(std::string_view setting) {
  const auto* other = std::ranges::find(renamed, setting, &Renamed::setting);
  std::string out = "--" + std::string(other == std::end(renamed) ? setting : other->option);
  std::ranges::replace(out, '_', '-');
  return out;
}

// A setting at the begin of `text`, in a line of its own or not, as its option; empty: none is
// there. `taken` is how many letters it stands for.
std::string option_at(std::string_view text, bool begins_line, std::size_t& taken) {
  const std::size_t end =
      static_cast<std::size_t>(std::ranges::find_if_not(text, is_letter_of_a_name) - text.begin());
  const std::string_view name = text.substr(0, end), rest = text.substr(end);
  taken = end;
  if (begins_line && is_one_of(name, subjects) && rest.starts_with(": found "))
    return option_of(name);
  if (!is_one_of(name, settings) || rest.size() < 2) return "";
  const bool named = std::ranges::count(renamed, name, &Renamed::setting) > 0;
  const bool value = rest[0] == '=' && rest[1] != ' ' && rest[1] != '=';
  if (!(named ? rest[0] == '.' && is_letter_of_a_name(rest[1]) : value)) return "";
  taken += 1;
  if (!rest.substr(1).starts_with("true")) return option_of(name) + " ";
  taken += 4;
  return option_of(name);
}

}  // namespace

std::string as_options(std::string_view text) {
  std::string out;
  bool quoted = false, begins_line = true, begins_word = true;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t taken = 0;
    if (begins_word && !quoted) {
      const std::string option = option_at(text.substr(at), begins_line, taken);
      if (!option.empty()) {
        out += option;
        at += taken;
        begins_line = begins_word = false;
        continue;
      }
    }
    const char c = text[at++];
    out += c;
    begins_line = c == '\n';
    quoted = !begins_line && (c == '"' ? !quoted : quoted);
    begins_word = c == ' ' || c == '(' || c == '\n';
  }
  return out;
}

}  // namespace sinew::cli
