// A robot's board and its program.
#include "sinew/run/bring_up/firmware.h"

#include <gtest/gtest.h>

#include "sinew/config/diagnostics.h"

namespace sinew::run {
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
  return SINEW_SOURCE_DIR "/robots/" + name + "/robot.toml";
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
      [] { build_firmware("/", firmware_board("stm32f405"), "/tmp/not-written.elf", false); });
  EXPECT_NE(said.find("no sources of Sinew"), std::string::npos) << said;
}

TEST(Firmware, TheCommandThatFlashesNamesTheFile) {
  EXPECT_NE(flash_command(firmware_board("stm32f405"), "leg.elf").find("program leg.elf verify"),
            std::string::npos);
  EXPECT_EQ(flash_command(firmware_board("mps2-an386"), "leg.elf"), "");
}

}  // namespace
}  // namespace sinew::run
