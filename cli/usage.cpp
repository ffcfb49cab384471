// cli/usage.cpp - what is wrong with a line that the program does not understand.
//
// CLI11 stops at the first problem and names types and internal terms. Here the line is examined
// again and every problem is reported: `--untis: found no such option of sinew compare; …`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "cli/help.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

constexpr std::size_t few = 8, few_commands = 18;  // words that a message may list

using Names = std::vector<std::string>;
using Problems = std::vector<config::Problem>;

void add(Problems& out, std::string of, std::string found, std::string expected,
         std::string try_this = "") {
  out.push_back({{}, std::move(of), std::move(found), std::move(expected), std::move(try_this)});
}

// Returns the last command that the line names.
const CLI::App& command_of(const CLI::App& program) {
  const CLI::App* at = &program;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

Names names_of_options(const CLI::App& command) {
  Names out;
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : names_of(*option)) out.push_back(name);
  return out;
}

Names names_of_commands(const CLI::App& command) {
  Names out;
  for (const CLI::App* sub : commands_of(command)) out.push_back(sub->get_name());
  return out;
}

std::string listed(const Names& names, const char* where_many, std::size_t most) {
  if (names.size() > most) return where_many;
  return config::either({names.begin(), names.end()});
}

std::string listed_commands(const Names& names) {
  return listed(names, "one that its help names", few_commands);
}

std::string_view without_dashes(std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
  return name;
}

// Returns the option that was likely meant: one that differs by a few letters, or begins alike.
std::string near_option(std::string_view word, const CLI::App& command) {
  const Names names = names_of_options(command);
  const std::string_view bare = without_dashes(word);
  std::vector<std::string_view> candidates;
  for (const std::string& name : names)
    if (name.starts_with("--")) candidates.push_back(without_dashes(name));
  if (const std::string_view near = config::closest(bare, candidates); !near.empty())
    return "--" + std::string(near);
  for (const std::string_view name : candidates)
    if (std::min(name.size(), bare.size()) >= 3 &&
        (name.starts_with(bare) || bare.starts_with(name)))
      return "--" + std::string(name);
  return "";
}

// Adds the commands that have an option of that name.
void find_owners(const CLI::App& at, const std::string& name, Names& out) {
  if (std::ranges::count(names_of_options(at), name) > 0) out.push_back(words_to(at));
  for (const CLI::App* sub : commands_of(at)) find_owners(*sub, name, out);
}

void add_unknown_option(std::string word, const CLI::App& command, const CLI::App& program,
                        Problems& out) {
  word = word.substr(0, word.find('='));
  const std::string near = near_option(word, command);
  std::string found = "no such option of " + words_to(command);
  Names owners;
  if (near.empty()) find_owners(program, word, owners);
  if (!owners.empty() && owners.size() <= 3)
    found += fmt::format(", it is one of {}", fmt::join(owners, " and "));
  Names names = names_of_options(command);
  std::erase_if(names, [](const std::string& n) { return !n.starts_with("--") || n == "--help"; });
  add(out, word, found,
      names.empty() ? "no option" : listed(names, "an option that its help names", few), near);
}

void add_unknown_word(const std::string& word, const CLI::App& command, Problems& out) {
  const Names names = names_of_commands(command);
  if (!names.empty())
    return add(out, word, "no such command of " + words_to(command), listed_commands(names),
               std::string(config::closest(word, {names.begin(), names.end()})));
  const std::size_t at = word.find('=');
  const std::string near = near_option(word.substr(0, at), command);
  const std::string value = at == word.npos ? "" : " " + word.substr(at + 1);
  add(out, word, "a word too many for " + words_to(command), usage_of(command),
      near.empty() ? "" : near + value);
}

// Words that are left over. What follows an unknown option is most often its value.
void add_leftovers(const CLI::App& command, const CLI::App& program, Problems& out) {
  const Names words = command.remaining();
  for (const std::string& word : words)
    if (word.size() > 1 && word.starts_with('-') && word != "--")
      add_unknown_option(word, command, program, out);
  if (out.empty() && !words.empty()) add_unknown_word(words.front(), command, out);
}

// Returns what an option is for, "pdf or svg: the format".
std::string meaning_of(const CLI::Option& option) {
  const Names choices = choices_of(option);
  return (choices.empty() ? "" : either_of(choices) + ": ") + option.get_description();
}

void add_missing(const CLI::App& command, Problems& out) {
  for (const CLI::Option* option : options_of(command))
    if (option->get_required() && option->count() == 0)
      add(out, option->get_name(), "nothing", meaning_of(*option));
  for (const CLI::App* group : groups_of(command)) {
    Names all, given;
    for (const CLI::Option* option : group->get_options()) {
      all.push_back(option->get_name());
      if (option->count() > 0) given.push_back(option->get_name());
    }
    if (given.size() != 1)
      add(out, words_to(command),
          given.empty() ? "none of them" : fmt::format("{}", fmt::join(given, " with ")),
          "just one of " + config::either({all.begin(), all.end()}));
  }
  const Names names = names_of_commands(command);
  if (!names.empty()) add(out, words_to(command), "no command", listed_commands(names));
}

// Options that exclude or need each other.
void add_pairs(const CLI::App& command, Problems& out) {
  std::set<const CLI::Option*> reported;
  for (const CLI::Option* option : options_of(command)) {
    if (option->count() == 0) continue;
    for (const CLI::Option* other : option->get_excludes())
      if (other->count() > 0 && !reported.contains(other)) {
        reported.insert(option);
        add(out, option->get_name(), other->get_name() + " with it", "one of the two");
      }
    for (const CLI::Option* other : option->get_needs())
      if (other->count() == 0)
        add(out, option->get_name(), "no " + other->get_name() + " with it",
            other->get_name() + " " + meaning_of(*other));
  }
}

// An option with too few or too many words; a flag that has one.
void add_wrong_number(const CLI::App& command, std::string_view message, Problems& out) {
  for (const CLI::Option* option : options_of(command)) {
    const std::string name = option->get_name();
    const bool begins = message.starts_with(name + ":") || message.starts_with(name + " ");
    if (!begins && message.find(" " + name + " ") == message.npos) continue;
    const int least = option->get_items_expected_min(), most = option->get_items_expected_max();
    if (!takes_value(*option))
      return add(out, name, "a value behind it", "the option alone: it is on or off");
    if (option->count() == 0) return add(out, name, "nothing behind it", meaning_of(*option));
    if (most == 1) return add(out, name, fmt::format("it {} times", option->count()), "it once");
    const bool any = most >= CLI::detail::expected_max_vector_size;
    return add(out, name, std::to_string(option->count()),
               any             ? fmt::format("at least {}", least)
               : least == most ? std::to_string(least)
                               : fmt::format("{} to {}", least, most));
  }
}

}  // namespace

std::string problems_of_line(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = command_of(program);
  const std::string words = words_to(command);
  const std::string more = fmt::format("\n{} describes {}", help_command(words), words);
  // Messages of this program's checks stay as they are.
  if (dynamic_cast<const CLI::ValidationError*>(&error)) return error.what() + more;
  Problems out;
  add_leftovers(command, program, out);
  if (out.empty() && (dynamic_cast<const CLI::ArgumentMismatch*>(&error) ||
                      dynamic_cast<const CLI::ConversionError*>(&error)))
    add_wrong_number(command, error.what(), out);
  if (out.empty()) add_pairs(command, out);
  if (out.empty()) add_missing(command, out);
  if (out.empty()) add(out, words, "a line that is not understood", usage_of(command));
  return config::to_text(out) + more;
}

}  // namespace sinew::cli
