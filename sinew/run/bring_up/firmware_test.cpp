// The firmware of a robot's board: fit, build and flash command.
#include "sinew/run/bring_up/firmware.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/run/bring_up/pins.h"
#include "tests/places.h"

namespace sinew::run::firmware_test {
namespace {

template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

std::string robot(const std::string& name) {
  return sinew::test::source_dir() + "/robots/" + name + "/robot.toml";
}

TEST(Firmware, OfEveryBoardTakesTheThesissLeg) {
  for (const FirmwareBoard& board : firmware_boards())
    EXPECT_EQ(refusal([&] { require_fits(robot("leg"), board); }), "") << board.name;
}

TEST(Firmware, ARobotThatDoesNotFitIsRefused) {
  FirmwareBoard small = firmware_board("stm32f405");
  small.inputs = 6;
  EXPECT_NE(refusal([&] {
              require_fits(robot("leg"), small);
            }).find("sensor: found 7 sensors; expected 6 at most, to run it on stm32f405"),
            std::string::npos);
  small = firmware_board("stm32f405");
  small.outputs = 7;
  EXPECT_NE(refusal([&] { require_fits(robot("leg"), small); }).find("found 8 valves; expected 7"),
            std::string::npos);
}

TEST(Firmware, OfAnUnknownBoardNamesThoseThatAreThere) {
  const std::string said = refusal([] { firmware_board("stm32f404"); });
  EXPECT_NE(said.find("found \"stm32f404\""), std::string::npos) << said;
  EXPECT_NE(said.find("try \"stm32f405\""), std::string::npos) << said;
}

TEST(Firmware, IsBuiltFromSourcesOnly) {
  const std::string said = refusal(
      [] { build_firmware("/", firmware_board("stm32f405"), "not-written.elf", false, false); });
  EXPECT_NE(said.find("no sources of Sinew"), std::string::npos) << said;
}

TEST(Firmware, HasTheLevelThatTheRobotsDriversTake) {
  EXPECT_TRUE(low_gives_current(robot("leg")));
  EXPECT_FALSE(low_gives_current(robot("one-joint")));  // no wiring
}

TEST(Firmware, TheCommandThatFlashesNamesTheFile) {
  EXPECT_NE(flash_command(firmware_board("stm32f405"), "leg.elf").find("program leg.elf verify"),
            std::string::npos);
  EXPECT_EQ(flash_command(firmware_board("mps2-an386"), "leg.elf"), "");
  EXPECT_EQ(flash_command(firmware_board("teensy41"), "leg.hex"),
            "teensy_loader_cli -mmcu=TEENSY41 -w -v leg.hex");
}

TEST(Firmware, TheCommandThatFlashesIsAShellsEvenForNamesWithSpacesAndQuotes) {
  EXPECT_EQ(flash_command(firmware_board("teensy41"), "my leg's.hex"),
            "teensy_loader_cli -mmcu=TEENSY41 -w -v 'my leg'\\''s.hex'");
  EXPECT_EQ(flash_command(firmware_board("stm32f405"), "my $leg.bin"),
            "openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c 'program {my $leg.bin} "
            "0x08000000 verify reset exit'");
}

TEST(Firmware, ARobotWithRegulatorsIsRefused) {
  EXPECT_NE(refusal([] {
              require_fits(robot("leg-with-regulators"), firmware_board("stm32f405"));
            }).find("found pressure regulators; expected valves"),
            std::string::npos);
}

TEST(Firmware, AFileThatTheBoardIsNotLoadedWithIsRefusedBeforeItIsBuilt) {
  const FirmwareBoard& board = firmware_board("teensy41");
  const std::string expected = "found \".elf\"; expected \".hex\", which is what teensy41";
  const std::string shown = refusal([&] { flash_command(board, "leg.elf"); });
  EXPECT_NE(shown.find(expected), std::string::npos) << shown;
  const std::string built = refusal(
      [&] { build_firmware(sinew::test::source_dir(), board, "not-written.elf", false, false); });
  EXPECT_NE(built.find(expected), std::string::npos) << built;
}

TEST(Firmware, TheWiringNamesEachPinOfTheBoardOnce) {
  const std::string leg = sinew::test::source_dir() + "/robots/leg/robot.toml";
  for (const Pins& pins : all_pins()) {
    const FirmwareBoard& board = firmware_board(std::string(pins.board));
    EXPECT_EQ(pins.inputs.size(), board.inputs);
    EXPECT_EQ(pins.outputs.size(), board.outputs);
    std::vector<std::string_view> all{pins.supply};
    all.insert(all.end(), pins.inputs.begin(), pins.inputs.end());
    all.insert(all.end(), pins.outputs.begin(), pins.outputs.end());
    std::ranges::sort(all);
    EXPECT_EQ(std::ranges::adjacent_find(all), all.end()) << pins.board;

    const std::string svg = wiring_on(leg, board);
    EXPECT_NE(svg.find("input 6" + in_brackets(pins.inputs, 6)), std::string::npos);
    EXPECT_NE(svg.find("output 7" + in_brackets(pins.outputs, 7)), std::string::npos);
    EXPECT_NE(svg.find(std::string(pins.supply)), std::string::npos);
  }
}

}  // namespace
}  // namespace sinew::run::firmware_test
