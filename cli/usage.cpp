#include "cli/usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "cli/help.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

constexpr std::size_t few = 8;            // words that a message may list
constexpr std::size_t few_commands = 18;  // commands, which are what one came for

using Problems = std::vector<config::Problem>;

config::Problem problem(std::string of, std::string found, std::string expected,
                        std::string try_this = "") {
  return {{}, std::move(of), std::move(found), std::move(expected), std::move(try_this)};
}

// The last command that the line names.
const CLI::App& asked(const CLI::App& program) {
  const CLI::App* at = &program;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

// The command's own options, and those of its groups.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> out = command.get_options();
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); }))
    for (const CLI::Option* option : group->get_options()) out.push_back(option);
  return out;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : shape_of(*option).names) out.push_back(name);
  return out;
}

std::vector<std::string> names_of_commands(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::App* sub :
       command.get_subcommands([](const CLI::App* a) { return !a->get_name().empty(); }))
    out.push_back(sub->get_name());
  return out;
}

std::string one_of(const std::vector<std::string>& names, const std::string& else_words,
                   std::size_t most = few) {
  if (names.size() > most) return else_words;
  return config::either({names.begin(), names.end()});
}

std::string_view without_dashes(std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
  return name;
}

// The option that was likely meant: one that differs by a few letters, or begins as the word does.
std::string near_option(std::string_view word, const CLI::App& command) {
  const std::vector<std::string> names = names_of_options(command);
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

// Where else there is an option of that name: "an option of sinew new".
void find_owners(const CLI::App& at, const std::string& name, std::vector<std::string>& out) {
  if (std::ranges::count(names_of_options(at), name) > 0) out.push_back(words_to(at));
  for (const CLI::App* sub :
       at.get_subcommands([](const CLI::App* a) { return !a->get_name().empty(); }))
    find_owners(*sub, name, out);
}

config::Problem unknown_option(std::string word, const CLI::App& command, const CLI::App& program) {
  word = word.substr(0, word.find('='));
  const std::string near = near_option(word, command);
  std::string found = "no such option of " + words_to(command);
  if (near.empty()) {
    std::vector<std::string> owners;
    find_owners(program, word, owners);
    if (!owners.empty() && owners.size() <= 3)
      found += fmt::format(", it is one of {}", fmt::join(owners, " and "));
  }
  std::vector<std::string> names = names_of_options(command);
  std::erase_if(names, [](const std::string& n) { return !n.starts_with("--") || n == "--help"; });
  return problem(word, found,
                 names.empty() ? "no option" : one_of(names, "an option that its help names"),
                 near);
}

config::Problem unknown_word(const std::string& word, const CLI::App& command) {
  const std::vector<std::string> names = names_of_commands(command);
  if (!names.empty() && command.get_subcommands().empty())
    return problem(word, "no such command of " + words_to(command),
                   one_of(names, "one that its help names", few_commands),
                   std::string(config::closest(word, {names.begin(), names.end()})));
  const std::string near = near_option(word.substr(0, word.find('=')), command);
  const std::size_t at = word.find('=');
  const std::string value = at == word.npos ? "" : " " + word.substr(at + 1);
  return problem(word, "a word too many for " + words_to(command),
                 usage_of(tree_of(command), words_to(command)), near.empty() ? "" : near + value);
}

// Words that no option and no place takes. Behind an unknown option stands, most often, its value.
void tell_of_leftovers(const CLI::App& command, const CLI::App& program, Problems& out) {
  const std::vector<std::string> words = command.remaining();
  for (const std::string& word : words)
    if (word.size() > 1 && word.starts_with('-') && word != "--")
      out.push_back(unknown_option(word, command, program));
  if (out.empty() && !words.empty()) out.push_back(unknown_word(words.front(), command));
}

// Returns the words for a missing option or word, "a file: the robot's".
std::string meaning_of(const CLI::Option& option) {
  const CommandTree::Shape shape = shape_of(option);
  std::string out = shape.description;
  if (!shape.choices.empty()) out = either_of(shape.choices) + ": " + out;
  return out;
}

void tell_of_missing(const CLI::App& command, Problems& out) {
  for (const CLI::Option* option : options_of(command))
    if (option->get_required() && option->count() == 0)
      out.push_back(problem(option->get_name(), "nothing", meaning_of(*option)));
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); })) {
    std::vector<std::string> all, given;
    for (const CLI::Option* option : group->get_options()) {
      all.push_back(option->get_name());
      if (option->count() > 0) given.push_back(option->get_name());
    }
    if (given.size() == 1 || group->get_require_option_min() == 0) continue;
    out.push_back(
        problem(words_to(command),
                given.empty() ? "none of them" : fmt::format("{}", fmt::join(given, " with ")),
                "just one of " + config::either({all.begin(), all.end()})));
  }
  const std::vector<std::string> names = names_of_commands(command);
  if (!names.empty() && command.get_subcommands().empty())
    out.push_back(problem(words_to(command), "no command",
                          one_of(names, "one that its help names", few_commands)));
}

void tell_of_pairs(const CLI::App& command, Problems& out) {
  std::set<const CLI::Option*> told;
  for (const CLI::Option* option : options_of(command)) {
    if (option->count() == 0) continue;
    for (const CLI::Option* other : option->get_excludes())
      if (other->count() > 0 && !told.contains(other)) {
        told.insert(option);
        out.push_back(
            problem(option->get_name(), other->get_name() + " beside it", "one of the two"));
      }
    for (const CLI::Option* other : option->get_needs())
      if (other->count() == 0)
        out.push_back(problem(option->get_name(), "no " + other->get_name() + " beside it",
                              other->get_name() + " too: " + meaning_of(*other)));
  }
}

// An option whose words are too few or too many; a flag that has one.
void tell_of_number(const CLI::App& command, std::string_view said, Problems& out) {
  for (const CLI::Option* option : options_of(command)) {
    const std::string name = option->get_name();
    const bool begins = said.starts_with(name + ":") || said.starts_with(name + " ");
    if (!begins && said.find(" " + name + " ") == said.npos) continue;
    const CommandTree::Shape shape = shape_of(*option);
    if (!shape.takes_value())
      out.push_back(problem(name, "a value behind it", "the option alone: it is on or off"));
    else if (option->count() == 0)
      out.push_back(problem(name, "nothing behind it", meaning_of(*option)));
    else
      out.push_back(problem(
          name, std::to_string(option->count()),
          shape.least == shape.most || shape.most == CommandTree::many
              ? fmt::format("{}{}", shape.most == CommandTree::many ? "at least " : "", shape.least)
              : fmt::format("{} to {}", shape.least, shape.most)));
    return;
  }
}

}  // namespace

std::string problems_of_line(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = asked(program);
  const std::string more =
      fmt::format("\n{} describes {}", help_command(words_to(command)), words_to(command));
  // The words of our own checks and actions about a value stay as they are.
  if (dynamic_cast<const CLI::ValidationError*>(&error)) return error.what() + more;
  Problems out;
  tell_of_leftovers(command, program, out);
  if (out.empty() && (dynamic_cast<const CLI::ArgumentMismatch*>(&error) ||
                      dynamic_cast<const CLI::ConversionError*>(&error)))
    tell_of_number(command, error.what(), out);
  if (out.empty()) tell_of_pairs(command, out);
  if (out.empty()) tell_of_missing(command, out);
  if (out.empty())
    out.push_back(problem(words_to(command), "a line that is not understood",
                          usage_of(tree_of(command), words_to(command))));
  return config::to_text(out) + more;
}

}  // namespace sinew::cli
