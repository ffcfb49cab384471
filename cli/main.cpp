// cli/main.cpp - the program `sinew`: understands the command line and runs one subcommand.
//
// Results go to stdout, everything else to stderr. Exit codes: 0 done, 1 failed, 2 wrong usage, to
// which a wrong value behind an option belongs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/identify_columns.h"
#include "cli/interrupt.h"
#include "cli/settings.h"
#include "cli/terminal.h"
#include "cli/usage.h"

namespace {

using namespace sinew;

cli::ExitCode run_safely(const cli::Action& action) {
  try {
    const cli::ExitCode code = action();
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    cli::error("stdout: cannot write the result; make room or choose another place");
  } catch (const std::exception& e) {
    std::fflush(stdout);
    cli::error(e.what());
    if (cli::is_of_option(e)) return cli::wrong_usage;
  }
  return cli::failed;
}

}  // namespace

int main(int argc, char** argv) {
  cli::fill_closed_streams();
  cli::survive_file_limits();
  CLI::App app(
      "Sinew simulates, identifies, tunes and controls robots with braided pneumatic muscles.");
  app.set_version_flag("--version", std::string("sinew ") + SINEW_VERSION);
  app.set_help_flag("-h,--help", "this text");
  app.require_subcommand(1);

  cli::Command command(app);
  command.shows_help(cli::help_of);
  cli::Action action;
  cli::add_run(command, action);
  cli::add_analyze(command, action);
  cli::add_report(command, action);
  cli::add_view(command, action);
  cli::add_bring_up(command, action);
  cli::add_firmware(command, action);
  cli::add_compare(command, action);
  cli::add_export(command, action);
  cli::add_import(command, action);
  cli::add_replay(command, action);
  cli::add_sweep(command, action);
  cli::add_tune(command, action);
  cli::add_merge(command, action);
  cli::add_sensitivity(command, action);
  cli::add_show(command, action);
  cli::add_keys(command, action);
  cli::add_check(command, action);
  cli::add_migrate(command, action);
  cli::add_actuator(command, action);
  cli::add_valve(command, action);
  cli::add_kinematics(command, action);
  cli::add_identify(command, action);
  cli::add_figures(command, action);
  cli::add_film(command, action);
  cli::add_fmu(command, action);
  cli::add_force_beam(command, action);
  cli::add_doctor(command, action);
  cli::add_list(command, action);
  cli::add_new(command, action);
  cli::add_completion(command, action);
  cli::add_help(command, action);

  try {
    std::vector<std::string> words(argv + 1, argv + argc);
    words = cli::with_help_first(std::move(words), command.tree());
    words = cli::with_columns_first(std::move(words));
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    cli::error(cli::problems_of_line(app, e));
    return cli::wrong_usage;
  }
  return run_safely(action);
}
