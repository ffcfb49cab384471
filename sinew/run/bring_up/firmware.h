// run/bring_up/firmware.h - the firmware of a robot's board: check that the robot fits on it,
// build, and the command that flashes it.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace sinew::run {

// A board of firmware/boards.
struct FirmwareBoard {
  const char* name;
  const char* what;
  std::size_t inputs, outputs;  // number of its pins
  const char* flash;            // command line, with {file}; empty: it runs in an emulator only
  const char* form;             // ".hex" if the command requires such a file; empty: any
};
std::span<const FirmwareBoard> firmware_boards();

// Returns the board of this name. Throws config::Error, with the known names, if it does not exist.
const FirmwareBoard& firmware_board(const std::string& name);

// Throws config::Error if the robot's joint controller does not fit on the board: too many sensors
// or valves, several boards, pressure regulators, or more telemetry than its line carries.
void require_fits(const std::string& robot, const FirmwareBoard& board);

// Returns a drawing of the wiring on such a board (wires.h). Throws like require_fits().
std::string wiring_on(const std::string& robot, const FirmwareBoard& board);

// Returns whether 0 at an output gives a coil current, as the robot's [wiring] states; false if it
// has no [wiring]. Throws config::Error if the robot cannot be read.
bool low_gives_current(const std::string& robot);

// Builds the board's program from Sinew's sources into `out`, with that level of its outputs. The
// extension ".bin" gives the bare memory, ".hex" an Intel HEX file, any other an ELF file. Throws
// config::Error if the sources or the compiler are missing, if `out` exists and `force` is false,
// or if the board cannot be loaded with such a file, and std::runtime_error with the last lines of
// the compiler's output.
void build_firmware(const std::filesystem::path& sources, const FirmwareBoard& board,
                    const std::filesystem::path& out, bool low_gives_current, bool force);

// Returns the shell command that loads the file onto the board. Throws config::Error if the command
// does not accept this form of file.
std::string flash_command(const FirmwareBoard& board, const std::filesystem::path& file);

}  // namespace sinew::run
