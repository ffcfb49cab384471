#include "cli/settings.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/design/methods.h"
#include "sinew/identify/task/methods.h"

namespace sinew::cli {

namespace {

// Settings that give each name a value, `names.load=NAME`, and what their options are called.
struct Renamed {
  std::string_view setting, option;
};
constexpr Renamed renamed[] = {
    {"names", "map"}, {"units", "unit"}, {"values", "value"}, {"offsets", "offset"}};

// Names of the settings that have a row, of which their option is made (cli/option_groups.h).
struct Rows : config::RowVisitor<Rows> {
  void row(const config::Setting& row, const auto&) { names.insert(row.name); }
  std::set<std::string_view> names;
};

const std::set<std::string_view>& names_of_rows() {
  static const Rows out = [] {
    Rows rows;
    const auto visit = [&rows](auto settings) { fields(rows, settings); };
    identify::for_each_method(visit);
    visit(identify::TransducerSettings());
    design::for_each_design(visit);
    return rows;
  }();
  return out.names;
}

// Settings of the other commands, which have no row.
constexpr std::string_view further =
    " align align_by candidate channels clock clock_scale columns dates decimal device "
    "drop_incomplete encoding event font foot force fps json label largest names offsets only "
    "output part points predict_dat range rate report root seeds shard shift speed spread_times "
    "start thousands title to units values vary where within ";

// Settings that are no subject of a problem: a file, or a word of the line, may be called so.
constexpr std::string_view no_subjects =
    " actuator columns device extensor file flexor json only root run score ";

// Settings whose names are also keys of units, as in "length=mm", or words of a message, as in
// "name=value": with a value in quotes alone.
constexpr std::string_view quoted_settings = " length name ";

// Settings that can be the subject of a problem behind a file's name, too: no file has such a
// column. A name with a line number is a key of that file.
constexpr std::string_view subjects =
    " candidate freeze known model names offsets part points prior range report rigs sensors "
    "shard tie units values vary where ";

bool is_one_of(std::string_view word, std::string_view words) {
  return words.find(" " + std::string(word) + " ") != words.npos;
}

bool is_setting(std::string_view name) {
  return names_of_rows().contains(name) || is_one_of(name, further);
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

// Returns whether the setting is the subject of a problem that follows this text.
bool is_subject(std::string_view name, std::string_view before) {
  if (before.empty() || before.ends_with('\n'))
    return is_setting(name) && !is_one_of(name, no_subjects);
  return is_one_of(name, subjects) && before.size() > 2 && before.ends_with(": ") &&
         std::isdigit(before[before.size() - 3]) == 0;
}

// Returns the setting that begins at `at` as its option, "" for none; `taken` is its length.
std::string option_at(std::string_view whole, std::size_t at, std::size_t& taken) {
  const std::string_view text = whole.substr(at);
  const std::size_t end =
      static_cast<std::size_t>(std::ranges::find_if_not(text, is_letter_of_a_name) - text.begin());
  const std::string_view name = text.substr(0, end), rest = text.substr(end);
  taken = end;
  if (rest.starts_with(": found ") && is_subject(name, whole.substr(0, at))) return option_of(name);
  if (!is_setting(name) || rest.size() < 2) return "";
  if (is_one_of(name, quoted_settings) && !rest.starts_with("=\"")) return "";
  const bool named = std::ranges::count(renamed, name, &Renamed::setting) > 0;
  const bool value = rest[0] == '=' && rest[1] != ' ' && rest[1] != '=';
  // A channel, or a name in quotes.
  const bool begins_name = is_letter_of_a_name(rest[1]) || rest[1] == '/' || rest[1] == '"';
  if (!(named ? rest[0] == '.' && begins_name : value)) return "";
  taken += 1;
  if (!rest.substr(1).starts_with("true")) return option_of(name) + " ";
  taken += 4;
  return option_of(name);
}

}  // namespace

std::string as_options(std::string_view text) {
  std::string out;
  bool quoted = false, begins_word = true;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t taken = 1;
    std::string option;
    if (begins_word && !quoted) option = option_at(text, at, taken);
    if (option.empty()) {
      const char c = text[at++];
      out += c;
      if (c == '"' || c == '\n') quoted = c == '"' && !quoted;
      begins_word = c == ' ' || c == '(' || c == '\n';
      continue;
    }
    out += option;
    at += taken;
    begins_word = false;
  }
  return out;
}

bool is_of_option(const std::exception& error) {
  const auto* all = dynamic_cast<const config::Error*>(&error);
  // "--width: found …", "rig.csv: --part: found …"; a problem with a line is of that file.
  const auto of_option = [](const config::Problem& problem) {
    std::string text = as_options(config::to_text(problem));
    const std::string file = problem.where.file + ": ";
    if (problem.where.line == 0 && text.starts_with(file + "--")) text.erase(0, file.size());
    return text.starts_with("--") && text.find(':') < text.find(' ');
  };
  return all && std::ranges::all_of(all->problems(), of_option);
}

}  // namespace sinew::cli
