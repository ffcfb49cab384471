// cli/hardware.cpp - commands for boards and other programs: doctor, bring-up, firmware and fmu.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "fmu/export/export.h"
#include "sinew/card/walk.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/shipped.h"
#include "sinew/experiment/experiment.h"
#include "sinew/host/doctor.h"
#include "sinew/host/realtime.h"
#include "sinew/run/bring_up/bring_up.h"
#include "sinew/run/bring_up/firmware.h"
#include "sinew/run/bring_up/wires.h"
#include "sinew/run/card/on_card.h"
#include "sinew/run/card/speed.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/simulation/place.h"
#include "sinew/units/shell.h"

namespace sinew::cli {

namespace {

// --- doctor ---

struct DoctorOptions {
  std::string place = "simulated";
  bool json = false;
};

// Returns nothing without the shipped experiments.
std::optional<double> walks_per_second(const card::Properties& properties) {
  std::optional<experiment::Experiment> walk;
  try {
    walk = experiment::load((config::shipped_folder() / "experiments/walk-test-1.toml").string());
  } catch (const config::Error&) {
    return {};
  }
  run::Card card(properties);
  return run::runs_per_second(card, *walk);
}

ExitCode examine(const DoctorOptions& options) {
  const auto measure = [] {
    const host::RealTime as_in_the_loop;
    return host::measure_latency(1);
  };
  const std::vector<host::Finding> findings = host::examine({
      .latency = measure,
      .cards = card::list,
      .has_card_program = !card::walk_ptx().empty(),
      .card_speed = walks_per_second,
  });
  if (options.json)
    fmt::print("{}\n", host::json_of(findings, options.place).text(2));
  else
    fmt::print("{}", host::text_of(findings, output_has_color()));
  if (host::is_ready(findings, options.place)) return ok;
  error(fmt::format("{}: something that it needs is missing; what to do is above", options.place));
  return failed;
}

// --- bring-up ---

struct BringUpOptions {
  std::string robot, place, folder;
  std::vector<std::string> sets;
  bool yes = false, clear_fault = false;
};

// Returns false if a signal comes first. A signal ends poll(), but not a read.
bool can_read(const Interrupt& interrupt) {
  while (!interrupt.requested()) {
    pollfd in{0, POLLIN, 0};
    if (::poll(&in, 1, -1) > 0) break;
  }
  return !interrupt.requested();
}

std::optional<bool> confirmed(const std::string& question, bool yes, const Interrupt& interrupt) {
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
  if (!run::is_outside_simulation(place) || place.starts_with("comedi:"))
    return "found " + config::in_quotes(place) +
           "; expected a board, serial:DEVICE[@RATE], lock-step:FILE or emulated:FILE: a bring-up "
           "is a board's";
  return "";
}

ExitCode bring_up(const BringUpOptions& o) {
  if (o.yes && o.place.starts_with("serial:"))
    config::fail({"bring-up", 0, 0}, "--yes", "yes to everything at " + o.place,
                 "an operator at the keyboard: air may be open and persons near");
  const std::filesystem::path robot(o.robot);
  const std::filesystem::path folder =
      o.folder.empty() ? std::filesystem::path("bring-up") / robot.parent_path().filename()
                       : std::filesystem::path(o.folder);
  const experiment::Experiment bench = run::bench_of(o.robot, folder, o.sets);
  std::setvbuf(stdin, nullptr, _IONBF, 0);  // so that poll() sees input that was typed ahead
  // Exists before the board is opened and until the machine rests.
  const Interrupt interrupt(Interrupt::Of::machine);
  run::Place place(o.place, bench);
  if (o.clear_fault) place.board()->allow_clearing();
  std::atomic<bool> space{false};
  std::optional<SpaceBar> space_bar;  // while valves move; else keys are replies
  run::BringUp steps(
      bench, o.robot, *place.board(), place.lead(),
      {.inform =
           [](const std::string& line) {
             fmt::print("{}\n", line);
             std::fflush(stdout);
           },
       .confirm =
           [&](const std::string& question) { return confirmed(question, o.yes, interrupt); },
       .moves =
           [&](bool now) {
             space_bar.reset();
             if (now) space_bar.emplace([&] { space = true; });
           },
       .stops = [&] { return interrupt.requested() || space; }},
      folder);
  return steps.go() ? ok : failed;
}

// --- firmware ---

struct FirmwareOptions {
  std::string robot, board, out, sources = ".";
  bool force = false;
};

std::string names_of_boards() {
  return fmt::format("{}", fmt::join(config::names_of(run::firmware_boards()), ", "));
}

void print_flash(const run::FirmwareBoard& board, const std::string& file) {
  const std::string command = run::flash_command(board, file);
  fmt::print("{}\n", command.empty() ? fmt::format("sinew run EXPERIMENT --port {}",
                                                   units::shell_word("emulated:" + file))
                                     : command);
}

ExitCode build(const FirmwareOptions& o) {
  const run::FirmwareBoard& board = run::firmware_board(o.board);
  run::require_fits(o.robot, board);
  const bool low = run::low_gives_current(o.robot);
  run::build_firmware(o.sources, board, o.out, low, o.force);
  Messages(false).note(
      fmt::format("built {}, whose outputs are {} where a coil has current; onto the board with",
                  o.out, low ? "0, by wiring.polarity," : "1"));
  print_flash(board, o.out);
  return ok;
}

ExitCode flash(const FirmwareOptions& o) {
  const run::FirmwareBoard& board = run::firmware_board(o.board);
  if (!std::filesystem::is_regular_file(o.out))
    config::fail({o.out, 0, 0}, "", "no such file", "what sinew firmware build has made");
  print_flash(board, o.out);
  return ok;
}

ExitCode wiring(const FirmwareOptions& o) {
  run::refuse_to_overwrite(o.out, o.force, run::wiring_kind, {o.robot});
  run::write_file(o.out, run::wiring_on(o.robot, run::firmware_board(o.board)));
  return ok;
}

// --- fmu ---

struct FmuOptions {
  fmu::ExportRequest request;
  std::string out;
  bool force = false, json = false;
};

ExitCode export_fmu(const FmuOptions& options) {
  const fmu::Fmu made = fmu::make_fmu(options.request);
  const std::string file = options.out.empty() ? made.identifier + ".fmu" : options.out;
  run::refuse_to_overwrite(file, options.force, run::fmu_kind, {options.request.file});
  run::write_file(file, made.bytes);
  fmt::print("{}", options.json ? fmu::json_of(made, file) : fmu::text_of(made, file));
  return ok;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "doctor", "Check if this computer is ready to drive a machine",
                             "sinew doctor --for comedi");
  DoctorOptions& options = runs(sub, action, examine);
  sub.add_option("--for", options.place,
                 "kind of port to drive; exits with 1 if something that it needs is missing")
      ->check(one_of({"simulated", "serial", "emulated", "comedi"}))
      ->capture_default_str();
  sub.add_flag("--json", options.json, "print the findings as JSON");
}

void add_bring_up(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "bring-up", "Bring up a new machine at the bench, step by step",
                             "sinew bring-up robots/leg/robot.toml --port serial:/dev/ttyACM0");
  BringUpOptions& options = runs(sub, action, bring_up);
  sub.add_option("ROBOT", options.robot, "robot file")->required();
  sub.add_option("--port", options.place,
                 "PLACE: board of the robot: serial:DEVICE[@RATE], lock-step:FILE or emulated:FILE")
      ->required()
      ->transform(passes(problem_of_port));
  sub.add_option("-o,--output", options.folder, "DIR: results folder; default: bring-up/<robot>");
  add_sets(sub, options.sets);
  sub.add_flag("--clear-fault", options.clear_fault,
               "clear the board's watchdog or memory fault; find the cause first");
  sub.add_flag("--yes", options.yes, "confirm every question, for a simulated bench");
}

