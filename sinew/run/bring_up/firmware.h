// run/bring_up/firmware.h - the program of a robot's board: does the robot fit on it, how it is
// built, and by what command it gets there.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace sinew::run {

// A board of firmware/boards.
struct FirmwareBoard {
  const char* name;
  const char* what;
  std::size_t inputs, outputs;  // that its pins have
  const char* flash;            // command line, with {file}; empty: it only runs in an emulator
  const char* form;             // ".hex", if the command takes no other; empty: any
};
std::span<const FirmwareBoard> firmware_boards();

// Throws config::Error for a board that is not there, with those that are.
const FirmwareBoard& firmware_board(const std::string& name);

// Throws config::Error where the robot's low level does not fit on the board: too many sensors or
// valves, several boards, telemetry that its line does not carry.
void require_fits(const std::string& robot, const FirmwareBoard& board);

// Returns which wire goes where on such a board, as a picture (wires.h). Throws as
// require_fits() does.
std::string wiring_on(const std::string& robot, const FirmwareBoard& board);

// Returns whether 0 at an output gives a coil current: what the robot's wiring says; false, where
// it has none. Throws config::Error for a robot that cannot be read.
bool low_gives_current(const std::string& robot);

// Builds the board's program from Sinew's sources, into `out`, for that level of its outputs;
// ".bin" is the bare memory, ".hex" an Intel HEX file, anything else an ELF file. Throws
// config::Error where the sources or the compiler are missing, where `out` is there already or the
// board is not loaded with such a file, and std::runtime_error with the compiler's last words.
void build_firmware(const std::filesystem::path& sources, const FirmwareBoard& board,
                    const std::filesystem::path& out, bool low_gives_current, bool force);

// Returns the word as a shell takes it: in quotes where it has to be.
std::string shell_word(const std::string& word);

// Returns the command line that brings the file onto the board, as a shell takes it. Throws
// config::Error for a form of file that the command does not take.
std::string flash_command(const FirmwareBoard& board, const std::filesystem::path& file);

}  // namespace sinew::run
