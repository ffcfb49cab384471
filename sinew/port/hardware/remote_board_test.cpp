// Tests a host's messages about a board that is in an unexpected state.
#include "sinew/port/hardware/remote_board.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "sinew/control/link/test_wire.h"
#include "sinew/control/link/texts.h"
#include "sinew/signals/crc.h"

namespace sinew::plant::remote_board_test {
namespace {

// A board that sends the same message after every reception. Each read of its line takes 10 ms.
struct EchoingLine {
  BoardLine line() {
    return {[this](std::span<const std::uint8_t>) {
              waiting = says;
              return true;
            },
            [this](std::span<std::uint8_t> out, double) -> std::ptrdiff_t {
              time += 0.01;
              const std::size_t n = std::min(out.size(), waiting.size());
              std::copy_n(waiting.begin(), n, out.begin());
              waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(n));
              return static_cast<std::ptrdiff_t>(n);
            },
            [this] { return time; }};
  }
  link::Bytes says, waiting;
  double time = 0;
};

constexpr const char* no_reply = "board 1 does not reply: is it on this line, at this rate?";

std::string refusal_of(
    const link::Bytes& says, const std::function<void(RemoteBoard&)>& with = [](RemoteBoard&) {}) {
  EchoingLine echoing;
  echoing.says = says;
  RemoteBoard board(echoing.line(), 1, 100);
  with(board);
  try {
    board.prepare({});
  } catch (const BoardError& e) {
    return e.what();
  }
  return "";
}

std::string refusal(
    const link::Identity& who, std::uint8_t number = 1,
    const std::function<void(RemoteBoard&)>& with = [](RemoteBoard&) {}) {
  return refusal_of(link::frame_of(who, {number, 0}), with);
}

TEST(RemoteBoard, AnotherVersionOfTheProtocolIsRefused) {
  EXPECT_EQ(refusal({.protocol = 3}), "the board has version 3 of the protocol, this program 2");
  // Identity of protocol version 1 as it was sent: 51 bytes.
  link::Bytes old = {0xaa, 0x55, 0x81, 0, 6 + 51, 1, 1};
  old.resize(old.size() + 51);
  old[7] = 1;
  const auto put = [&](std::uint32_t sum, int bytes) {
    for (int i = 0; i < bytes; ++i) old.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
  };
  put(signals::crc32(std::span(old).subspan(2)), 4);
  put(signals::crc16(std::span(old).subspan(2)), 2);
  EXPECT_EQ(refusal_of(old), "the board has version 1 of the protocol, this program 2");
}

// All coils would have current while the board rests, and none while it drives.
TEST(RemoteBoard, OutputsOfTheOtherLevelAreRefusedBeforeAnythingIsConfigured) {
  for (const bool board : {false, true})
    for (const bool robot : {false, true}) {
      const std::string said =
          refusal({.active_low = board}, 1, [&](RemoteBoard& b) { b.expect_levels(robot); });
      if (board == robot) {
        EXPECT_EQ(said, no_reply);
      } else {
        EXPECT_NE(said.find(board ? "found \"high opens\"; expected \"low opens\""
                                  : "found \"low opens\"; expected \"high opens\""),
                  std::string::npos)
            << said;
      }
    }
  EXPECT_EQ(refusal({.active_low = true}), no_reply) << "no wires";
}

TEST(RemoteBoard, AGraveFaultIsClearedOnlyWhereThatIsAllowed) {
  using enum control::BoardFault;
  using control::BoardState;
  const auto allow = [](RemoteBoard& b) { b.allow_clearing(); };
  for (const auto fault : {watchdog, parameters, control::BoardFault::state, not_empty}) {
    const link::Identity who{.state = BoardState::dump, .fault = fault};
    EXPECT_EQ(refusal(who), std::string("the board is in dump: ") + link::to_text(fault) +
                                "; find the cause, then send clear_fault, or switch the board "
                                "off and on");
    EXPECT_EQ(refusal(who, 1, allow), no_reply);
    EXPECT_EQ(fault_found(who), std::string("the board was in dump: ") + link::to_text(fault));
  }
  for (const auto fault : {supervisor, controller, held_too_long}) {
    const link::Identity who{.state = BoardState::fault, .fault = fault};
    EXPECT_EQ(refusal(who), no_reply);
    EXPECT_EQ(fault_found(who), std::string("the board was in fault: ") + link::to_text(fault));
  }
  for (const auto fault : {none, power_up, host_silent, requested}) {
    const link::Identity who{.state = BoardState::fault, .fault = fault};
    EXPECT_EQ(refusal(who), no_reply);
    EXPECT_EQ(fault_found(who), "");
  }
}

TEST(RemoteBoard, ABoardThatRunsAlreadyIsLeftAlone) {
  for (const auto state :
       {control::BoardState::armed, control::BoardState::running, control::BoardState::hold})
    EXPECT_EQ(refusal({.protocol = link::protocol_version, .state = state}),
              "the board is in a run already: is another program at this line?");
}

TEST(RemoteBoard, AnotherNumberOnTheLineIsReported) {
  EXPECT_EQ(refusal({.protocol = link::protocol_version}, 2),
            "board 1 is not among the boards on the line");
}

TEST(RemoteBoard, ABoardThatOnlyIdentifiesItselfRepliesNothing) {
  EXPECT_EQ(refusal({.protocol = link::protocol_version}),
            "board 1 does not reply: is it on this line, at this rate?");
}

// A line that carries noise without a pause.
struct Noise {
  BoardLine line() {
    return {[](std::span<const std::uint8_t>) { return true; },
            [this](std::span<std::uint8_t> out, double) -> std::ptrdiff_t {
              time += 0.01;
              link::Bytes bytes = std::exchange(said, {});
              for (int i = 0; i < 10; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
              std::ranges::copy(bytes, out.begin());
              return std::ssize(bytes);
            },
            [this] { return time; }};
  }
  link::Bytes said;  // sent by the board before the noise began
  std::mt19937 random{39};
  double time = 0;
};

TEST(RemoteBoard, AtALineThatIsNeverSilentEachWaitEndsByTheClock) {
  Noise noise;
  RemoteBoard board(noise.line(), 1, 100);
  const auto took = [&](const auto& what) {
    const double begun = noise.time;
    what();
    return noise.time - begun;
  };
  constexpr double read = 0.011;
  EXPECT_NEAR(took([&] { EXPECT_THROW(board.identify(), BoardError); }), 1.5, 3 * read);
  EXPECT_NEAR(took([&] { EXPECT_THROW(board.configure({}), BoardError); }), 1.5, 3 * read);
  EXPECT_NEAR(took([&] { EXPECT_THROW(board.clear_fault(), BoardError); }), 1.5, 3 * read);
  EXPECT_NEAR(took([&] { EXPECT_THROW(board.arm(), BoardError); }), 1.5, 3 * read);
  noise.said = link::frame_of(link::Event{.state = control::BoardState::running}, {1, 0});
  EXPECT_NEAR(took([&] { EXPECT_EQ(board.wait_for_telemetry(0.7), nullptr); }), 0.7, read);
  EXPECT_NEAR(took([&] { EXPECT_EQ(board.next(0.7), nullptr); }), 0.7, read);
  EXPECT_EQ(board.why(), RemoteBoard::Why::silent);
  EXPECT_NEAR(took([&] { EXPECT_FALSE(board.shut_down()); }), 1.5, read);
  EXPECT_NEAR(took([&] { EXPECT_THROW(board.fault_log(), BoardError); }), 20 * 0.3, 20 * read);
}

TEST(RemoteBoard, WhatWaitsOutsideARunCanBeGivenUp) {
  Noise noise;
  RemoteBoard board(noise.line(), 1, 100);
  double until = 0;
  board.stop_when([&] { return noise.time > until; });
  const auto is_given_up = [&](const auto& what) {
    until = noise.time + 0.1;
    EXPECT_THROW(what(), BoardStopped);
    EXPECT_LT(noise.time, until + 0.03);
  };
  is_given_up([&] { board.prepare({}); });
  is_given_up([&] { board.configure({}); });
  is_given_up([&] { board.clear_fault(); });
  is_given_up([&] { board.arm(); });
  is_given_up([&] { (void)board.wait_for_telemetry(5); });
}

}  // namespace
}  // namespace sinew::plant::remote_board_test
