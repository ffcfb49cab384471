// cli/firmware.cpp - `sinew firmware`: the program of a robot's board.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/bring_up/firmware.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct FirmwareOptions {
  std::string robot, board, out, sources = ".";
  bool force = false;
};

std::string names_of_boards() {
  std::string out;
  for (const run::FirmwareBoard& b : run::firmware_boards())
    out += (out.empty() ? "" : ", ") + std::string(b.name);
  return out;
}

void print_flash(const run::FirmwareBoard& board, const std::string& file) {
  const std::string command = run::flash_command(board, file);
  fmt::print("{}\n", command.empty() ? fmt::format("sinew run EXPERIMENT --port {}",
                                                   run::shell_word("emulated:" + file))
                                     : command);
}

ExitCode build(const FirmwareOptions& o) {
  const run::FirmwareBoard& board = run::firmware_board(o.board);
  run::require_fits(o.robot, board);
  const bool low = run::low_gives_current(o.robot);
  run::build_firmware(o.sources, board, o.out, low, o.force);
  Messages(false).note(
      fmt::format("built {}, whose outputs are {} where a coil has current; onto the board with",
                  o.out, low ? "0, as wiring.polarity says," : "1"));
  print_flash(board, o.out);
  return ok;
}

ExitCode wiring(const FirmwareOptions& o) {
  run::refuse_to_overwrite(o.out, o.force, {o.robot}, ".svg");
  run::write_file(o.out, run::wiring_on(o.robot, run::firmware_board(o.board)));
  return ok;
}

}  // namespace

void add_firmware(CLI::App& app, Action& action) {
  auto o = std::make_shared<FirmwareOptions>();
  CLI::App& group = subcommand(app, "firmware", "the program of a robot's board",
                               "sinew firmware build robots/leg/robot.toml stm32f405 -o leg.elf");
  group.require_subcommand();
  CLI::App& made = subcommand(group, "build", "does the robot fit on the board, and its program",
                              "sinew firmware build robots/leg/robot.toml stm32f405 -o leg.elf");
  made.add_option("ROBOT", o->robot, "file of the robot")->required();
  made.add_option("BOARD", o->board, names_of_boards())->required();
  made.add_option("-o,--output", o->out, "FILE.elf, FILE.hex or FILE.bin")->required();
  made.add_option("--sources", o->sources, "folder of Sinew's sources; else this one");
  made.add_flag("--force", o->force, "replace the file");
  made.callback([=, &action] { action = [=] { return build(*o); }; });
  CLI::App& drawn = subcommand(group, "wiring", "which wire goes to which pin, as a picture",
                               "sinew firmware wiring robots/leg/robot.toml teensy41 -o leg.svg");
  drawn.add_option("ROBOT", o->robot, "file of the robot")->required();
  drawn.add_option("BOARD", o->board, names_of_boards())->required();
  drawn.add_option("-o,--output", o->out, "FILE.svg")->required();
  drawn.add_flag("--force", o->force, "replace the file");
  drawn.callback([=, &action] { action = [=] { return wiring(*o); }; });
  CLI::App& flash = subcommand(group, "flash", "shows the command that brings a file onto a board",
                               "sinew firmware flash stm32f405 leg.elf");
  flash.add_option("BOARD", o->board, names_of_boards())->required();
  flash.add_option("FILE", o->out, "what was built")->required();
  flash.callback([=, &action] {
    action = [=] {
      const run::FirmwareBoard& board = run::firmware_board(o->board);
      if (!std::filesystem::is_regular_file(o->out))
        config::fail({o->out, 0, 0}, "", "no such file", "what sinew firmware build has made");
      print_flash(board, o->out);
      return ok;
    };
  });
}

}  // namespace sinew::cli
