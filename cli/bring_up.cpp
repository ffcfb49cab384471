// cli/bring_up.cpp - `sinew bring-up`: the first day of a machine at the bench.
#include <fmt/format.h>
#include <poll.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "cli/command.h"
#include "cli/emergency.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/bring_up/bring_up.h"
#include "sinew/run/simulation/place.h"

namespace sinew::cli {

namespace {

struct BringUpOptions {
  std::string robot, place, folder;
  std::vector<std::string> sets;
  bool yes = false, clear_fault = false;
};

// False: a signal came first. poll() is ended by one, a read is not.
bool can_read(const Interrupt& interrupt) {
  while (!interrupt.asked()) {
    pollfd in{0, POLLIN, 0};
    if (::poll(&in, 1, -1) > 0) break;
  }
  return !interrupt.asked();
}

std::optional<bool> asked(const std::string& question, bool yes, const Interrupt& interrupt) {
  for (std::string line;;) {
    fmt::print("    {} [y/n] ", question);
    std::fflush(stdout);
    if (yes) {
      fmt::print("y\n");
      return true;
    }
    if (!can_read(interrupt) || !std::getline(std::cin, line)) {
      fmt::print("\n");
      return {};
    }
    if (line == "y" || line == "yes") return true;
    if (line == "n" || line == "no") return false;
  }
}

std::string problem_of_port(const std::string& place) {
  if (std::string problem = run::problem_of_place(place); !problem.empty()) return problem;
  if (!run::is_elsewhere(place) || place.starts_with("comedi:"))
    return "found " + config::in_quotes(place) +
           "; expected a board, serial:DEVICE[@RATE], lock-step:FILE or emulated:FILE: a bring-up "
           "is a board's";
  return "";
}

// A person has to stand at a machine.
void refuse_yes_at_a_machine(const BringUpOptions& o) {
  if (o.yes && o.place.starts_with("serial:"))
    config::fail({"bring-up", 0, 0}, "--yes", "yes to everything at " + o.place,
                 "a person who answers: air may be open and somebody near");
}

ExitCode bring_up(const BringUpOptions& o) {
  refuse_yes_at_a_machine(o);
  const std::filesystem::path robot(o.robot);
  const std::filesystem::path folder =
      o.folder.empty() ? std::filesystem::path("bring-up") / robot.parent_path().filename()
                       : std::filesystem::path(o.folder);
  const experiment::Experiment bench = run::bench_of(o.robot, folder, o.sets);
  std::setvbuf(stdin, nullptr, _IONBF, 0);  // what was typed ahead is still there for poll()
  // From before the board is there until it rests.
  const Interrupt interrupt(Interrupt::Of::machine);
  run::Place place(o.place, bench);
  if (o.clear_fault) place.board()->allow_clearing();
  std::atomic<bool> space{false};
  std::optional<SpaceBar> space_bar;  // while valves move; else keys are answers
  run::BringUp steps(
      bench, o.robot, *place.board(), place.lead(),
      {.tell =
           [](const std::string& line) {
             fmt::print("{}\n", line);
             std::fflush(stdout);
           },
       .ask = [&](const std::string& question) { return asked(question, o.yes, interrupt); },
       .moves =
           [&](bool now) {
             space_bar.reset();
             if (now) space_bar.emplace([&] { space = true; });
           },
       .stops = [&] { return interrupt.asked() || space; }},
      folder);
  return steps.go() ? ok : failed;
}

}  // namespace

void add_bring_up(CLI::App& app, Action& action) {
  auto options = std::make_shared<BringUpOptions>();
  CLI::App& sub = subcommand(app, "bring-up", "a machine's first day at the bench, step by step",
                             "sinew bring-up robots/leg/robot.toml --port serial:/dev/ttyACM0");
  sub.add_option("ROBOT", options->robot, "file of the robot")->required();
  sub.add_option("--port", options->place,
                 "its board: serial:DEVICE[@RATE], lock-step:FILE or emulated:FILE")
      ->required()
      ->transform(passes(problem_of_port));
  sub.add_option("-o,--output", options->folder,
                 "folder of what is done and learned; else bring-up/<robot>");
  add_sets(sub, options->sets);
  sub.add_flag("--clear-fault", options->clear_fault,
               "the board's watchdog or memory fault has been looked into");
  sub.add_flag("--yes", options->yes, "every question is answered with yes: for a simulated bench");
  sub.callback([=, &action] { action = [=] { return bring_up(*options); }; });
}

}  // namespace sinew::cli
