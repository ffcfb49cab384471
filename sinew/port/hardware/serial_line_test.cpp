// Tests a serial line at a pair of pseudo-terminals; the test has the other end.
#include "sinew/port/hardware/serial_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <numeric>
#include <vector>

#include "sinew/port/hardware/remote_board.h"

namespace sinew::plant::serial_line_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct FarEnd {
  FarEnd() : file(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (file < 0 || ::grantpt(file) != 0 || ::unlockpt(file) != 0) throw std::runtime_error("pty");
    device = ::ptsname(file);
  }
  ~FarEnd() { unplug(); }
  void unplug() {
    if (file >= 0) ::close(file);
    file = -1;
  }

  int file;
  std::string device;
};

std::string refusal(const std::string& device, std::uint32_t baud) {
  try {
    const SerialLine line(device, baud);
  } catch (const BoardError& e) {
    return e.what();
  }
  return "";
}

Bytes every_byte() {
  Bytes all(256);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  return all;
}

TEST(SerialLine, EveryByteComesThroughUnchangedBothWays) {
  FarEnd far;
  SerialLine serial(far.device, 921'600);
  const BoardLine line = serial.line();
  const Bytes all = every_byte();

  ASSERT_TRUE(line.write(all));
  Bytes there(512);
  ASSERT_EQ(::read(far.file, there.data(), there.size()), 256);
  there.resize(256);
  EXPECT_EQ(there, all);

  ASSERT_EQ(::write(far.file, all.data(), all.size()), 256);
  Bytes here;
  Bytes part(64);
  for (std::ptrdiff_t n; here.size() < 256 && (n = line.read(part, 0.5)) > 0;)
    here.insert(here.end(), part.begin(), part.begin() + n);
  EXPECT_EQ(here, all);
}

TEST(SerialLine, NothingComesFromASilentLineAndAnUnpluggedOneIsGone) {
  FarEnd far;
  SerialLine serial(far.device, 115'200);
  const BoardLine line = serial.line();
  Bytes bytes(8);
  EXPECT_EQ(line.read(bytes, 0.01), 0);
  far.unplug();
  EXPECT_EQ(line.read(bytes, 0.01), -1);
  EXPECT_FALSE(line.write(every_byte()));
}

TEST(SerialLine, ASecondHostIsRefusedAndComesInAfterTheFirst) {
  FarEnd far;
  {
    const SerialLine first(far.device, 115'200);
    EXPECT_NE(refusal(far.device, 115'200).find("another program has it"), std::string::npos);
  }
  EXPECT_EQ(refusal(far.device, 115'200), "");
}

TEST(SerialLine, WhatCannotBeOpenedIsRefusedWithWhatToDo) {
  const FarEnd far;
  EXPECT_NE(refusal("/dev/no-such-board", 115'200).find("is the board plugged in?"),
            std::string::npos);
  EXPECT_EQ(refusal("/dev/null", 115'200), "/dev/null: this is no serial line");
  EXPECT_NE(refusal(far.device, 12'345).find("found 12345 bits/s; expected one of 9600, "),
            std::string::npos);
}

// Bytes of a board at another rate arrive changed.
TEST(SerialLine, AHostAtAnotherRateReceivesNoFramesAndReportsIt) {
  FarEnd far;
  SerialLine serial(far.device, 115'200);
  RemoteBoard board(serial.line(), 1, 100);
  const Bytes noise(400, 0xf8);
  ASSERT_EQ(::write(far.file, noise.data(), noise.size()), 400);
  try {
    board.identify();
    FAIL() << "nobody is there";
  } catch (const BoardError& e) {
    EXPECT_NE(std::string(e.what()).find("is it another rate"), std::string::npos) << e.what();
  }
}

TEST(SerialLine, ALineWithoutABoardIsReported) {
  const FarEnd far;
  SerialLine serial(far.device, 115'200);
  RemoteBoard board(serial.line(), 1, 100);
  try {
    board.identify();
    FAIL() << "nobody is there";
  } catch (const BoardError& e) {
    EXPECT_NE(std::string(e.what()).find("no reply"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sinew::plant::serial_line_test
