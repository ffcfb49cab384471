// A tick that a board's clock has missed is reported by the run: as a count, in the log, in the
// summary and in a warning.
#include "sinew/run/simulation/run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/analysis/summary.h"
#include "sinew/analysis/warnings.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/run/simulation/test_board.h"
#include "sinew/run/simulation/wired_body.h"
#include "tests/places.h"

namespace sinew::run::outcome_test {
namespace {

constexpr int period_of_it = 80;  // number of 10 ms periods of the run

struct Missed {
  Missed(std::uint32_t ticks, const std::vector<std::string>& sets)
      : experiment(experiment::load(sinew::test::source_dir() + "/experiments/kick.toml", sets)) {
    WiredBody body(experiment);
    BoardInThread board(body.wires());
    plant::RemoteBoard remote(board.line(), 1, 100);
    remote.prepare(configuration_of(experiment));
    const int first = board.periods;
    board.spoil = [&](std::vector<std::uint8_t>&) {
      if (board.periods - first == period_of_it) board.misses = ticks;
    };
    out = run::run(experiment, {.board = &remote, .lead = 0});
  }

  experiment::Experiment experiment;
  Outcome out;
};

TEST(MissedTicks, AreCountedAndReported) {
  for (const std::uint32_t ticks : {1u, 2u, 30u}) {
    const Missed run(ticks, {});
    EXPECT_FALSE(run.out.ended_early());
    EXPECT_EQ(run.out.supervised.gaps, 1u);
    EXPECT_EQ(run.out.supervised.worst_gap, ticks);
    const std::string words =
        "1 tick came later than announced, by " + std::to_string(ticks) + " at worst";
    const std::vector<std::string> told = warnings_outside_log(run.experiment, run.out);
    EXPECT_EQ(std::ranges::count(told, words), 1) << words;
  }
}

TEST(MissedTicks, AreNotReportedIfThereAreNone) {
  const Missed run(0, {});
  EXPECT_EQ(run.out.supervised.gaps, 0u);
  for (const std::string& warning : warnings_outside_log(run.experiment, run.out))
    EXPECT_EQ(warning.find("came later than announced"), std::string::npos) << warning;
}

// If an experiment's readings are supervised, its log has the count.
TEST(MissedTicks, AreInTheLogAndTheSummaryFromThatPeriodOn) {
  const Missed run(7, {"low_level.command_rate=100 rad/s"});
  const signals::Series* gaps = run.out.table.find("/low_level/gaps");
  ASSERT_NE(gaps, nullptr);
  const auto& so_far = gaps->columns.front();
  const auto first = std::ranges::find(so_far, 1.0) - so_far.begin();
  ASSERT_LT(first, std::ssize(so_far));
  EXPECT_EQ(so_far.back(), 1.0);
  const double at = 1e-9 * static_cast<double>(gaps->time_ns[static_cast<std::size_t>(first)]);
  EXPECT_NEAR(at, 0.01 * period_of_it, 0.021);

  const std::vector<analysis::Warning> told = analysis::rejected_commands(run.out.table);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told.front().text, "1 tick came later than announced");
  const analysis::Summary summary =
      analysis::summarize(run.out.table, {.robot = run.experiment.robot});
  ASSERT_NE(summary.find("low_level.gaps"), nullptr);
  EXPECT_EQ(*summary.find("low_level.gaps"), 1.0);
}

TEST(MissedTicks, TenMillisecondsEndTheRunAndAreReportedAsTheCause) {
  const Missed run(100, {});
  EXPECT_TRUE(run.out.ended_early());
  const std::string cause = cause_of(run.experiment, run.out);
  EXPECT_NE(cause.find("a tick came 100 ticks or more too late"), std::string::npos) << cause;
  EXPECT_EQ(run.out.supervised.worst_gap, 100u);
}

}  // namespace
}  // namespace sinew::run::outcome_test
