#include "cli/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

// Returns docs/reference/help.md; the build makes it of the file.
std::string_view page_of_topics();

namespace {

// Commands grouped by purpose.
struct Task {
  std::string_view title, commands, example;
};
constexpr Task tasks[] = {
    {"Run a machine or a muscle", "run view replay", "sinew run experiments/walk-test-1.toml"},
    {"See runs", "report compare figures film analyze export",
     "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html"},
    {"Learn from measurements", "import identify",
     "sinew identify static forces.csv --value \"length=80 mm\" --out muscle.toml"},
    {"Vary and tune", "sweep tune sensitivity merge", "sinew tune studies/faster-walk.toml"},
    {"Work with files and their keys", "new list keys show check migrate",
     "sinew new robot my-arm --metric"},
    {"Calculate", "actuator valve kinematics force-beam design",
     "sinew actuator robots/leg/actuator.toml --length \"3 in\" --pressure \"60 psi gauge\""},
    {"Drive hardware, and other programs", "doctor bring-up firmware fmu", "sinew doctor"},
};

// --- lines that fit the terminal, or 100 letters ---

std::size_t width() {
  constexpr std::size_t usual = 100, narrowest = 40;
  const std::size_t columns = width_of_output();
  return columns == 0 ? usual : std::clamp(columns, narrowest, usual);
}

// Returns the number of letters, not bytes, of UTF-8.
std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Returns lines with `indent` blanks before each but the first.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::istringstream in{std::string(text)};
  std::string out;
  std::size_t at = indent;
  for (std::string word; in >> word; at += letters(word)) {
    if (at > indent && at + 1 + letters(word) > width()) {
      out += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (at > indent) {
      out += ' ';
      ++at;
    }
    out += word;
  }
  return out + "\n";
}

// Returns examples, a line each, in lines that fit a terminal: a longer one breaks before an
// option, as a shell reads it. A line of a file or a pipe stays whole.
std::string folded(std::string_view examples) {
  std::istringstream in{std::string(examples)};
  std::string out;
  for (std::string line; std::getline(in, line);) {
    const auto start = line.find_first_not_of(' ');
    std::size_t at = 2;
    for (std::size_t begin = start, end = 0; begin < line.size(); begin = end) {
      end = std::min(std::min(line.find(" -o ", begin + 1), line.find(" --", begin + 1)),
                     line.size());
      const std::string_view part = std::string_view(line).substr(begin, end - begin);
      if (width_of_output() > 0 && begin > start && at + letters(part) + 2 > width()) {
        out += " \\\n   ";
        at = 3;
      }
      if (begin == start) out += "  ";
      out += part;
      at += letters(part);
    }
    out += "\n";
  }
  return out;
}

// A title and its description, in two columns.
struct HelpRow {
  std::string title, words;
};

std::string table(const std::vector<HelpRow>& rows, std::size_t title_width = 0) {
  constexpr std::size_t widest_title = 26;
  for (const HelpRow& row : rows)
    if (const std::size_t n = letters(row.title); n <= widest_title)
      title_width = std::max(title_width, n);
  std::string out;
  for (const HelpRow& row : rows) {
    const std::size_t n = letters(row.title), begin = 2 + title_width + 2;
    out += "  " + row.title;
    out += n > title_width ? "\n" + std::string(begin, ' ') : std::string(begin - 2 - n, ' ');
    out += wrapped(row.words, begin);
  }
  return out;
}

// --- one command ---

// Returns "sobol|morris|ends"; "WORD" where they are many, or one of them would need quotes.
std::string choices_in_short(const CLI::Option& option) {
  constexpr std::size_t longest = 24;
  const std::vector<std::string> choices = choices_of(option);
  const std::string words = fmt::format("{}", fmt::join(choices, "|"));
  const bool quoted = either_of(choices).find('"') != std::string::npos;
  return quoted || words.size() > longest ? "WORD" : words;
}

// Returns the value's name with which a description begins, "FILE" of "FILE: page to write", or "".
std::string name_of_value(const std::string& description) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const std::string word = description.substr(0, description.find(' '));
  const bool is_name = word.ends_with(':') && std::ranges::any_of(word, is_capital);
  return is_name ? word.substr(0, word.size() - 1) : "";
}

