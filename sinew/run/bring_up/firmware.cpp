#include "sinew/run/bring_up/firmware.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/control/link/baud.h"
#include "sinew/control/setup/boards.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/host/temporary_folder.h"
#include "sinew/run/bring_up/wires.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/setup/installation.h"
#include "sinew/units/shell.h"

namespace sinew::run {

namespace fs = std::filesystem;

using units::is_plain_word, units::shell_word;

namespace {

constexpr std::uint32_t line_rate = 921'600;  // [bits/s], for every board

constexpr FirmwareBoard boards[] = {
    {"mps2-an386", "Arm's MPS2 with image AN386, in an emulator", 32, 32, "", ""},
    {"stm32f405", "a board with an STM32F405RG and a crystal of 8 MHz", 14, 16,
     "openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c \"program {file} verify reset "
     "exit\"",
     ""},
    {"teensy41", "PJRC's Teensy 4.1, an i.MX RT1062", 14, 16,
     "teensy_loader_cli -mmcu=TEENSY41 -w -v {file}", ".hex"},
};

// A temporary folder, removed by the destructor.
struct Workshop {
  Workshop() : path(host::make_temporary_folder("sinew-firmware")) {}
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  std::string path;
};

std::string last_lines(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::string out;
  for (std::size_t i = lines.size() > 15 ? lines.size() - 15 : 0; i < lines.size(); ++i)
    out += "\n" + lines[i];
  return out;
}

void work(const std::string& command, const fs::path& output) {
  const std::string line = command + " > " + shell_word(output.string()) + " 2>&1";
  if (std::system(line.c_str()) != 0)
    throw std::runtime_error("the firmware was not built; " + command + last_lines(output));
}

// Returns the program in another form: bare memory, or a text of addresses and bytes.
fs::path converted(const fs::path& image, const std::string& extension, const fs::path& output) {
  const bool bare = extension == ".bin";
  if (!bare && extension != ".hex") return image;
  const fs::path out = image.string() + extension;
  work(fmt::format("arm-none-eabi-objcopy -O {} {} {}", bare ? "binary" : "ihex",
                   shell_word(image.string()), shell_word(out.string())),
       output);
  return out;
}

void require_form(const FirmwareBoard& board, const fs::path& file) {
  if (*board.form == 0 || file.extension() == board.form) return;
  config::fail({file.string(), 0, 0}, "file", config::in_quotes(file.extension().string()),
               fmt::format("\"{}\", which is what {} is loaded with", board.form, board.name));
}

// Bare memory has no mark.
FileKind kind_of(const fs::path& file) {
  constexpr auto start = FileKind::At::start;
  constexpr std::string_view what = "firmware of this form", name = "such a file";
  if (file.extension() == ".bin") return {what, name, "", start};
  return {what, name,
          file.extension() == ".hex" ? ":"
                                     : "\x7f"
                                       "ELF",
          start};
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace

std::span<const FirmwareBoard> firmware_boards() { return boards; }

const FirmwareBoard& firmware_board(const std::string& name) {
  std::vector<std::string_view> names;
  for (const FirmwareBoard& b : boards) {
    if (name == b.name) return b;
    names.push_back(b.name);
  }
  config::fail({"firmware", 0, 0}, "board", config::in_quotes(name), config::either(names),
               config::closest_in_quotes(name, names));
}

void require_fits(const std::string& robot, const FirmwareBoard& board) {
  const std::vector<control::Board> needed =
      boards_of(experiment::load_machine_file(robot).experiment);
  const auto refuse = [&](const std::string& key, const std::string& found,
                          const std::string& expected) {
    config::fail({robot, 0, 0}, key, found,
                 fmt::format("{}, to run it on {}", expected, board.name));
  };
  if (needed.size() != 1)
    refuse("board", fmt::format("{} boards", needed.size()), "one: a line leads to one");
  const control::Board& b = needed.front();
  for (std::size_t j = 0; j < b.joint_controller.joints; ++j)
    if (b.joint_controller.joint[j].kind == control::JointKind::regulated)
      refuse("control.joints", "pressure regulators",
             "valves: no output of a board sets a pressure");
  if (b.channel.size() > board.inputs)
    refuse("sensor", fmt::format("{} sensors", b.channel.size()),
           fmt::format("{} at most", board.inputs));
  if (b.valve.size() > board.outputs)
    refuse("muscle", fmt::format("{} valves", b.valve.size()),
           fmt::format("{} at most", board.outputs));
  if (!link::carries(line_rate, link::load_of(b.joint_controller, true), b.joint_controller.period))
    refuse("sensor", "telemetry that its line does not carry",
           fmt::format("what {} bits/s carry", line_rate));
}

std::string wiring_on(const std::string& robot, const FirmwareBoard& board) {
  require_fits(robot, board);
  const experiment::Experiment bench = experiment::load_machine_file(robot).experiment;
  return wiring_drawing(bench, boards_of(bench).front(), pins_of(board.name));
}

bool low_gives_current(const std::string& robot) {
  const robot::Wiring w = experiment::load_machine_file(robot).experiment.wiring;
  return w.present && w.polarity == robot::Wiring::Polarity::low_opens;
}

void build_firmware(const fs::path& sources, const FirmwareBoard& board, const fs::path& out,
                    bool low_gives_current, bool force) {
  if (!fs::exists(sources / "firmware" / "application.cpp"))
    config::fail({sources.string(), 0, 0}, "", "no sources of Sinew",
                 "the folder that they were cloned into");
  require_form(board, out);
  refuse_to_overwrite(out, force, kind_of(out));
  require_folder_of(out);
  for (const char* tool : {"cmake", "ninja", "arm-none-eabi-g++"})
    if (!has_program(tool))
      config::fail({tool, 0, 0}, "", "no such program", "the cross compiler and its tools",
                   "sudo apt install cmake ninja-build gcc-arm-none-eabi "
                   "libstdc++-arm-none-eabi-newlib");
  const Workshop workshop;
  std::string name = board.name;
  std::ranges::replace(name, '-', '_');
  const std::string image = "application-" + name + ".elf";
  const fs::path output = fs::path(workshop.path) / "said",
                 build = fs::path(workshop.path) / "build";
  work(
      fmt::format("cmake -S {} -B {} -G Ninja -DCMAKE_TOOLCHAIN_FILE={} -DCMAKE_BUILD_TYPE=Release "
                  "-DSINEW_LOW_GIVES_CURRENT={}",
                  shell_word(sources.string()), shell_word(build.string()),
                  shell_word((sources / "firmware" / "cortex-m4f.cmake").string()),
                  low_gives_current ? "ON" : "OFF"),
      output);
  work(fmt::format("ninja -C {} {}", shell_word(build.string()), image), output);
  const fs::path made = converted(build / "firmware" / image, out.extension().string(), output);
  std::ifstream in(made, std::ios::binary);
  write_file(out, std::string(std::istreambuf_iterator<char>(in), {}));
}

std::string flash_command(const FirmwareBoard& board, const fs::path& file) {
  require_form(board, file);
  std::string out = board.flash;
  const std::size_t at = out.find("{file}");
  if (at == out.npos) return out;
  const std::string where =
      file.extension() == ".bin" ? " 0x08000000" : "";  // an ELF file contains it
  const std::size_t quote = out.find('"');
  if (quote == out.npos) return out.replace(at, 6, shell_word(file.string()));
  // This is one shell word with a command of openocd, in which braces hold a name together.
  const std::string name =
      is_plain_word(file.string()) ? file.string() : fmt::format("{{{}}}", file.string());
  out.replace(at, 6, fmt::format("{}{}", name, where));
  if (is_plain_word(file.string())) return out;
  const std::size_t end = out.rfind('"');
  const std::string words = out.substr(quote + 1, end - quote - 1);
  return out.replace(quote, end - quote + 1, shell_word(words));
}

}  // namespace sinew::run
