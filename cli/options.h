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
  Option once();       // one word, of what takes several
  Option takes_all();  // the words that follow
  Option takes(int least, int most, const std::string& in_the_help);
  Option split_at(char delimiter);
  Option show_default();                     // in the help: the variable's value at this moment
  Option under(const std::string& heading);  // in the help, which otherwise has it under Options

  std::string name() const;

 private:
  CLI::Option* option_;
};

// A command as it was described, with those below it: for what is made of descriptions.
struct CommandTree {
  struct Shape {
    std::vector<std::string> names;  // --json, -o; empty: a word without one
    std::string value;               // what stands in its place in the help: FILE, N
    std::string description;
    std::vector<std::string> choices;  // the only words that it takes, where they are known
    std::string default_text;          // empty: none that the help tells
    std::string group;                 // of this group just one is to be given; empty: none
    std::string heading;               // in the help; empty: that of all options
    int least = 0, most = 0;           // how many words follow it, 0 for a flag; `many` for any
    bool required = false;
    bool repeats = false;  // may be named several times

    bool takes_value() const { return most > 0; }
    std::string name() const;  // --json; FILE where it has none
  };
  static constexpr int many = 1000;

  std::string name, description;
  std::string example;  // one line, or several with two blanks before each but the first
  std::vector<Shape> options;
  std::vector<CommandTree> commands;
};

// Returns the words of a choice, "fill, vent or both"; in quotes where one has a blank or is a
// mark.
std::string either_of(const std::vector<std::string>& choices);

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

  // What --help says of it and of those below it: `help` of its tree and of the words that lead to
  // it, "sinew identify static".
  using Help = std::function<std::string(const CommandTree&, const std::string& words)>;
  void shows_help(Help help);

  // `understood` is called once the line was read and has what is required. Where what it says does
  // not go together, it calls refuse.
  void callback(std::function<void()> understood);

 private:
  CLI::App* app_;
};

// These end the program as wrong usage: "option: found …; expected …" …
[[noreturn]] void refuse(const std::string& option, const std::string& found,
                         const std::string& expected);
// … or, of what is not there, "option: missing; expected …".
[[noreturn]] void require(const std::string& option, const std::string& expected);

}  // namespace sinew::cli