// Returns "VALUE", "FILE …", "sobol|morris|ends".
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name(), name = name_of_value(option.get_description());
  std::string out = option.get_positional()       ? option.get_name()
                    : !choices_of(option).empty() ? choices_in_short(option)
                    : !name.empty()               ? name
                                                  : type.substr(0, type.find(':'));
  return option.get_items_expected_max() > 1 && !is_repeated(option) ? out + " …" : out;
}

// Returns "--units VALUE", "--json".
std::string with_value(const CLI::Option& option, const std::string& names) {
  return takes_value(option) ? names + " " + value_of(option) : names;
}

// Returns the description, the words that the value may have, its default, and how often the option
// may be given.
std::string described_option(const CLI::Option& option) {
  std::string out = option.get_description();
  const bool named = !option.get_positional();
  if (const std::size_t n = name_of_value(out).size(); n > 0) out.erase(0, n + 2);
  const std::vector<std::string> choices = choices_of(option);
  const auto is_in = [&](const std::string& word) { return out.find(word) != out.npos; };
  if (!std::ranges::all_of(choices, is_in) && !(named && choices_in_short(option) != "WORD"))
    out += ": " + either_of(choices);
  if (takes_value(option) && !option.get_default_str().empty())
    out += "; default: " + option.get_default_str();
  if (is_repeated(option) && out.find("repeated") == out.npos) out += "; may be repeated";
  if (option.get_required() && named) out += "; required";
  return out;
}

// Returns a table under a title of the options of a heading, "Options" for those without one, or of
// the arguments that are no options.
std::string section(const CLI::App& command, std::string_view title, bool named,
                    std::string_view heading = "Options") {
  std::vector<HelpRow> rows;
  for (const CLI::Option* option : options_of(command))
    if (option->get_positional() != named && option->get_group() == heading)
      rows.push_back(
          {named ? with_value(*option, fmt::format("{}", fmt::join(names_of(*option), ", ")))
                 : option->get_name(),
           described_option(*option)});
  return rows.empty() ? "" : fmt::format("\n{}{}", title, table(rows));
}

// Returns the names of the options that many commands share; `sinew help tables` describes them.
std::string names_of_table_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command))
    if (option->get_group() == table_heading) names.push_back(option->get_name());
  if (names.empty()) return "";
  return fmt::format("\n{}, described by `sinew help tables`:\n  {}", table_heading,
                     wrapped(fmt::format("{}", fmt::join(names, ", ")), 2));
}

// --- pages ---

// Returns the sections of the page of topics, each with its title as its first line.
std::vector<std::string> topics() {
  std::vector<std::string> out;
  const std::string_view page = page_of_topics(), begin = "\n## ";
  for (std::size_t at = page.find(begin); at != page.npos;) {
    const std::size_t next = page.find(begin, at + 1);
    out.emplace_back(page.substr(at + begin.size(), next - at - begin.size()));
    at = next;
  }
  return out;
}

std::string title_of(const std::string& topic) { return topic.substr(0, topic.find('\n')); }

std::string names_of_topics() {
  std::vector<std::string> names;
  for (const std::string& topic : topics()) names.push_back(title_of(topic));
  names.emplace_back("commands");
  return either_of(names);
}

// Returns a section of the page without its marks; code is indented. Empty: no topic has that name.
std::string topic_text(const std::string& name) {
  for (const std::string& topic : topics()) {
    if (title_of(topic) != name) continue;
    std::istringstream in(topic.substr(std::min(name.size() + 2, topic.size())));
    std::string out;
    bool code = false;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("```")) {
        code = !code;
        continue;
      }
      std::erase(line, '`');
      out += (code && !line.empty() ? "  " : "") + line + "\n";
    }
    return out;
  }
  return "";
}

std::string all_commands(const CLI::App& app) {
  std::string out;
  for (const CLI::App* sub : commands_of(app))
    out += words_to(*sub).substr(std::string_view("sinew ").size()) + "\n" + all_commands(*sub);
  return out;
}

