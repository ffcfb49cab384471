// cli/main.cpp - the program `sinew`: understands the command line and runs one subcommand.
//
// Results go to stdout, everything else to stderr. Exit codes: 0 done, 1 failed, 2 wrong usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <vector>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"

namespace {

using namespace sinew;

// "sinew rnu": the word that was probably meant.
void suggest_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  const std::string_view near =
      config::closest(argv[1], std::vector<std::string_view>(names.begin(), names.end()));
  if (near.empty() || near == argv[1]) return;
  cli::error(fmt::format("no subcommand \"{}\"; did you mean {}?", argv[1], near));
}

cli::ExitCode run_safely(const cli::Action& action) {
  try {
    const cli::ExitCode code = action();
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    cli::error("stdout: cannot write the result; make room or choose another place");
  } catch (const std::exception& e) {
    std::fflush(stdout);
    cli::error(e.what());
  }
  return cli::failed;
}

}  // namespace

int main(int argc, char** argv) {
  cli::fill_closed_streams();
  cli::survive_file_limits();
  CLI::App app("Sinew: robots driven by braided pneumatic actuators.");
  app.set_version_flag("--version", std::string("sinew ") + SINEW_VERSION);
  app.require_subcommand(1);
  app.footer("Example:\n  sinew run experiments/walk-test-1.toml");

  const cli::Command command(app);
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

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    if (code == 0) return cli::ok;
    suggest_command(app, argc, argv);
    return cli::wrong_usage;
  }
  return run_safely(action);
}
