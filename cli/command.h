// cli/command.h - the subcommands: each reads its part of the command line and leaves an action,
// which main() runs once the whole line was understood.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options.h"

namespace sinew::cli {

enum ExitCode { ok = 0, failed = 1, wrong_usage = 2 };

using Action = std::function<ExitCode()>;

void add_run(Command app, Action& action);
void add_analyze(Command app, Action& action);
void add_report(Command app, Action& action);
void add_compare(Command app, Action& action);
void add_export(Command app, Action& action);
void add_import(Command app, Action& action);
void add_replay(Command app, Action& action);
void add_sweep(Command app, Action& action);
void add_tune(Command app, Action& action);
void add_merge(Command app, Action& action);
void add_sensitivity(Command app, Action& action);
void add_show(Command app, Action& action);
void add_keys(Command app, Action& action);
void add_check(Command app, Action& action);
void add_migrate(Command app, Action& action);
void add_actuator(Command app, Action& action);
void add_valve(Command app, Action& action);
void add_kinematics(Command app, Action& action);
void add_identify(Command app, Action& action);
void add_figures(Command app, Action& action);
void add_film(Command app, Action& action);
void add_view(Command app, Action& action);
void add_bring_up(Command app, Action& action);
void add_firmware(Command app, Action& action);
void add_force_beam(Command app, Action& action);
void add_fmu(Command app, Action& action);
void add_doctor(Command app, Action& action);
void add_list(Command app, Action& action);
void add_new(Command app, Action& action);
void add_completion(Command app, Action& action);
void add_help(Command app, Action& action);

// Returns the words of a line. Where they ask a method of `identify` for its columns, they are
// those of `identify columns`, and what else the line says is left out, as `--help` does. The
// option --columns with a value behind it is another matter: a header.
std::vector<std::string> with_columns_first(std::vector<std::string> words);

// `--set key=value`, any number of times; one value each, so that what follows stays what it is.
inline void add_sets(Command sub, std::vector<std::string>& sets) {
  sub.add_option("--set", sets, "a value instead of the file's: key=value; may be repeated")
      .takes_one();
}

}  // namespace sinew::cli