void add_firmware(CLI::App& app, Action& action) {
  CLI::App& group = subcommand(app, "firmware", "Build a board's program and draw its wiring",
                               "sinew firmware build robots/leg/robot.toml stm32f405 -o leg.elf");
  group.require_subcommand();
  const auto add = [&](CLI::App& sub, FirmwareOptions& o, const char* files) {
    sub.add_option("ROBOT", o.robot, "robot file")->required();
    sub.add_option("BOARD", o.board, names_of_boards())->required();
    sub.add_option("-o,--output", o.out, files)->required();
    sub.add_flag("--force", o.force, "replace an existing file");
  };
  CLI::App& made = subcommand(group, "build", "Build a board's program if the robot fits on it",
                              "sinew firmware build robots/leg/robot.toml stm32f405 -o leg.elf");
  FirmwareOptions& program = runs(made, action, build);
  add(made, program, "FILE: .elf, .hex or .bin file to write");
  made.add_option("--sources", program.sources,
                  "DIR: folder of Sinew's sources; default: this one");
  CLI::App& drawn = subcommand(group, "wiring", "Draw which wire goes to which pin",
                               "sinew firmware wiring robots/leg/robot.toml teensy41 -o leg.svg");
  add(drawn, runs(drawn, action, wiring), "FILE: .svg file to write");
  CLI::App& flashed =
      subcommand(group, "flash", "Print the command that brings a program to a board",
                 "sinew firmware flash stm32f405 leg.elf");
  FirmwareOptions& o = runs(flashed, action, flash);
  flashed.add_option("BOARD", o.board, names_of_boards())->required();
  flashed.add_option("FILE", o.out, "program that sinew firmware build has made")->required();
}

