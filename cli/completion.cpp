// cli/completion.cpp - `sinew completion`: completion of a line of sinew in bash, zsh and fish.
//
// The scripts pass the words of the line, with tabs between them, as --line to this command, which
// prints what may be in place of the last one. So commands, options and keys are listed in one
// place.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>

#include "cli/command.h"
#include "sinew/files/keys.h"
#include "sinew/files/values.h"

namespace sinew::cli {

namespace {

// In all three, a key ends with "=" and gets no blank after it.
constexpr std::string_view bash_script = R"script(# bash completion of sinew
_sinew() {
  local IFS=$'\t'
  mapfile -t COMPREPLY < <("$1" completion bash --line="${COMP_WORDS[*]:0:COMP_CWORD+1}" 2>/dev/null)
  COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
  [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace 2>/dev/null
}
complete -o default -F _sinew sinew
)script";

constexpr std::string_view zsh_script = R"script(#compdef sinew
# zsh completion of sinew
_sinew() {
  local offered=(${(f)"$("${words[1]}" completion zsh --line="${(pj:\t:)words[1,CURRENT]}" 2>/dev/null)"})
  offered=(${offered%%$'\t'*})
  if ((!$#offered)); then
    _files
  else
    compadd -S '' -- ${(M)offered:#*=}
    compadd -- ${offered:#*=}
  fi
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _sinew "$@"
else
  compdef _sinew sinew
fi
)script";

constexpr std::string_view fish_script = R"script(# fish completion of sinew
function __sinew_words
    set -l line (commandline -opc)
    set -l last (commandline -ct)
    $line[1] completion fish --line=(string join \t -- $line "$last") 2>/dev/null
end
complete -c sinew -f -a '(__sinew_words; or __fish_complete_path (commandline -ct))'
)script";

// A word, and what it is.
using Offer = std::pair<std::string, std::string>;

// Words of other letters are left out: a shell would interpret them.
bool is_plain(const std::string& word) {
  return !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("-_.[]=").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

// Adds the keys of the first file in the line, each followed by `end`.
void add_keys_of(const std::vector<std::string>& line, const char* end, std::vector<Offer>& out) {
  for (std::string word : line) {
    const char* home = std::getenv("HOME");
    if (home && word.starts_with("~/")) word.replace(0, 1, home);
    if (!word.ends_with(".toml") || !std::filesystem::is_regular_file(word)) continue;
    for (const config::Origin& value : files::values(word).origins)
      out.emplace_back(value.path + end, "");
    return;
  }
}

// Adds the words that a key may have, after `begin`.
void add_words_of(const std::string& key, const std::string& begin, std::vector<Offer>& out) {
  std::set<std::string> words;
  for (const files::Key& one : files::find_keys({key}, ""))
    words.insert(one.choices.begin(), one.choices.end());
  for (const std::string& word : words) out.emplace_back(begin + word, "");
}

// Adds what may be the value of an option; nothing for a file's name or any other text.
void add_values(const CLI::Option& option, const std::string& name,
                const std::vector<std::string>& line, bool split, std::vector<Offer>& out) {
  for (const std::string keyed : {"--set", "--vary", "--range", "--largest"}) {
    if (name != keyed) continue;
    const std::size_t equals = line.back().find('=');
    if (equals == std::string::npos) return add_keys_of(line, "=", out);
    const std::string key = line.back().substr(0, equals);
    return add_words_of(key, split ? "" : key + "=", out);
  }
  if (name == "--units") out = {{"si", ""}, {"thesis", ""}, {"metric", ""}};
  for (const std::string& word : choices_of(option)) out.emplace_back(word, "");
}

// Returns what may be in place of the last word. `split`: bash passes "key=value" as three words.
std::vector<Offer> offers(const std::vector<std::string>& line, bool split,
                          const CLI::App& program) {
  std::vector<Offer> out;
  const CLI::App* at = &program;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (const CLI::App* sub = find_command(*at, line[i])) at = sub;
  const std::string before = line.size() > 1 ? line[line.size() - 2] : "";
  for (const CLI::Option* option : options_of(*at))
    for (const std::string& name : names_of(*option))
      if (name == before && takes_value(*option)) {
        add_values(*option, name, line, split, out);
        return out;
      }
  if (line.back().starts_with("-")) {
    for (const CLI::Option* option : options_of(*at))
      for (const std::string& name : names_of(*option))
        out.emplace_back(name, option->get_description());
  } else if (words_to(*at) == "sinew show") {
    add_keys_of(line, "", out);
  } else {
    for (const CLI::App* sub : commands_of(*at))
      out.emplace_back(sub->get_name(), sub->get_description());
    for (const CLI::Option* option : options_of(*at))
      if (option->get_positional())
        for (const std::string& word : choices_of(*option)) out.emplace_back(word, "");
  }
  return out;
}

// Returns the words behind the program's name.
std::vector<std::string> words_of_line(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text + "\t");
  for (std::string word; std::getline(in, word, '\t');) out.push_back(word);
  out.erase(out.begin());
  if (out.empty()) out.emplace_back();
  return out;
}

// Prints one offer a line, with its description behind a tab. Fails without any offer: then fish
// completes files.
ExitCode print_offers(std::vector<std::string> line, const CLI::App& program) try {
  bool split = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != "=") continue;
    const std::size_t last = std::min(i + 2, line.size());
    split = last == line.size();
    line[i - 1] += "=" + (i + 1 < line.size() ? line[i + 1] : "");
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(i),
               line.begin() + static_cast<std::ptrdiff_t>(last));
  }
  const std::string& last = line.back();
  const std::string begin = split ? last.substr(last.find('=') + 1) : last;
  bool offered = false;
  for (const auto& [word, meaning] : offers(line, split, program)) {
    if (!is_plain(word) || !word.starts_with(begin)) continue;
    fmt::print("{}{}{}\n", word, meaning.empty() ? "" : "\t", meaning);
    offered = true;
  }
  return offered ? ok : failed;
} catch (const std::exception&) {
  return failed;  // a file with mistakes offers nothing
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  auto line = std::make_shared<std::string>();
  CLI::App& sub =
      subcommand(app, "completion", "Print the script with which a shell completes lines of sinew",
                 "source <(sinew completion bash)");
  sub.add_option("SHELL", *shell, "shell")->required()->check(one_of({"bash", "zsh", "fish"}));
  CLI::Option* of_script = sub.add_option("--line", *line, "of the scripts")->group("");
  sub.callback([=, &app, &action] {
    action = [=, &app] {
      if (of_script->count() > 0) return print_offers(words_of_line(*line), app);
      fmt::print("{}", *shell == "bash" ? bash_script : *shell == "zsh" ? zsh_script : fish_script);
      return ok;
    };
  });
}

}  // namespace sinew::cli
