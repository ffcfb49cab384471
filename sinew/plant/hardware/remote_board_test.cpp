// What a host says of a board that is not as it should be.
#include "sinew/plant/hardware/remote_board.h"

#include <gtest/gtest.h>

#include "sinew/control/link/test_wire.h"

namespace sinew::plant {
namespace {

// A board that says one thing to whatever it hears.
struct Parrot {
  BoardLine line() {
    return {[this](std::span<const std::uint8_t>) {
              waiting = says;
              return true;
            },
            [this](std::span<std::uint8_t> out, double) -> std::ptrdiff_t {
              const std::size_t n = std::min(out.size(), waiting.size());
              std::copy_n(waiting.begin(), n, out.begin());
              waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(n));
              return static_cast<std::ptrdiff_t>(n);
            }};
  }
  link::Bytes says, waiting;
};

std::string refusal(const link::Identity& who, std::uint8_t number = 1) {
  Parrot parrot;
  parrot.says = link::frame_of(who, {number, 0});
  RemoteBoard board(parrot.line(), 1, 100);
  try {
    board.prepare({});
  } catch (const BoardError& e) {
    return e.what();
  }
  return "";
}

TEST(RemoteBoard, AnotherVersionOfTheProtocolIsRefused) {
  EXPECT_EQ(refusal({.protocol = 2}), "the board speaks version 2 of the protocol, this program 1");
}

TEST(RemoteBoard, ABoardThatRunsAlreadyIsLeftAlone) {
  for (const auto state :
       {control::BoardState::armed, control::BoardState::running, control::BoardState::hold})
    EXPECT_EQ(refusal({.protocol = link::protocol_version, .state = state}),
              "the board is in a run already: is another program at this line?");
}

TEST(RemoteBoard, AnotherNumberOnTheLineIsSaidToBeSo) {
  EXPECT_EQ(refusal({.protocol = link::protocol_version}, 2),
            "there are boards on the line, board 1 is none of them");
}

TEST(RemoteBoard, ABoardThatOnlySaysWhoItIsAnswersNothing) {
  EXPECT_EQ(refusal({.protocol = link::protocol_version}),
            "board 1 does not answer: is it on this line, at this rate?");
}

}  // namespace
}  // namespace sinew::plant