void add_fmu(CLI::App& app, Action& action) {
  CLI::App& fmu = subcommand(app, "fmu", "Export FMUs for co-simulation in other programs",
                             "sinew fmu export robots/leg/robot.toml --muscle hip_flexor");
  fmu.require_subcommand();
  CLI::App& sub =
      subcommand(fmu, "export",
                 "Export an actuator, a muscle with valves, joints with muscles, or a machine with "
                 "its controllers as an FMU",
                 "sinew fmu export experiments/walk-test-1.toml --input control.stiffness.knee "
                 "--output /joint/knee/angle --output /trolley/position -o leg.fmu");
  FmuOptions& options = runs(sub, action, export_fmu);
  fmu::ExportRequest& request = options.request;
  sub.add_option("FILE", request.file,
                 "file to export: actuator (a tube), rig (its muscle), robot (its joints) or "
                 "experiment (the machine with its controllers)")
      ->required();
  sub.add_option("-o,--out", options.out, "FILE: FMU to write; default: NAME.fmu in this folder");
  sub.add_flag("--force", options.force, "replace an existing file");
  sub.add_option("--muscle", request.muscle, "NAME: export only this muscle, with its valves");
  sub.add_flag("--without-valves", request.without_valves, "make the muscle's pressure an input");
  add_words(sub, "--joint", request.joints, "NAME: export this joint with its muscles");
  sub.add_option("--actuator", request.actuator, "NAME: actuator, where the file has several");
  add_words(sub, "--input", request.inputs, "KEY: setting as an input, control.stiffness.JOINT");
  add_words(sub, "--output", request.outputs, "CHANNEL: channel as an output; default: all");
  add_words(sub, "--parameter", request.parameters, "KEY: value that an importer may set");
  sub.add_option("--fmi", request.version, "version of FMI")
      ->transform(between(2, 3))
      ->capture_default_str();
  sub.add_option("--name", request.name, "NAME: model name; default: by file, muscle or joints");
  add_sets(sub, request.sets);
  sub.add_flag("--json", options.json, "print what was written as JSON");
}

}  // namespace sinew::cli
