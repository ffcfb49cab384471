// A run whose joint controllers are a board's program at the end of a line.
#include "sinew/run/simulation/remote_boards.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/control/link/test_wire.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/test_board.h"
#include "sinew/run/simulation/test_log.h"
#include "sinew/run/simulation/wired_body.h"
#include "tests/places.h"

namespace sinew::run::remote_boards_test {
namespace {

using control::Trip;

experiment::Experiment loaded(const std::string& name, std::vector<std::string> sets = {}) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

// A board at the wires of a simulated body, ready to run.
struct Bench {
  explicit Bench(const experiment::Experiment& e)
      : experiment(e),
        body(e),
        board(watched(body.wires())),
        remote(board.line(), 1, only_board(e).joint_controller.period) {}

  Outcome run(int lead = 0) {
    remote.prepare(configuration_of(experiment));
    first = board.periods;
    return run::run(experiment, {.board = &remote, .lead = lead});
  }
  plant::Wires watched(plant::Wires wires) {
    const auto valves = wires.valves;
    const signals::Tick end = experiment::last_tick(experiment);
    wires.valves = [=, this](signals::Tick tick, std::uint32_t open, bool current) {
      if (tick >= 0 && tick < end) opened.emplace_back(tick, open);
      valves(tick, open, current);
    };
    return wires;
  }
  // `what` is called in a period of the run, before the host receives the board's message.
  void in_period(int which, std::function<void(std::vector<std::uint8_t>&)> what) {
    board.spoil = [this, which, what](std::vector<std::uint8_t>& bytes) {
      if (first >= 0 && board.periods - first >= which) what(bytes);
    };
  }

  using Opened = std::vector<std::pair<signals::Tick, std::uint32_t>>;

