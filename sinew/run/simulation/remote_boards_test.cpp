// A run whose joint controllers are a board's program at the end of a line.
#include "sinew/run/simulation/remote_boards.h"

#include <gtest/gtest.h>

#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/test_board.h"
#include "sinew/run/simulation/test_log.h"
#include "sinew/run/simulation/wired_body.h"

namespace sinew::run {
namespace {

using control::Trip;

experiment::Experiment loaded(const std::string& name, std::vector<std::string> sets = {}) {
  return experiment::load(SINEW_SOURCE_DIR "/experiments/" + name + ".toml", sets);
}

// A board at the wires of a simulated body, ready to run.
struct Bench {
  explicit Bench(const experiment::Experiment& e)
      : experiment(e), body(e), board(body.wires()), remote(board.line(), 1, 100) {}

  Outcome run() {
    remote.prepare(configuration_of(experiment));
    first = board.periods;
    return run::run(experiment, {.board = &remote, .lead = 0});
  }
  // `what` happens in a period of the run, before the host hears what the board said in it.
  void in_period(int which, std::function<void(std::vector<std::uint8_t>&)> what) {
    board.spoil = [this, which, what](std::vector<std::uint8_t>& bytes) {
      if (first >= 0 && board.periods - first >= which) what(bytes);
    };
  }

  experiment::Experiment experiment;
  WiredBody body;
  BoardInThread board;
  plant::RemoteBoard remote;
  int first = -1;  // period of the run, by the board's count
};

TEST(RemoteBoards, ABoardsProgramHasTheSimulationsLogBitForBit) {
  for (const char* name : {"kick", "one-joint", "walk-test-1"}) {
    SCOPED_TRACE(name);
    experiment::Experiment e = loaded(name);
    Bench bench(e);
    const Outcome simulated = run(e), far = bench.run();
    EXPECT_EQ(far.line, "");
    EXPECT_FALSE(far.ended_early());
    EXPECT_EQ(far.lost, 0u);
    EXPECT_EQ(simulated.duration, far.duration);
    ASSERT_NO_FATAL_FAILURE(expect_same_log(simulated.table, far.table));
  }
}

TEST(RemoteBoards, LostTelemetryIsAGapInTheLogAndACount) {
  Bench bench(loaded("kick"));
  const int lost_from = 50, lost_for = 2;  // the command of before is good for three periods
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

TEST(RemoteBoards, ABoardThatHearsNothingHoldsThenVentsAndTheRunSaysWhy) {
  Bench bench(loaded("walk-test-1"));
  bench.in_period(100, [&](auto&) { bench.board.deaf = true; });
  const Outcome far = bench.run();
  EXPECT_TRUE(far.ended_early());
  const std::string cause = cause_of(bench.experiment, far);
  EXPECT_NE(cause.find("no command for 1 s"), std::string::npos) << cause;
  EXPECT_NEAR(far.duration, 1.0 + 1.0 + 1.0, 0.05) << "silent for a second, then a vent of one";
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
}  // namespace sinew::run
