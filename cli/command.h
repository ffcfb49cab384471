// cli/command.h - the subcommands: each reads its part of the command line and leaves an action,
// which main() runs once the whole line was understood.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace sinew::cli {

enum ExitCode { ok = 0, failed = 1, wrong_usage = 2 };

using Action = std::function<ExitCode()>;

void add_run(CLI::App& app, Action& action);
void add_analyze(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_import(CLI::App& app, Action& action);
void add_replay(CLI::App& app, Action& action);
void add_sweep(CLI::App& app, Action& action);
void add_show(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_actuator(CLI::App& app, Action& action);
void add_valve(CLI::App& app, Action& action);
void add_kinematics(CLI::App& app, Action& action);
void add_identify(CLI::App& app, Action& action);
void add_figures(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_force_beam(CLI::App& app, Action& action);

// A subcommand with its one line of description and the example that ends its help.
inline CLI::App& subcommand(CLI::App& app, const std::string& name, const std::string& description,
                            const std::string& example) {
  CLI::App& sub = *app.add_subcommand(name, description);
  sub.footer("Example:\n  " + example);
  return sub;
}

// `--set key=value`, any number of times; one value each, so that what follows stays what it is.
inline void add_sets(CLI::App& sub, std::vector<std::string>& sets) {
  sub.add_option("--set", sets, "a value instead of the file's: key=value; may be repeated")
      ->allow_extra_args(false);
}

}  // namespace sinew::cli