  experiment::Experiment experiment;
  WiredBody body;
  Opened opened;  // valve bits before the run's end, with the ticks from which they apply
  BoardInThread board;
  plant::RemoteBoard remote;
  int first = -1;  // period of the run, by the board's count
};

// The stands have every kind of drive: feedback, the model, pulses of a 3-way valve and of two
// 2-way valves, single pulses, and none. A board reports once in a period, so the log has the same
// period.
TEST(RemoteBoards, ABoardsProgramHasTheSimulationsLogBitForBit) {
  const std::string length = "sensor={length={of=\"length\",low=\"2 in\",high=\"4.5 in\"}}";
  const std::string every_20_ms = "log.period=20 ms", every_40_ms = "log.period=40 ms";
  const std::pair<const char*, std::vector<std::string>> runs[] = {
      {"kick", {}},
      {"one-joint", {}},
      {"walk-test-1", {}},
      {"rig/feedback", {"log.period=400 ms"}},
      {"rig/feedback-on-off", {every_20_ms}},
      {"rig/feed-forward", {every_20_ms, length}},
      {"rig/pwm-25hz-5lb", {every_40_ms, length}},
      {"rig/pwm-25hz-5lb", {every_40_ms, length, "element.inlet=inlet", "element.exhaust=exhaust"}},
      {"rig/isometric", {every_40_ms, "duration=15.03 s"}},
      {"rig/creep", {every_40_ms, "duration=1 s"}},
  };
  for (const auto& [name, sets] : runs) {
    SCOPED_TRACE(name);
    experiment::Experiment e = loaded(name, sets);
    Bench bench(e);
    const Outcome simulated = run(e), far = bench.run();
    EXPECT_EQ(far.line, "");
    EXPECT_FALSE(far.ended_early());
    EXPECT_EQ(far.lost, 0u);
    EXPECT_EQ(simulated.duration, far.duration);
    ASSERT_NO_FATAL_FAILURE(expect_same_log(simulated.table, far.table));
  }
}

experiment::Experiment pulsed(const std::string& pulses) {
  return loaded("rig/isometric", {"duration=1 s", "drive.period=40 ms", "log.period=80 ms",
                                  "drive.pulses=[" + pulses + "]"});
}

// Openings are valid for one period each; none is lost, from the first period on.
TEST(RemoteBoards, CommandsThatAreSentAheadOpenAStandsValvesOnePeriodLater) {
  Bench bench(pulsed(R"({at="10 ms",open="100 ms"},{at="0.2 s",open="8 ms",exhaust=true})"));
  const Outcome far = bench.run(1);
  EXPECT_EQ(far.line, "");
  EXPECT_FALSE(far.ended_early());
  const signals::Tick later = 400;
  const Bench::Opened expected = {
      {later + 100, 1}, {later + 1'100, 0}, {later + 2'000, 2}, {later + 2'080, 0}};
  EXPECT_EQ(bench.opened, expected);
}

TEST(RemoteBoards, AStandsValvesGoOnAsPlannedAfterTelemetryThatIsLost) {
  Bench bench(pulsed(R"({at="10 ms",open="130 ms"},{at="0.15 s",open="58 ms",exhaust=true})"));
  const int lost = 3;  // from 120 ms on nothing opens
  bench.in_period(lost, [&](auto& bytes) {
    if (bench.board.periods - bench.first == lost) bytes.clear();
  });
  const Outcome far = bench.run();
  EXPECT_EQ(far.lost, 1u);
  EXPECT_EQ(far.supervised.rejected_commands, 0u);
  const Bench::Opened expected = {{100, 1}, {1'200, 0}, {1'600, 2}, {2'080, 0}};
  EXPECT_EQ(bench.opened, expected);
}

// A line that loses one frame of a start-up: the n-th from the host, or the n-th identity or
// reply of the board, which streams telemetry meanwhile.
struct LosesOne {
  enum class From { host, board } from = From::host;
  int left = 0;

  bool takes() { return left-- == 0; }
  plant::BoardLine at(const plant::BoardLine& inner) {
    return {[this, inner](std::span<const std::uint8_t> frame) {
              return (from == From::host && takes()) || inner.write(frame);
            },
            inner.read, inner.now};
  }
  void answers(std::vector<std::uint8_t>& bytes) {
    for (auto frame = bytes.begin(); from == From::board && frame != bytes.end();) {
      const auto end = frame + link::header_size + frame[4] + link::crc16_size;
      const auto type = static_cast<link::Type>(frame[2]);
      const bool counts = type == link::Type::identity || type == link::Type::answer;
      frame = counts && takes() ? bytes.erase(frame, end) : end;
    }
  }
};

TEST(RemoteBoards, AnyOneFrameOfAStartUpMayBeLost) {
  const experiment::Experiment e = loaded("kick");
  const link::Configuration configuration = configuration_of(e);
  for (const auto from : {LosesOne::From::host, LosesOne::From::board}) {
    bool lost = true;
    for (int n = 0; lost; ++n) {
      ASSERT_LT(n, 100);
      SCOPED_TRACE(n);
      WiredBody body(e);
      BoardInThread board(body.wires());
      LosesOne line{.from = from, .left = n};
      board.spoil = [&](auto& bytes) { line.answers(bytes); };
      plant::RemoteBoard remote(line.at(board.line()), 1, 100);
      ASSERT_NO_THROW(remote.prepare(configuration));
      const auto joints = static_cast<std::uint8_t>(configuration.joint_controller.joints);
      EXPECT_TRUE(remote.command({.from = 0, .periods = 3, .joints = joints}));
      const link::Telemetry* telemetry = remote.next(1.5);
      ASSERT_NE(telemetry, nullptr);
      EXPECT_EQ(telemetry->state, control::BoardState::running);
      EXPECT_LT(board.periods, 150) << "at most one question comes again, after half a second";
      lost = line.left < 0;
    }
  }
}

TEST(RemoteBoards, ARunWhoseFirstCommandIsLostRunsToItsEnd) {
  const experiment::Experiment e = loaded("kick");
  WiredBody body(e);
  BoardInThread board(body.wires());
  const plant::BoardLine inner = board.line();
  int commands = 0;
  const auto write = [&](std::span<const std::uint8_t> frame) {
    const bool command = frame[2] == static_cast<std::uint8_t>(link::Type::command);
    return (command && commands++ == 0) || inner.write(frame);
  };
  plant::RemoteBoard remote({write, inner.read, inner.now}, 1, 100);
  remote.prepare(configuration_of(e));
  const Outcome simulated = run(e), far = run::run(e, {.board = &remote, .lead = 0});
  EXPECT_EQ(far.line, "");
  EXPECT_FALSE(far.ended_early());
  ASSERT_NO_FATAL_FAILURE(expect_same_log(simulated.table, far.table));
}

TEST(RemoteBoards, LostTelemetryIsAGapInTheLogAndACount) {
  Bench bench(loaded("kick"));
  const int lost_from = 50, lost_for = 2;  // the command before is valid for three periods
  bench.in_period(lost_from, [&](auto& bytes) {
    if (bench.board.periods - bench.first < lost_from + lost_for) bytes.clear();
  });
  const Outcome far = bench.run();
  EXPECT_EQ(far.line, "");
  EXPECT_FALSE(far.ended_early());
  EXPECT_EQ(far.lost, std::uint32_t{lost_for});
  const auto& time = far.table.series.front().time_ns;
  const std::int64_t usual = time[1] - time[0];
  int gaps = 0;
  std::int64_t widest = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    gaps += time[i] - time[i - 1] > usual;
    widest = std::max(widest, time[i] - time[i - 1]);
  }
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(widest, (1 + lost_for) * 10'000'000) << "nothing is put between two samples";
}

// Messages with valid checksums but contents that this board cannot have: from another robot's
// board, or from another version.
TEST(RemoteBoards, AValveOrATimeThatTheBoardDoesNotHaveIsLeftOutAndCounted) {
  Bench bench(loaded("kick"));
  const Outcome simulated = run(bench.experiment);
  bench.in_period(50, [&, done = false](auto& bytes) mutable {
    if (std::exchange(done, true)) return;
    link::Edges edges{.tick = 5'000, .count = 3};
    const auto valves = static_cast<std::uint8_t>(only_board(bench.experiment).valve.size());
    edges.edge[0] = {.valve = valves, .open = true};
    edges.edge[1] = {.valve = 200, .open = true};
    edges.edge[2] = {.valve = 255, .open = true};
    link::Edges late{.tick = link::max_tick, .count = 1};
    link::Edges early{.tick = -1, .count = 1};
    for (const link::Edges& m : {edges, late, early}) {
      const link::Bytes frame = link::frame_of(m, {1, 0});
      bytes.insert(bytes.begin(), frame.begin(), frame.end());
    }
  });
  const Outcome far = bench.run();
  EXPECT_FALSE(far.ended_early());
  EXPECT_EQ(far.foreign, 5u);
  ASSERT_NO_FATAL_FAILURE(expect_same_log(simulated.table, far.table));
}

TEST(RemoteBoards, TelemetryOfATimeThatIsNotYetIsLeftOutAndCounted) {
  Bench bench(loaded("kick"));
  const Outcome simulated = run(bench.experiment);
  bench.in_period(50, [&, done = false](auto& bytes) mutable {
    if (std::exchange(done, true)) return;
    link::Telemetry far_ahead{.tick = link::max_tick, .state = control::BoardState::running};
    link::Bytes all;
    for (std::uint8_t p = 0; p < link::parts_of(0, 0); ++p) {
      const link::TelemetryMessage m = link::part_of(far_ahead, p);
      link::Bytes frame(link::max_frame);
      frame.resize(link::encode(static_cast<std::uint8_t>(m.type), {1, 0}, m.body.span(), frame));
      all.insert(all.end(), frame.begin(), frame.end());
    }
    bytes.insert(bytes.begin(), all.begin(), all.end());
  });
  const Outcome far = bench.run();
  EXPECT_EQ(far.line, "");
  EXPECT_FALSE(far.ended_early());
  EXPECT_EQ(far.foreign, 1u);
  EXPECT_EQ(far.lost, 0u);
  ASSERT_NO_FATAL_FAILURE(expect_same_log(simulated.table, far.table));
}

TEST(RemoteBoards, AtAMachineThreeReadingsThatDoNotComeEndTheRun) {
  const experiment::Experiment e =
      loaded("walk-test-1", {"fault=[{at=\"2 s\", of=\"hip_angle\", what=\"dropout\"}]"});
  ASSERT_EQ(configuration_of(e).joint_controller.hold_limit, 0u) << "a simulation bears any number";
  Bench bench(e);
  bench.remote.prepare(bench_configuration_of(e));
  const Outcome far = run::run(e, {.board = &bench.remote, .lead = 0});
  EXPECT_TRUE(far.ended_early());
  EXPECT_NEAR(far.duration, 2.03 + 1, 0.02) << "three scans, then a vent of a second";
  EXPECT_NE(cause_of(e, far).find("late reading of sensor hip_angle"), std::string::npos)
      << cause_of(e, far);
}

TEST(RemoteBoards, AtAMachineMeasuredPressuresSayWhenMusclesAreEmpty) {
  const experiment::Experiment e = loaded("walk-with-pressures");
  const link::Configuration here = configuration_of(e), there = bench_configuration_of(e);
  for (const std::uint16_t at : here.safety.empty_at) EXPECT_EQ(at, 0) << "the simulation's bits";
  const control::Board board = only_board(e);
  std::size_t watched = 0;
  for (std::size_t i = 0; i < there.safety.empty_at.size(); ++i) {
    const bool pressure = i < board.channel.size() &&
                          e.robot.sensors[board.channel[i]].kind == robot::Sensor::Kind::pressure;
    // 0.04 V/psi and 4095 counts of 5 or 10 V; 6 counts of noise.
    const double per_psi = 0.04 * e.robot.converter.counts_per_volt();
    EXPECT_EQ(there.safety.empty_at[i], pressure ? std::ceil(2 * per_psi + 6) : 0) << i;
    watched += pressure;
  }
  EXPECT_EQ(watched, 4u);
  for (const char* unmeasured : {"kick", "cylinder-following", "walk-with-regulators"})
    for (const std::uint16_t at : bench_configuration_of(loaded(unmeasured)).safety.empty_at)
      EXPECT_EQ(at, 0) << unmeasured;
}

// The whole chain, from the robot's file to the dump, for an exhaust that does not open.
TEST(RemoteBoards, AtAMachineAMuscleThatDoesNotEmptyEndsInADump) {
  const std::vector<std::string> stuck = {
      "fault=[{at=\"1 s\", of=\"knee_flexor.exhaust\", what=\"stuck shut\"}]"};
  for (const bool fails : {false, true}) {
    SCOPED_TRACE(fails);
    const experiment::Experiment e =
        loaded("walk-with-pressures", fails ? stuck : std::vector<std::string>{});
    Bench bench(e);
    bench.remote.prepare(bench_configuration_of(e));
    const Outcome far = run::run(e, {.board = &bench.remote, .lead = 0});
    EXPECT_EQ(far.foreign, 0u);
    EXPECT_TRUE(bench.remote.shut_down());
    EXPECT_EQ(bench.remote.state(), fails ? control::BoardState::dump : control::BoardState::idle);
    EXPECT_EQ(bench.remote.fault() == control::BoardFault::not_empty, fails);
  }
}

TEST(RemoteBoards, ABoardWithoutFramesHoldsThenVentsAndTheRunReportsWhy) {
  Bench bench(loaded("walk-test-1"));
  bench.in_period(100, [&](auto&) { bench.board.deaf = true; });
  const Outcome far = bench.run();
  EXPECT_TRUE(far.ended_early());
  const std::string cause = cause_of(bench.experiment, far);
  EXPECT_NE(cause.find("no command for 1 s"), std::string::npos) << cause;
  EXPECT_NEAR(far.duration, 1.0 + 1.0 + 1.0, 0.05) << "silent for a second, then a vent of one";
}

// A whole log of a fault: one line of telemetry per period, up to the state that followed it.
void expect_fault_log(const std::vector<link::Telemetry>& log) {
  ASSERT_EQ(log.size(), 20u);
  for (std::size_t i = 1; i < log.size(); ++i) EXPECT_EQ(log[i].tick, log[i - 1].tick + 100);
  EXPECT_EQ(log.front().state, control::BoardState::running);
  EXPECT_EQ(log.back().state, control::BoardState::vent);
  EXPECT_EQ(log.back().fault, control::BoardFault::supervisor);
}

experiment::Experiment with_an_open_sensor() { return loaded("faults/sensor-open"); }

TEST(RemoteBoards, AFaultsLogIsKeptByTheBoardUntilItIsArmedAgain) {
  Bench bench(with_an_open_sensor());
  const Outcome far = bench.run();
  ASSERT_TRUE(far.ended_early());
  const std::vector<link::Telemetry> log = bench.remote.fault_log();
  expect_fault_log(log);
  EXPECT_EQ(log.back().supervised.trip.at, far.supervised.trip.at);

  const std::string csv = fault_log_csv(log, bench.experiment);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + std::ssize(log));
  const auto commas = [](const std::string& line) {
    std::ptrdiff_t out = 0;
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++out;
    }
    return out;
  };
  const std::size_t first = csv.find('\n'), last = csv.rfind('\n', csv.size() - 2);
  EXPECT_EQ(commas(csv.substr(0, first)), commas(csv.substr(last))) << "a name for each column";
  EXPECT_NE(csv.find(",vent,\"a reading, a command"), std::string::npos) << csv;

  Bench faultless(loaded("kick"));
  (void)faultless.run();
  for (const link::Telemetry& t : faultless.remote.fault_log())
    EXPECT_TRUE(t.fault == control::BoardFault::none || t.fault == control::BoardFault::requested);
}

TEST(RemoteBoards, AFaultsLogComesOverALineThatSpoilsEveryFourthAnswer) {
  Bench bench(with_an_open_sensor());
  (void)bench.run();
  int heard = 0;
  bench.board.spoil = [&](auto& bytes) {
    if (++heard % 4 == 0 && !bytes.empty()) bytes[bytes.size() / 2] ^= 0x10;
  };
  expect_fault_log(bench.remote.fault_log());
  bench.board.spoil = [](auto& bytes) { bytes.clear(); };
  EXPECT_THROW((void)bench.remote.fault_log(), plant::BoardError);
}

TEST(RemoteBoards, ABoardThatIsNotHeardEndsTheRun) {
  Bench bench(loaded("kick"));
  bench.in_period(30, [](auto& bytes) { bytes.clear(); });
  const Outcome far = bench.run();
  EXPECT_TRUE(far.ended_early());
  EXPECT_EQ(far.line, "the board was not heard for 1.5 s");
  EXPECT_EQ(cause_of(bench.experiment, far).find(far.line), 0u);
}

TEST(RemoteBoards, ALineThatGoesEndsTheRun) {
  Bench bench(loaded("kick"));
  bench.in_period(30, [&](auto& bytes) {
    bytes.clear();
    bench.board.gone = true;
  });
  const Outcome far = bench.run();
  EXPECT_TRUE(far.ended_early());
  EXPECT_EQ(far.line, "the line to the board is gone");
  EXPECT_NEAR(far.duration, 0.3, 0.02);
}

TEST(RemoteBoards, ABoardThatIsResetInMidRunIsNotTakenForOneThatGoesOn) {
  Bench bench(loaded("kick"));
  bool once = false;
  bench.in_period(30, [&](auto&) {
    if (!once) bench.board.resets = true;
    once = true;
  });
  const Outcome far = bench.run();
  EXPECT_TRUE(far.ended_early());
  EXPECT_NE(far.line.find("it was switched on or reset"), std::string::npos) << far.line;
}

TEST(RemoteBoards, ASecondRunOnTheSameBoardIsTheFirstAgain) {
  Bench bench(loaded("kick"));
  const Outcome first = bench.run();
  Bench other(loaded("kick"));
  (void)other.run();
  plant::RemoteBoard again(other.board.line(), 1, 100);
  EXPECT_NO_THROW(again.prepare(configuration_of(other.experiment)))
      << "a run that has ended leaves the board to the next host";
  EXPECT_FALSE(first.ended_early());
}

TEST(RemoteBoards, SeveralBoardsAreRefused) {
  const experiment::Experiment two =
      loaded("cylinder-following", {"cylinder.board=2", "wiring.present=false"});
  try {
    configuration_of(two);
    FAIL() << "two boards on one line";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("driven by 2 boards; expected one"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace sinew::run::remote_boards_test
