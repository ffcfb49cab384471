#include "cli/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "sinew/config/diagnostics.h"
#include "sinew/units/letters.h"

namespace sinew::cli {

namespace {

// CLI11 has no place for the words of one_of(): they are in the description of its check, each
// after this letter, which no word contains. Words may contain commas and blanks.
constexpr char before_choice = '\x1f';

// Returns a complaint in the form that all messages have; the option's name is put before it.
std::string complaint(const std::string& found, const std::string& expected,
                      const std::string& try_this = "") {
  return units::to_text({found, expected, try_this});
}

// Reads a number of which nothing is left over; a plus may precede it.
template <class Number>
bool is_number(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && at == text.data() + text.size();
}

// Writes the number back as CLI11 reads it: "010" would be 8 there.
std::string no_whole_number(std::string& text, long long first, long long last,
                            const std::string& expected) {
  long long value = 0;
  if (!is_number(text, value) || value < first || value > last)
    return complaint(config::in_quotes(text), expected);
  text = std::to_string(value);
  return "";
}

std::string no_number(std::string& text) {
  double value = 0;
  if (is_number(text, value)) return "";  // its range is checked where it is used
  const bool comma = text.find(',') != text.npos;
  return complaint(config::in_quotes(text), "a number", comma ? "a point for the comma" : "");
}

std::string no_text(const std::string& text) {
  return text.empty() ? complaint(config::in_quotes(text), "a value that is not empty") : "";
}

void complete(CLI::Option& option) {
  if (takes_value(option) && !names_of(option).empty()) option.check(CLI::Validator(no_text, ""));
  const std::string type = option.get_type_name(), word = type.substr(0, type.find(':'));
  if (word == "TEXT") option.type_name("VALUE");
  if (word == "FLOAT") option.type_name("NUMBER")->check(CLI::Validator(no_number, ""));
  if (word != "INT" && word != "UINT") return;
  const long long first = word == "UINT" ? 0 : std::numeric_limits<int>::min();
  const auto wrong = [first](std::string& text) {
    return no_whole_number(text, first, std::numeric_limits<int>::max(),
                           first == 0 ? "a whole number, not below 0" : "a whole number");
  };
  option.type_name("N")->check(CLI::Validator(wrong, ""));
}

}  // namespace

CLI::App& subcommand(CLI::App& app, std::string_view name, std::string_view description,
                     std::string_view example) {
  CLI::App& sub = *app.add_subcommand(std::string(name), std::string(description));
  sub.footer(std::string(example));
  return sub;
}

void add_flags(CLI::App& sub, Flags& flags, const char* force, const char* json,
               const char* quiet) {
  const auto add = [&](const char* name, bool& flag, const char* description) {
    if (*description) sub.add_flag(name, flag, description);
  };
  add("--force", flags.force, force);
  add("--json", flags.json, json);
  add("--quiet", flags.quiet, quiet);
}

CLI::App& alternatives(CLI::App& sub, const std::string& name) {
  CLI::App& group = *sub.add_option_group(name);
  group.require_option(1);
  group.set_help_flag();  // the command has one
  return group;
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string choices;
  for (const std::string& word : words) choices += before_choice + word;
  const auto wrong = [words](const std::string& text) -> std::string {
    const std::vector<std::string_view> all(words.begin(), words.end());
    if (std::ranges::find(all, text) != all.end()) return "";
    return complaint(config::in_quotes(text), either_of(words),
                     config::closest_in_quotes(text, all));
  };
  return {wrong, choices};
}

CLI::Validator between(int first, int last) {
  const auto wrong = [first, last](std::string& text) {
    return no_whole_number(text, first, last, fmt::format("a whole number, {} to {}", first, last));
  };
  return {wrong, ""};
}

CLI::Validator passes(std::function<std::string(const std::string&)> wrong) {
  const auto checked = [wrong = std::move(wrong)](const std::string& text) {
    try {
      return wrong(text);
    } catch (const config::Error& e) {
      const config::Problem& p = e.problems().front();
      return complaint(p.found, p.expected, p.try_this);
    }
  };
  return {checked, ""};
}

void add_sets(CLI::App& sub, std::vector<std::string>& sets) {
  const auto twice = [seen = std::make_shared<std::set<std::string>>()](const std::string& text) {
    const std::string key(units::trimmed(std::string_view(text).substr(0, text.find('='))));
    if (!seen->insert(key).second)
      config::fail({}, "", config::in_quotes(text) + ", a second value of this key",
                   "one value for each key");
    return std::string();
  };
  sub.add_option("--set", sets, "KEY=VALUE: value to use in place of the file's")
      ->allow_extra_args(false)
      ->check(passes(twice));
}

void complete_description(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) complete(*option);
  for (CLI::App* sub : app.get_subcommands([](CLI::App*) { return true; }))
    complete_description(*sub);
}

void refuse(const std::string& option, const std::string& found, const std::string& expected) {
  throw CLI::ValidationError(option, complaint(found, expected));
}

void require(const std::string& option, const std::string& expected) {
  throw CLI::ValidationError(option, "missing; expected " + expected);
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* a) { return !a->get_name().empty(); });
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  for (const CLI::App* sub : commands_of(app))
    if (sub->get_name() == name) return sub;
  return nullptr;
}

std::vector<const CLI::App*> groups_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  std::vector<const CLI::Option*> out = app.get_options();
  std::erase_if(out, [](const CLI::Option* option) { return option->get_group().empty(); });
  for (const CLI::App* group : groups_of(app))
    for (const CLI::Option* option : group->get_options()) out.push_back(option);
  return out;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_snames()) out.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  return out;
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  std::vector<std::string> out;
  for (std::size_t at = type.find(before_choice); at < type.size();) {
    const std::size_t end = std::min(type.find(before_choice, at + 1), type.size());
    out.push_back(type.substr(at + 1, end - at - 1));
    at = end;
  }
  return out;
}

std::string either_of(const std::vector<std::string>& choices) {
  const auto is_letter = [](unsigned char c) { return std::isalnum(c) != 0; };
  const auto is_plain = [&](const std::string& word) {
    return std::ranges::any_of(word, is_letter) && std::ranges::all_of(word, [&](char c) {
             return is_letter(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
           });
  };
  std::vector<std::string> out = choices;
  if (!std::ranges::all_of(out, is_plain))
    for (std::string& word : out) word = config::in_quotes(word);
  return config::either({out.begin(), out.end()});
}

std::string words_to(const CLI::App& app) {
  if (!app.get_parent()) return "sinew";
  return words_to(*app.get_parent()) + " " + app.get_name();
}

}  // namespace sinew::cli
