// cli/command.h - subcommands of the program. Each adds its options to the command line and leaves
// an action, which main() runs once the whole line is understood.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::cli {

enum ExitCode { ok = 0, failed = 1, wrong_usage = 2 };

using Action = std::function<ExitCode()>;

// Adds a command to the program.
using Add = void(CLI::App& app, Action& action);
Add add_run, add_analyze, add_report, add_compare, add_export, add_import, add_replay, add_sweep,
    add_tune, add_merge, add_sensitivity, add_show, add_keys, add_check, add_migrate, add_actuator,
    add_valve, add_kinematics, add_design, add_identify, add_figures, add_film, add_view,
    add_bring_up, add_firmware, add_force_beam, add_fmu, add_doctor, add_list, add_new,
    add_completion, add_help;

// Returns a new subcommand of `app` with its one line of description and the example that ends its
// help: one line, or several with two blanks before each but the first.
CLI::App& subcommand(CLI::App& app, std::string_view name, std::string_view description,
                     std::string_view example);

// Makes `run` the action of a command and returns its options, which live as long as the action.
template <class Options>
Options& runs(CLI::App& sub, Action& action, ExitCode (*run)(const Options&)) {
  auto options = std::make_shared<Options>();
  sub.callback([options, run, &action] { action = [options, run] { return run(*options); }; });
  return *options;
}

// --force, --json and --quiet. Options without a description are not added.
struct Flags {
  bool force = false, json = false, quiet = false;
};
void add_flags(CLI::App& sub, Flags& flags, const char* force, const char* json,
               const char* quiet = "print only errors to stderr");

// Returns a group of options of which just one is to be given.
CLI::App& alternatives(CLI::App& sub, const std::string& name);

// Checks of a value: option->check(one_of({"fill", "vent"})), option->transform(between(1, 8)).
// `wrong` returns what is wrong with a text, "" for nothing, or throws config::Error.
CLI::Validator one_of(const std::vector<std::string>& words);
CLI::Validator between(int first, int last);  // whole numbers, both included
CLI::Validator passes(std::function<std::string(const std::string&)> wrong);

// Adds an option that may be named any number of times; one value each, so that the next word is
// not taken for a value.
inline void add_words(CLI::App& sub, const std::string& name, std::vector<std::string>& words,
                      const std::string& description) {
  sub.add_option(name, words, description)->allow_extra_args(false);
}

// Adds `--set key=value`, each key once.
void add_sets(CLI::App& sub, std::vector<std::string>& sets);

// Completes the description once all options are added: values are named VALUE, NUMBER or N in the
// help, and text that is not a number is refused in messages of this program.
void complete_description(CLI::App& app);

// End the program as wrong usage: "option: found …; expected …", or of a missing option "option:
// missing; expected …".
[[noreturn]] void refuse(const std::string& option, const std::string& found,
                         const std::string& expected);
[[noreturn]] void require(const std::string& option, const std::string& expected);

// --- a description, read again for help, messages and completion ---

std::vector<const CLI::App*> commands_of(const CLI::App& app);
const CLI::App* find_command(const CLI::App& app, const std::string& name);  // null: none

// Return groups of options of which one is given, and all options of a command, theirs included. An
// option of the heading "" is hidden.
std::vector<const CLI::App*> groups_of(const CLI::App& app);
std::vector<const CLI::Option*> options_of(const CLI::App& app);

// Returns "-o" and "--output"; nothing for an argument that is no option.
std::vector<std::string> names_of(const CLI::Option& option);

// Returns the words of one_of(); nothing where any text may be given.
std::vector<std::string> choices_of(const CLI::Option& option);

// Returns "fill, vent or both"; each in quotes where one of them has a blank or is a mark.
std::string either_of(const std::vector<std::string>& choices);

inline bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// Returns whether an option that takes one word may be named again for the next.
inline bool is_repeated(const CLI::Option& option) {
  return option.get_items_expected_max() >= CLI::detail::expected_max_vector_size &&
         !option.get_allow_extra_args();
}

// Returns the words that lead to a command, "sinew identify static".
std::string words_to(const CLI::App& app);

}  // namespace sinew::cli
