// cli/completion.cpp - `sinew completion`: what a shell needs to complete a command line of sinew.
//
// The script is made of the program's own commands and options, so that it cannot say anything
// else. Keys behind --set are asked of the program while somebody types: `sinew show FILE --json`
// of the first .toml file in the line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "cli/command.h"
#include "cli/completion_scripts.h"

namespace sinew::cli {

namespace {

// Their values begin with a key of the file in the line.
constexpr std::string_view keyed = "--set|--vary|--range|--largest";

// Options that take more than some words, and the words that they begin with.
constexpr std::pair<std::string_view, std::string_view> begun[] = {{"--units", "si thesis metric"}};

std::vector<std::string> choices_for(const CommandTree::Shape& option) {
  std::vector<std::string> out;  // without marks, which a shell would take for its own
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  for (const std::string& word : option.choices)
    if (!word.empty() && std::ranges::all_of(word, plain)) out.push_back(word);
  if (!option.choices.empty()) return out;
  for (const auto& [name, words] : begun)
    if (std::ranges::find(option.names, name) != option.names.end()) return {std::string(words)};
  return {};
}

// A command with the words that lead to it: "identify static"; empty for the program's own.
struct Place {
  std::string words;
  const CommandTree* command;
};

void collect(const CommandTree& command, const std::string& words, std::vector<Place>& out) {
  out.push_back({words, &command});
  for (const CommandTree& sub : command.commands)
    collect(sub, words.empty() ? sub.name : words + " " + sub.name, out);
}

// Words as the three shells list them.
struct Words {
  std::vector<std::string> commands, options, valued, choices;
  // Of an option that takes one of some words: its names and those words.
  std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> chosen;
};

Words words_of(const CommandTree& command) {
  Words out;
  for (const CommandTree& sub : command.commands) out.commands.push_back(sub.name);
  for (const CommandTree::Shape& option : command.options) {
    const std::vector<std::string>& names = option.names;
    if (names.empty()) {
      out.choices.insert(out.choices.end(), option.choices.begin(), option.choices.end());
      continue;
    }
    out.options.insert(out.options.end(), names.begin(), names.end());
    if (!option.takes_value()) continue;
    out.valued.insert(out.valued.end(), names.begin(), names.end());
    if (auto choices = choices_for(option); !choices.empty())
      out.chosen.emplace_back(names, std::move(choices));
  }
  return out;
}

// 'text' for the shell: bash and zsh end the quote for a quote, fish escapes it.
std::string in_shell_quotes(std::string_view text, bool fish = false) {
  std::string out = "'";
  for (const char c : text) {
    if (fish && (c == '\'' || c == '\\')) out += '\\';
    out += c == '\'' && !fish ? "'\\''" : std::string(1, c);
  }
  return out + "'";
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

// One row of a `case`, which bash and zsh share: what may follow there.
std::string row(const Place& place) {
  const Words words = words_of(*place.command);
  std::string out = fmt::format(
      "    {}) commands={} options={} valued={} choices={} ;;\n", in_shell_quotes(place.words),
      in_shell_quotes(joined(words.commands)), in_shell_quotes(joined(words.options)),
      in_shell_quotes(joined(words.valued)), in_shell_quotes(joined(words.choices)));
  return out;
}

std::string rows(const std::vector<Place>& places) {
  std::string out;
  for (const Place& place : places) out += row(place);
  return out;
}

// Rows of the options that take one of some words.
std::string chosen_rows(const std::vector<Place>& places) {
  std::string out;
  for (const Place& place : places)
    for (const auto& [names, choices] : words_of(*place.command).chosen)
      for (const std::string& name : names)
        out += fmt::format("    {}) choices={} commands='' valued='' ;;\n",
                           in_shell_quotes(place.words + ":" + name),
                           in_shell_quotes(joined(choices)));
  return out;
}

std::string fish_option(const std::string& at, const CommandTree::Shape& option) {
  std::string out = fmt::format("complete -c sinew -n {}",
                                in_shell_quotes("__sinew_at " + in_shell_quotes(at), true));
  bool has_keys = false;
  for (const std::string& name : option.names) {
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    has_keys = has_keys || fmt::format("|{}|", keyed).find("|" + name + "|") != std::string::npos;
  }
  if (option.takes_value() && !option.names.empty()) out += " -r";
  if (const auto choices = choices_for(option); !choices.empty())
    out += " -f -a " + in_shell_quotes(joined(choices), true);
  if (has_keys) out += " -f -a '(__sinew_keys)'";
  if (!option.names.empty()) out += " -d " + in_shell_quotes(option.description, true);
  return out + "\n";
}

std::string filled(std::string_view script,
                   const std::vector<std::pair<std::string_view, std::string>>& words) {
  std::string out(script);
  for (const auto& [mark, text] : words)
    for (std::size_t at = out.find(mark); at != out.npos; at = out.find(mark, at + text.size()))
      out.replace(at, mark.size(), text);
  return out;
}

std::string for_fish(const std::vector<Place>& places) {
  std::string all, out;
  for (const Place& place : places) {
    const std::string at = place.words.empty() ? "" : " " + place.words;
    if (!at.empty()) all += (all.empty() ? "" : " ") + in_shell_quotes(at, true);
    for (const CommandTree& sub : place.command->commands)
      out += fmt::format("complete -c sinew -n {} -f -a {} -d {}\n",
                         in_shell_quotes("__sinew_at " + in_shell_quotes(at), true), sub.name,
                         in_shell_quotes(sub.description, true));
    for (const CommandTree::Shape& option : place.command->options)
      if (!option.names.empty() || !option.choices.empty()) out += fish_option(at, option);
  }
  return filled(fish_script, {{"@all@", all}}) + out;
}

ExitCode print(const std::string& shell, const CommandTree& program) {
  std::vector<Place> places;
  collect(program, "", places);
  const std::string script = shell == "fish"
                                 ? for_fish(places)
                                 : filled(shell == "bash" ? bash_script : zsh_script,
                                          {{"@functions@", std::string(shell_functions)},
                                           {"@rows@", rows(places)},
                                           {"@chosen@", chosen_rows(places)},
                                           {"@keyed@", std::string(keyed)}});
  fmt::print("{}", script);
  return ok;
}

}  // namespace

void add_completion(Command app, Action& action) {
  auto shell = std::make_shared<std::string>();
  Command sub =
      app.subcommand("completion", "what bash, zsh or fish needs to complete a line of sinew",
                     "source <(sinew completion bash)");
  sub.add_option("SHELL", *shell, "the shell").required().is_one_of({"bash", "zsh", "fish"});
  sub.callback([=, &action] { action = [=] { return print(*shell, app.tree()); }; });
}

}  // namespace sinew::cli
