// Tests a board's program at the end of a line: what it obeys, refuses and reports.
#include "sinew/control/board/program.h"

#include <gtest/gtest.h>

#include <random>

#include "sinew/control/board/test_host.h"
#include "sinew/signals/crc.h"

namespace sinew::board::program_test {
namespace {

using control::Command;
using signals::Reading;
using signals::Status;

Bytes all_of(const link::Telemetry& t) {
  Bytes out;
  for (std::uint8_t p = 0; p < link::parts_of(t.joints, t.channels); ++p) {
    const link::TelemetryMessage m = link::part_of(t, p);
    out.insert(out.end(), m.body.bytes.begin(),
               m.body.bytes.begin() + static_cast<long>(m.body.size));
  }
  return out;
}

// --- identity -----------------------------------------------------------------------------------

TEST(Program, ReportsItsNameAndThatItHasStarted) {
  Bench b({.board = {'b', 'e', 'n', 'c', 'h'}, .firmware = {'1'}});
  b.send(link::Identify{});
  ASSERT_EQ(b.identities.size(), 1u);
  EXPECT_EQ(b.identities[0].state, BoardState::fault);
  EXPECT_EQ(b.identities[0].board[0], 'b');
  EXPECT_EQ(b.identities[0].configuration, 0u);
  EXPECT_EQ(b.identities[0].configuration_bytes, link::configuration_size);
  ASSERT_EQ(b.events.size(), 1u);
  EXPECT_EQ(b.events[0].what, link::Event::What::started);
  EXPECT_EQ(b.events[0].fault, BoardFault::power_up);
}

TEST(Program, AnswersAnotherVersionAndObeysNothingOfIt) {
  Bench b;
  Bytes frame = link::frame_of(link::ClearFault{}, {1, 0});
  frame[5] = link::protocol_version - 1;
  const std::span<std::uint8_t> bytes(frame);
  link::Writer sums(bytes.subspan(7));
  sums.whole(signals::crc32(bytes.subspan(2, 5)));
  sums.whole(signals::crc16(bytes.subspan(2, 9)));
  b.put(frame);
  EXPECT_EQ(b.last(), Code::version);
  EXPECT_EQ(b.program.safety().state(), BoardState::fault);
}

TEST(Program, FramesToOtherBoardsAreNobodysBusiness) {
  Bench b;
  b.put(link::frame_of(link::ClearFault{}, {2, 0}));
  b.put(link::frame_of(link::ClearFault{}, {link::every_board, 0}));
  EXPECT_TRUE(b.replies.empty());
  EXPECT_EQ(b.program.safety().state(), BoardState::fault);
  b.put(link::frame_of(link::Identify{}, {link::every_board, 0}));
  EXPECT_EQ(b.identities.size(), 1u);
}

// --- arming -------------------------------------------------------------------------------------

TEST(Program, NothingMovesBeforeTwoDifferentFramesHaveArmedIt) {
  Bench b;
  const Command command = control::rest_command(control::test_leg());
  b.send(command_of(command, 0));
  EXPECT_EQ(b.last(), Code::state);
  b.send(link::ArmFirst{0});
  EXPECT_EQ(b.last(), Code::nonce) << "no configuration";
  b.configure(leg_configuration());
  EXPECT_EQ(b.last(), Code::done);
  b.send(link::ArmFirst{b.crc});
  EXPECT_EQ(b.last(), Code::state) << "a fault is latched";
  b.run(200);
  b.send(link::ClearFault{});
  EXPECT_EQ(b.last(), Code::done);
  b.run(1'100);
  b.send(link::ArmSecond{78, b.crc});
  EXPECT_NE(b.last(), Code::done) << "the first is missing";
  b.send(link::ArmFirst{b.crc ^ 1u});
  EXPECT_EQ(b.last(), Code::nonce);
  b.send(link::ArmFirst{b.crc});
  EXPECT_EQ(b.last(), Code::done);
  const std::uint32_t number = b.replies.back().value;
  b.send(link::ArmSecond{number + 1, b.crc});
  EXPECT_EQ(b.last(), Code::nonce);
  EXPECT_EQ(b.program.safety().state(), BoardState::idle);
  b.send(link::ArmSecond{number, b.crc});
  EXPECT_EQ(b.last(), Code::done);
  EXPECT_EQ(b.program.safety().state(), BoardState::armed);
  b.send(command_of(command, 100));
  EXPECT_EQ(b.last(), Code::period) << "a run begins with tick 0";
  b.configure(leg_configuration());
  EXPECT_EQ(b.last(), Code::state) << "armed";
  b.send(command_of(command, 0));
  const std::size_t replies = b.replies.size();
  b.send(command_of(command, 100));
  EXPECT_EQ(b.replies.size(), replies) << "the next one may come before the run has begun";
  b.run(1);
  EXPECT_EQ(b.program.safety().state(), BoardState::running);
}

TEST(Program, AConfigurationIsRefusedWholeAndTheOldOneStays) {
  Bench b;
  b.configure(leg_configuration());
  const std::uint32_t good = b.crc;
  link::Configuration bad = leg_configuration();
  bad.joint_controller.timing.closing[50] = 2;
  b.configure(bad);
  EXPECT_EQ(b.last(), Code::configuration);
  const link::Reply& answer = b.replies.back();
  EXPECT_NE(std::string(answer.text.data(), answer.letters).find("not monotone"),
            std::string::npos);
  b.send(link::Identify{});
  EXPECT_EQ(b.identities.back().configuration, good);
  b.crc = good;
  b.run(200);
  b.send(link::ClearFault{});
  b.run(1'100);
  b.arm();
  EXPECT_EQ(b.program.safety().state(), BoardState::armed);
}

TEST(Program, AFrameThatIsSentTwiceIsObeyedOnce) {
  Bench b;
  b.ready();
  b.send(command_of(control::rest_command(control::test_leg()), 0));
  b.run(150);
  const std::uint8_t sequence = b.sequence;
  const Bytes frame = link::frame_of(link::Enable{1, true}, {1, sequence});
  b.put(frame);
  b.put(frame);
  EXPECT_EQ(b.last(), Code::done);
  b.run(100);
  EXPECT_EQ(b.telemetry.link.repeated, 1u);
  EXPECT_EQ(b.replies.back().sequence, sequence);
  // A shutdown is the exception.
  b.put(link::frame_of(link::ShutDown{}, {1, sequence}));
  b.run(1);
  EXPECT_EQ(b.program.safety().state(), BoardState::vent);
}

// --- a run --------------------------------------------------------------------------------------

// In lock step, a board at the end of its line equals a local supervised controller: telemetry of
// each period and all edges are bit-identical for all commands and readings.
TEST(Program, IsTheSupervisedControllerToTheBit) {
  std::mt19937 random(1);
  const auto reads = [](std::uint8_t channel, Tick t) {
    return Reading{static_cast<std::uint16_t>((channel * 997 + t * 31) % 4096), Status::ok};
  };
  for (unsigned trial = 0; trial < 5; ++trial) {
    const link::Configuration c{control::any_leg(random), {}, {}};
    Bench b;
    std::mt19937 commands(trial);
    Command command;
    b.reads = [&](std::uint8_t channel, Tick run, Reading) {
      return reads(channel, run < 0 ? 0 : run);
    };
    b.ready(c);
    b.send(link::EdgesWanted{true});
    control::Supervisor alone(c.joint_controller, c.limits);
    std::vector<signals::Edge> expected;
    Tick t = 0;
    const auto next_command = [&] {
      command = control::any_command(commands, c.joint_controller, false);
      b.send(command_of(command, t));
    };
    b.on_period = [&] {
      if (b.program.safety().state() == BoardState::armed) return;
      link::Telemetry here = b.telemetry;  // keeps fields that only the board has
      here.controller = alone.state();
      here.supervised = alone.supervised();
      ASSERT_EQ(b.telemetry.tick, t);
      ASSERT_EQ(all_of(b.telemetry), all_of(here)) << t;
      next_command();
    };
    next_command();  // the first one starts it
    for (; t < 10'000; ++t) {
      // Both begin the period before its command comes.
      (void)alone.starts_period(t);
      b.tick();
      if (alone.starts_period(t)) alone.command(command);
      for (const signals::Edge& e : alone.edges(t)) expected.push_back(e);
      if (const signals::Conversion* conversion = alone.due(t))
        alone.take(*conversion, reads(conversion->channel.index, t), t);
    }
    b.serve();
    ASSERT_GT(expected.size(), 50u);
    ASSERT_EQ(b.edges.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(b.edges[i].at, expected[i].at);
      EXPECT_EQ(b.edges[i].valve.index, expected[i].valve.index);
      EXPECT_EQ(b.edges[i].open, expected[i].open);
    }
    EXPECT_EQ(b.program.dropped(), 0u);
    EXPECT_EQ(b.joiner.lost(), 0u);
    EXPECT_EQ(b.telemetries > 90, true);
  }
}

TEST(Program, ACommandThatIsOverOrTooFarAheadIsRefused) {
  Bench b;
  b.ready();
  const Command command = control::rest_command(control::test_leg());
  b.send(command_of(command, 0));
  b.run(1'050);
  b.send(command_of(command, 900));
  EXPECT_EQ(b.last(), Code::past);
  b.send(command_of(command, 1'500));
  EXPECT_EQ(b.last(), Code::future);
  b.send(command_of(command, 1'150));
  EXPECT_EQ(b.last(), Code::period);
  b.send(command_of(command, 1'100, 4));
  EXPECT_EQ(b.last(), Code::value) << "the leg has three joints";
  b.run(100);
  EXPECT_EQ(b.telemetry.link.late, 1u);
  EXPECT_EQ(b.telemetry.link.refused, 4u);
}

TEST(Program, GainsDutiesAndEnablingHoldUntilTheNextCommand) {
  Bench b;
  b.ready();
  Command command = control::rest_command(control::test_leg());
  for (control::JointCommand& j : command.joint) j.enabled = true;
  b.send(command_of(command, 0, 3, 10));
  b.run(50);
  b.send(link::SetFeedforward{control::hip, {40, 0, 0, 40}});
  b.run(260);
  EXPECT_EQ(b.telemetry.controller.joint[control::hip].duties, (control::Duties{40, 0, 0, 40}));
  b.send(link::Enable{1u << control::hip, false});
  b.run(200);
  EXPECT_FALSE(b.telemetry.controller.joint[control::hip].enabled);
  EXPECT_TRUE(b.telemetry.controller.joint[control::knee].enabled);
  b.send(link::SetGains{7, {}});
  EXPECT_EQ(b.last(), Code::value);
}

// A plan's end is not a fault: inlets shut at once, muscles are vented, then all valves are shut
// and the board is ready for the next run.
TEST(Program, ACommandThatEndsTheRunVentsItAndLeavesTheBoardIdle) {
  Bench b;
  b.ready();
  Command command = control::rest_command(control::test_leg());
  command.joint[control::hip] = {.enabled = true, .open_loop = true, .duties = {90, 0, 0, 90}};
  b.send(command_of(command, 0, 3, 10));
  b.run(150);
  EXPECT_NE(b.out.open, 0u);
  link::CommandFor last = command_of(command, 200, 3, 10);
  last.ends = true;
  b.send(last);
  ASSERT_TRUE(b.reaches(BoardState::vent, 60));
  ASSERT_TRUE(b.reaches(BoardState::idle, 30'000));
  b.run(1);
  EXPECT_EQ(b.out.open, 0u);
  std::vector<BoardState> states;
  for (const link::Event& e : b.events) states.push_back(e.state);
  EXPECT_EQ(states, (std::vector{BoardState::fault, BoardState::idle, BoardState::armed,
                                 BoardState::running, BoardState::vent, BoardState::idle}));
}

// --- faults -------------------------------------------------------------------------------------

TEST(Program, ASilentHostIsHeldVentedAndReported) {
  Bench b;
  b.ready();
  b.send(command_of(control::rest_command(control::test_leg()), 0));
  ASSERT_TRUE(b.reaches(BoardState::hold, 1'100));
  ASSERT_TRUE(b.reaches(BoardState::vent, 10'000));
  ASSERT_TRUE(b.reaches(BoardState::fault, 20'000));
  std::vector<BoardState> states;
  for (const link::Event& e : b.events) states.push_back(e.state);
  EXPECT_EQ(states, (std::vector{BoardState::fault, BoardState::idle, BoardState::armed,
                                 BoardState::running, BoardState::hold, BoardState::vent,
                                 BoardState::fault}));
  EXPECT_EQ(b.events.back().fault, BoardFault::host_silent);
}

// The log is the telemetry of the last 200 ms, body by body, including the fault.
TEST(Program, TheLogOfAFaultIsTheTelemetryBeforeIt) {
  Bench b;
  b.ready();
  const Command command = control::rest_command(control::test_leg());
  std::vector<Bytes> said;
  b.on_telemetry = [&](const link::Telemetry& t) {
    for (std::uint8_t p = 0; p < link::parts_of(t.joints, t.channels); ++p) {
      const link::TelemetryMessage m = link::part_of(t, p);
      said.emplace_back(m.body.bytes.begin(),
                        m.body.bytes.begin() + static_cast<long>(m.body.size));
    }
  };
  Tick lies_from = 1'000'000;
  b.reads = [&](std::uint8_t channel, Tick run, Reading r) {
    if (channel == control::hip_angle && run > lies_from) r.counts = 4'095;
    return r;
  };
  Tick t = 0;
  b.on_period = [&] { b.send(command_of(command, t)); };
  b.send(command_of(command, 0));
  for (; t < 5'000; ++t) b.tick();
  lies_from = t;
  for (; b.program.safety().state() == BoardState::running; ++t) b.tick();
  ASSERT_LT(t, 5'400);
  const std::size_t known = said.size();
  for (const Tick end = t + 30'000; t < end; ++t) b.tick();  // the log is kept
  b.send(link::ReadFaultLog{0});
  b.serve();
  ASSERT_GT(b.log.size(), 20u);
  const link::FaultLog end = b.log.back();
  EXPECT_EQ(end.count, 0u) << "nothing more";
  b.log.pop_back();
  const std::size_t parts = link::parts_of(3, 7);
  EXPECT_EQ(b.log.size(), 20u * parts);
  // They end with the first period that has the fault.
  const std::size_t last = known + parts;
  for (std::size_t i = 0; i < b.log.size(); ++i) {
    const link::FaultLog& m = b.log[i];
    EXPECT_EQ(m.part, i);
    EXPECT_EQ(Bytes(m.data.begin(), m.data.begin() + m.count), said[last - b.log.size() + i]) << i;
  }
}

// --- a bad line ---------------------------------------------------------------------------------

// With damaged frames that would arm the board and let air in: a frame is obeyed as it was sent, or
// ignored.
TEST(Program, SpoiledFramesLetNoAirIn) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    Bench b;
    b.configure(leg_configuration());
    b.run(200);
    b.send(link::ClearFault{});
    b.run(1'100);
    b.spoil = [&](Bytes& frame) {
      for (unsigned flips = 1 + random() % 8; flips > 0; --flips)
        frame[random() % frame.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
      if (random() % 4 == 0) frame.resize(random() % frame.size());
    };
    Command command = control::rest_command(control::test_leg());
    for (control::JointCommand& j : command.joint) {
      j.enabled = j.open_loop = true;
      j.duties = {100, 0, 0, 100};
    }
    for (int i = 0; i < 50; ++i) {
      b.send(link::ArmFirst{b.crc});
      b.send(link::ArmSecond{78, b.crc});
      b.send(command_of(command, 0));
      b.run(20);
      b.program.silent();
      ASSERT_EQ(b.out.open, 0u);
      ASSERT_NE(b.program.safety().state(), BoardState::running);
    }
  }
}

TEST(Program, NoiseIsThrownAwayAndWhatFollowsIsObeyed) {
  std::mt19937 random(5);
  Bench b;
  Bytes noise(5'000);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
  b.put(noise);
  b.program.silent();
  b.serve();
  b.send(link::Identify{});
  EXPECT_EQ(b.identities.size(), 1u);
}

// --- the thesis's words -------------------------------------------------------------------------

TEST(Program, UnderstandsTheThesissBytesBetweenFrames) {
  Bench b;
  b.ready();
  b.send(link::ThesisWords{true});
  ASSERT_EQ(b.last(), Code::done);
  b.send(command_of(control::rest_command(control::test_leg()), 0, 3, 100));
  b.run(150);
  const auto word = [&](const Bytes& bytes) {
    b.serve();
    b.received_bytes.clear();
    b.put(bytes);
    return b.received_bytes;
  };
  EXPECT_EQ(word({23}), Bytes{'F'});  // enableall
  EXPECT_EQ(word({31}), Bytes{'R'});
  EXPECT_EQ(word({0x08, 0x07}), Bytes{'F'});  // 1800 counts
  EXPECT_EQ(word({254}), Bytes{'B'});
  EXPECT_EQ(word({10}).size(), 2 * 7u + 1);
  b.run(200);
  EXPECT_TRUE(b.telemetry.controller.joint[control::hip].enabled);
  EXPECT_NE(b.telemetry.controller.joint[control::hip].angle_output, 0.0f) << "1800 of 1895 counts";
  EXPECT_EQ(word({255}).front(), 'F');
  b.run(1);
  EXPECT_EQ(b.program.safety().state(), BoardState::vent);
}

}  // namespace
}  // namespace sinew::board::program_test