std::string overview(const CLI::App& program) {
  std::string out = wrapped(program.get_description(), 0) + "\nUsage: sinew COMMAND …\n";
  const auto add = [&](std::string_view title, const std::vector<HelpRow>& rows,
                       std::string_view example) {
    out += fmt::format("\n{}:\n{}    {}\n", title, table(rows, 13), example);
  };
  for (const Task& task : tasks) {
    std::vector<HelpRow> rows;
    std::istringstream names{std::string(task.commands)};
    for (std::string name; names >> name;)
      if (const CLI::App* command = find_command(program, name))
        rows.push_back({name, command->get_description()});
    add(task.title, rows, task.example);
  }
  add("Find your way",
      {{"help COMMAND", "Describe a command, with an example"},
       {"help TOPIC", "Describe " + names_of_topics()},
       {"completion", "Print the script with which a shell completes lines of sinew"},
       {"--version", "Print the version of Sinew"}},
      "sinew help next");
  return out;
}

std::string help_of(const CLI::App& command) {
  if (!command.get_parent()) return overview(command);
  std::string out = wrapped(words_to(command) + ": " + command.get_description(), 0);
  out += "\nUsage: " + wrapped(usage_of(command), 7);
  std::vector<HelpRow> rows;
  for (const CLI::App* sub : commands_of(command))
    rows.push_back({sub->get_name(), sub->get_description()});
  if (!rows.empty()) out += "\nCommands:\n" + table(rows);
  out += section(command, "Arguments:\n", false) + section(command, "Options:\n", true);
  return out + names_of_table_options(command) + "\nExample:\n" + folded(command.get_footer());
}

// --- sinew help ---

// Throws where no command, or topic, has these words.
[[noreturn]] void refuse_words(const CLI::App& at, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* sub : commands_of(at)) names.push_back(sub->get_name());
  std::string expected = names.empty() ? "no word behind " + words_to(at)
                                       : config::either({names.begin(), names.end()});
  if (!at.get_parent()) {
    for (const std::string& topic : topics()) names.push_back(title_of(topic));
    expected = "a command, or one of " + names_of_topics();
  }
  config::fail({}, help_command(words_to(at)), config::in_quotes(word), expected,
               std::string(config::closest(word, {names.begin(), names.end()})));
}

ExitCode help(const std::vector<std::string>& words, const CLI::App& program) try {
  std::string page;
  if (words.size() == 1)
    page = words[0] == "commands" ? all_commands(program) : topic_text(words[0]);
  if (words == std::vector<std::string>{"tables"})
    page += section(*find_command(program, "import"), "", true, table_heading);
  if (!page.empty() && !find_command(program, words[0])) {
    fmt::print("{}", page);
    return ok;
  }
  const CLI::App* at = &program;
  for (const std::string& word : words) {
    const CLI::App* next = find_command(*at, word);
    if (!next) refuse_words(*at, word);
    at = next;
  }
  fmt::print("{}{}{}", help_of(*at), page.empty() ? "" : "\n", page);
  return ok;
} catch (const config::Error& e) {
  error(e.what());
  return wrong_usage;
}

}  // namespace

std::string Help::make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const {
  return help_of(*app);
}

std::string usage_of(const CLI::App& command) {
  std::string out = words_to(command);
  if (!commands_of(command).empty()) return out + " COMMAND …";
  bool optional = false;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name(), value = value_of(*option);
    if (option->get_positional())
      out += option->get_required() ? " " + value : " [" + value + "]";
    else if (option->get_required())
      out += " " + with_value(*option, name);
    else
      optional = optional || (option != command.get_help_ptr() && !option->get_group().empty());
  }
  for (const CLI::App* group : groups_of(command)) {
    std::vector<std::string> either;
    for (const CLI::Option* option : group->get_options())
      either.push_back(with_value(*option, option->get_name()));
    out += fmt::format(" ({})", fmt::join(either, " | "));
  }
  return optional ? out + " [OPTIONS]" : out;
}

std::string help_command(const std::string& words) {
  return "sinew help" + words.substr(std::string_view("sinew").size());
}

std::vector<std::string> with_help_first(std::vector<std::string> words, const CLI::App& program) {
  if (words.size() < 2 || words.back() != "help") return words;
  const CLI::App* at = &program;
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (!(at = find_command(*at, words[i]))) return words;
  std::rotate(words.begin(), words.end() - 1, words.end());
  return words;
}

void add_help(CLI::App& app, Action& action) {
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App& sub = subcommand(app, "help", "Describe a command, or what all commands share",
                             "sinew help identify static\n  sinew help units");
  sub.add_option("WORD", *words, "command or topic");
  sub.callback([=, &app, &action] { action = [=, &app] { return help(*words, app); }; });
}

}  // namespace sinew::cli
