// cli/main.cpp - the program `sinew`: reads the command line and runs one subcommand.
//
// Results go to stdout, everything else to stderr. Exit codes: 0 done, 1 failed, 2 wrong usage;
// a wrong value of an option is wrong usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "sinew/config/changes.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/shipped.h"
#include "sinew/config/shown_units.h"
#include "sinew/units/shell.h"

namespace {

using namespace sinew;
using namespace sinew::cli;

// Returns the error's text. For a robot in place of an experiment, or an experiment in place of a
// tuning, it names the command that makes one from the other; the library has no commands.
std::string message_of(const std::exception& e) {
  const auto* file = dynamic_cast<const config::Error*>(&e);
  if (!file || file->problems().size() != 1) return e.what();
  config::Problem p = file->problems()[0];
  for (const auto& [from, to] : {std::pair{"robot", "experiment"}, {"experiment", "tuning"}})
    if (p.key == "format" && p.found == config::in_quotes(from) &&
        p.expected == config::in_quotes(config::newest_format(to)))
      p.try_this = fmt::format("sinew new {} NAME --of {}", to, units::shell_word(p.where.file));
  return config::to_text(p);
}

// Returns whether the command that the line names shows numbers in chosen units.
bool shows_units(const CLI::App& app) {
  for (const CLI::App* sub : app.get_subcommands())
    if (sub->get_option_no_throw("--units") || shows_units(*sub)) return true;
  return false;
}

ExitCode run_safely(const CLI::App& app, const Action& action) {
  try {
    // Wrong units of the environment and of the user's settings are refused before the work begins.
    if (shows_units(app)) (void)config::units_to_show({});
    const ExitCode code = action();
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    error("stdout: cannot write the result; make room or choose another place");
  } catch (const std::exception& e) {
    std::fflush(stdout);
    error(message_of(e));
    if (is_of_option(e)) return wrong_usage;
  }
  return failed;
}

// The commands, in the order of `sinew help commands`.
struct Entry {
  std::string_view name;
  Add* add;
};
// clang-format off
constexpr Entry commands[] = {
  {"run", add_run},                 {"analyze", add_analyze},         {"report", add_report},
  {"view", add_view},               {"bring-up", add_bring_up},       {"firmware", add_firmware},
  {"compare", add_compare},         {"export", add_export},           {"import", add_import},
  {"replay", add_replay},           {"sweep", add_sweep},             {"tune", add_tune},
  {"merge", add_merge},             {"sensitivity", add_sensitivity}, {"show", add_show},
  {"keys", add_keys},               {"check", add_check},             {"migrate", add_migrate},
  {"actuator", add_actuator},       {"valve", add_valve},             {"kinematics", add_kinematics},
  {"identify", add_identify},       {"figures", add_figures},         {"film", add_film},
  {"fmu", add_fmu},                 {"force-beam", add_force_beam},   {"doctor", add_doctor},
  {"list", add_list},               {"new", add_new},                 {"completion", add_completion},
  {"help", add_help},               {"design", add_design},
};
// clang-format on

// The description of the command line, with all commands or only one.
struct Program {
  CLI::App app{
      "Sinew simulates, identifies, tunes and controls robots with braided pneumatic muscles."};
  Action action;  // given by the parsed line

  explicit Program(std::string_view only = "") {
    app.set_version_flag("--version", std::string("sinew ") + SINEW_VERSION);
    app.set_help_flag("-h,--help", "print this help");
    app.require_subcommand(1);
    app.formatter(std::make_shared<Help>());
    for (const Entry& entry : commands)
      if (only.empty() || entry.name == only) entry.add(app, action);
    complete_description(app);
  }
  Program(const Program&) = delete;  // the commands hold references to `action`

  // Throws CLI::ParseError if the words are not understood, or request the help or the version.
  void parse(std::vector<std::string> words) {
    words = with_help_first(std::move(words), app);
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  }
};

// Returns the command that the line names first if the line can only need the options of that
// command, else "". Adding the options of all commands takes 12 ms, as long as a short command
// runs.
std::string_view only_command(const std::vector<std::string>& words) {
  if (words.empty() || words.back() == "help") return "";
  const auto it = std::ranges::find(commands, words.front(), &Entry::name);
  return it == std::end(commands) || it->name == "help" || it->name == "completion" ? "" : it->name;
}

// Returns the words of a line with names that help and `sinew list` show, such as
// "experiments/walk-test-1.toml", as paths of Sinew's own files, where the current folder has no
// file of that name. A file that a command writes keeps its name: the value of an option in
// `written`, and the words of `new` and `migrate`.
std::vector<std::string> with_shipped_files(std::vector<std::string> words) {
  constexpr std::string_view kept[] = {"new", "migrate", "help", "completion"};
  constexpr std::string_view written[] = {
      "-o",        "--output", "--out",          "--report",       "--residuals",   "--runs",
      "--results", "--best",   "--save-mapping", "--actuator-out", "--predict-dat", "--template"};
  if (words.empty() || std::ranges::find(kept, words[0]) != std::end(kept)) return words;
  for (std::size_t i = 1; i < words.size(); ++i)
    if (std::ranges::find(written, words[i - 1]) == std::end(written))
      words[i] = config::or_shipped(words[i]);
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_streams();
  survive_file_limits();
  const std::vector<std::string> words =
      with_shipped_files(std::vector<std::string>(argv + 1, argv + argc));
  Program program(only_command(words));
  try {
    program.parse(words);
    return run_safely(program.app, program.action);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.app.exit(e);
  }
  // The message names other commands with that option, and therefore needs all commands.
  Program whole;
  try {
    whole.parse(words);
    return run_safely(whole.app, whole.action);
  } catch (const CLI::ParseError& e) {
    error_in_words(problems_of_line(whole.app, e));
    return wrong_usage;
  }
}
