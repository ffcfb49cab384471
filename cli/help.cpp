#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "cli/command.h"
#include "cli/help_topics.h"
#include "cli/table_options.h"
#include "cli/terminal.h"
#include "cli/wrapped.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {

namespace {

using Shape = CommandTree::Shape;

// Commands grouped by purpose. A command that no task names is listed under "more".
struct Task {
  std::string_view title, commands, example;
};
constexpr Task tasks[] = {
    {"Run a machine or a muscle", "run view replay", "sinew run experiments/walk-test-1.toml"},
    {"Look at runs", "report compare figures film analyze export",
     "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html"},
    {"Learn from measurements", "import identify",
     "sinew identify static forces.csv --value \"length=80 mm\" --out muscle.toml"},
    {"Vary and tune", "sweep tune sensitivity merge", "sinew tune studies/faster-walk.toml"},
    {"Work with files and their keys", "new list keys show check migrate",
     "sinew new robot my-arm --metric"},
    {"Calculate", "actuator valve kinematics force-beam",
     "sinew actuator robots/leg/actuator.toml --length \"3 in\" --pressure \"60 psi gauge\""},
    {"Drive hardware, and other programs", "doctor bring-up firmware fmu", "sinew doctor"},
};

const CommandTree* find(const CommandTree& command, std::string_view name) {
  const auto it = std::ranges::find(command.commands, name, &CommandTree::name);
  return it == command.commands.end() ? nullptr : &*it;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> out;
  std::istringstream in{std::string(text)};
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

// --- one command ---

// "sobol|morris|ends"; empty where they are many, or one of them would need quotes.
std::string choices_in_short(const Shape& option) {
  if (option.choices.empty() || option.names.empty()) return "";
  if (either_of(option.choices).find('"') != std::string::npos) return "";
  std::string words;
  for (const std::string& word : option.choices) words += (words.empty() ? "" : "|") + word;
  return words.size() <= 24 ? words : "";
}

// "--units VALUE", "--method sobol|morris|ends".
std::string value_of(const Shape& option) {
  std::string out = option.value;
  if (!option.choices.empty() && !option.names.empty()) {
    out = choices_in_short(option);
    if (out.empty()) out = "WORD";
  }
  return option.most > 1 ? out + " …" : out;
}

std::string title_of(const Shape& option) {
  std::string out;
  for (const std::string& name : option.names) out += (out.empty() ? "" : ", ") + name;
  if (option.names.empty()) return option.value;
  return option.takes_value() ? out + " " + value_of(option) : out;
}

// Returns the description, the words that it may have, its default, and how often it may come.
std::string words_of(const Shape& option) {
  std::string out = option.description;
  if (!option.choices.empty() && choices_in_short(option).empty())
    out += ": " + either_of(option.choices);
  if (option.takes_value() && !option.default_text.empty())
    out += "; default " + option.default_text;
  if (option.repeats && out.find("repeated") == out.npos) out += "; may be repeated";
  if (option.required && !option.names.empty()) out += "; always needed";
  return out;
}

// Returns the rows of the command's words, or of its options (`named`) under a heading. Options
// without a heading have the empty one.
std::vector<Row> rows_of(const CommandTree& command, bool named, std::string_view heading = "") {
  std::vector<Row> out;
  for (const Shape& option : command.options)
    if (option.names.empty() != named && option.heading == heading)
      out.push_back({title_of(option), words_of(option)});
  return out;
}

// Options that many commands share are named alone: the page `sinew help tables` describes them.
std::string names_of_table_options(const CommandTree& command) {
  std::string out;
  for (const Shape& option : command.options)
    if (option.heading == table_heading) out += (out.empty() ? "" : ", ") + option.name();
  if (out.empty()) return "";
  return fmt::format("\n{}, described by `sinew help tables`:\n{}", table_heading, wrapped(out, 2));
}

std::string about_tables(const CommandTree& program) {
  const CommandTree* import = find(program, "import");
  return wrapped(
             "Sinew reads separators, decimal marks, units in the header, dates and clocks off a "
             "table. What a table does not show, these options of sinew import and of the methods "
             "of sinew identify state. The columns that a method reads: sinew identify columns "
             "METHOD; the channels of a run: sinew help channels.") +
         "\n" + (import ? table(rows_of(*import, true, table_heading)) : "");
}

// Returns the options of a group of which one is given: "--foot VALUE | --angles VALUE".
std::string alternatives(const CommandTree& command, const std::string& group) {
  std::string out;
  for (const Shape& option : command.options)
    if (option.group == group)
      out += (out.empty() ? "" : " | ") + option.name() +
             (option.takes_value() ? " " + value_of(option) : "");
  return "(" + out + ")";
}

std::string examples_of(const CommandTree& command) {
  return command.example.empty() ? "" : "\nExample:\n  " + command.example + "\n";
}

// --- the whole program ---

std::vector<Row> rows_of_task(const CommandTree& program, std::string_view names,
                              std::set<std::string>& told) {
  std::vector<Row> out;
  for (const std::string& name : split(names))
    if (const CommandTree* command = find(program, name); command && told.insert(name).second)
      out.push_back({name, command->description});
  return out;
}

std::string overview(const CommandTree& program) {
  std::string out = program.description + "\n\nUsage: sinew COMMAND …\n";
  std::set<std::string> told{"help", "completion"};
  const auto add = [&](std::string_view title, const std::vector<Row>& rows,
                       std::string_view example) {
    if (rows.empty()) return;
    out += fmt::format("\n{}:\n{}", title, table(rows, 13));
    if (!example.empty()) out += fmt::format("    {}\n", example);
  };
  for (const Task& task : tasks)
    add(task.title, rows_of_task(program, task.commands, told), task.example);
  std::vector<Row> more;
  for (const CommandTree& command : program.commands)
    if (!told.contains(command.name)) more.push_back({command.name, command.description});
  add("Do more", more, "");
  add("Find your way",
      {{"help COMMAND", "what it takes, with an example"},
       {"help TOPIC", "one of " + names_of_topics()},
       {"completion", "what bash, zsh or fish needs to complete a line of sinew"},
       {"--version", "which Sinew this is"}},
      "sinew help next");
  return out;
}

// --- sinew help ---

std::string all_commands(const CommandTree& command, const std::string& words) {
  std::string out;
  for (const CommandTree& sub : command.commands) {
    const std::string at = words.empty() ? sub.name : words + " " + sub.name;
    out += at + "\n" + all_commands(sub, at);
  }
  return out;
}

// Throws where no command, or topic, is of these words.
[[noreturn]] void refuse_words(const CommandTree& at, const std::string& path,
                               const std::string& word) {
  std::vector<std::string_view> names;
  for (const CommandTree& sub : at.commands) names.push_back(sub.name);
  std::string expected = names.empty() ? "no word behind " + path : config::either(names);
  const std::vector<std::string> topics = topics_of_help();
  if (path == "sinew") {
    names.insert(names.end(), topics.begin(), topics.end());
    expected = "a command, or one of " + names_of_topics();
  }
  config::fail({}, help_command(path), config::in_quotes(word), expected,
               std::string(config::closest(word, names)));
}

// The text of a topic, of all commands, or of none.
std::string shared_page(const std::string& word, const CommandTree& program) {
  if (word == "tables") return about_tables(program);
  return word == "commands" ? all_commands(program, "") : topic(word);
}

ExitCode help(const std::vector<std::string>& words, const CommandTree& program) {
  const std::string page = words.size() == 1 ? shared_page(words[0], program) : "";
  if (!page.empty() && !find(program, words[0])) {
    fmt::print("{}", page);
    return ok;
  }
  const CommandTree* at = &program;
  std::string path = "sinew";
  for (const std::string& word : words) {
    const CommandTree* next = find(*at, word);
    if (!next) refuse_words(*at, path, word);
    at = next;
    path += " " + word;
  }
  fmt::print("{}{}{}", help_of(*at, path), page.empty() ? "" : "\n", page);
  return ok;
}

// A word that is no command is a slip of the line, not of what it asks for.
ExitCode help_or_usage(const std::vector<std::string>& words, const CommandTree& program) {
  try {
    return help(words, program);
  } catch (const config::Error& e) {
    error(e.what());
    return wrong_usage;
  }
}

}  // namespace

std::string usage_of(const CommandTree& command, const std::string& words) {
  std::string out = words;
  if (!command.commands.empty()) return out + " COMMAND …";
  std::set<std::string> groups;
  bool optional = false;
  for (const Shape& option : command.options) {
    if (!option.group.empty()) {
      if (groups.insert(option.group).second) out += " " + alternatives(command, option.group);
    } else if (option.names.empty()) {
      const std::string value = value_of(option);
      out += option.required ? " " + value : " [" + value + "]";
    } else if (option.required) {
      out += " " + option.name() + " " + value_of(option);
    } else {
      optional = optional || option.name() != "--help";
    }
  }
  return optional ? out + " [OPTIONS]" : out;
}

std::string help_of(const CommandTree& command, const std::string& words) {
  if (words == "sinew") return overview(command);
  std::string out =
      fmt::format("{}: {}\n\nUsage: {}\n", words, command.description, usage_of(command, words));
  if (!command.commands.empty()) {
    std::vector<Row> rows;
    for (const CommandTree& sub : command.commands) rows.push_back({sub.name, sub.description});
    out += "\nCommands:\n" + table(rows);
  }
  if (const std::vector<Row> rows = rows_of(command, false); !rows.empty())
    out += "\nWords:\n" + table(rows);
  if (const std::vector<Row> rows = rows_of(command, true); !rows.empty())
    out += "\nOptions:\n" + table(rows);
  return out + names_of_table_options(command) + examples_of(command);
}

std::string help_command(const std::string& words) {
  return "sinew help" + words.substr(std::string_view("sinew").size());
}

std::vector<std::string> with_help_first(std::vector<std::string> words,
                                         const CommandTree& program) {
  if (words.size() < 2 || words.back() != "help") return words;
  const CommandTree* at = &program;
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (!(at = find(*at, words[i]))) return words;
  std::rotate(words.begin(), words.end() - 1, words.end());
  return words;
}

void add_help(Command app, Action& action) {
  auto words = std::make_shared<std::vector<std::string>>();
  Command sub = app.subcommand("help", "what a command takes, or what all of them share",
                               "sinew help identify static\n  sinew help units");
  sub.add_option("WORD", *words, "a command, or a topic");
  sub.callback([=, &action] { action = [=] { return help_or_usage(*words, app.tree()); }; });
}

}  // namespace sinew::cli
