// cli/options.h - the command line as subcommands describe it. CLI11 understands it, behind
// cli/options.cpp: its header costs every file that includes it five seconds of compiling.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sinew::cli {

// An option, flag or positional argument of a command. A copy is the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required(bool needed = true);
  Option excludes(Option other);
  Option needs(Option other);
  Option is_one_of(std::vector<std::string> words);
  Option is_between(int first, int last);  // both included
  // `wrong` returns what is wrong with a text, "" for nothing.
  Option check(std::function<std::string(const std::string&)> wrong);
  Option takes_one();  // a word each time that it is named
  Option takes_all();  // the words that follow
  Option takes(int least, int most, const std::string& in_the_help);
  Option split_at(char delimiter);
  Option show_default();  // in the help: the variable's value at this moment

  std::string name() const;

 private:
  CLI::Option* option_;
};

// A command as it was described, with those below it: for what is made of descriptions.
struct CommandTree {
  struct Shape {
    std::vector<std::string> names;  // --json, -o; empty: a positional argument
    std::string description;
    std::vector<std::string> choices;  // the only words that it takes, where they are known
    bool takes_value = false;
  };
  std::string name, description;
  std::vector<Shape> options;
  std::vector<CommandTree> commands;
};

// A command with its options, or a group of them. A copy is the same command.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  // A subcommand with its one line of description and the example that ends its help.
  Command subcommand(const std::string& name, const std::string& description,
                     const std::string& example);
  void require_subcommand();
  // Options of which just one is to be given.
  Command one_of(const std::string& group);

  // What the line says goes into `value`, which must outlive the parsing.
  template <class Value>  // those of cli/options.cpp
  Option add_option(const std::string& names, Value& value, const std::string& description);
  Option add_flag(const std::string& names, bool& value, const std::string& description);
  Option option(const std::string& name);  // one that was added

  CommandTree tree() const;

  // `understood` is called once the line was read and has what is required. Where what it says does
  // not go together, it calls refuse.
  void callback(std::function<void()> understood);

 private:
  CLI::App* app_;
};

// These end the program as wrong usage: with the words as they are, or "option: words" …
[[noreturn]] void refuse(const std::string& option, const std::string& words);
// … or "option is required".
[[noreturn]] void require(const std::string& option);

}  // namespace sinew::cli
