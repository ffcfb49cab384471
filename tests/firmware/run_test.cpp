// Whole experiments on the real program in the emulator: in lock step with the simulated leg, and
// over the emulated board's serial line as a user would run them.
#include <gtest/gtest.h>

#include "sinew/run/simulation/place.h"
#include "sinew/run/simulation/test_log.h"
#include "tests/firmware/images.h"
#include "tests/places.h"

namespace sinew::firmware {
namespace {

struct Script {
  const char* experiment;
  std::vector<std::string> sets;
};

experiment::Experiment loaded(const Script& script) {
  return experiment::load(
      sinew::test::source_dir() + "/experiments/" + std::string(script.experiment) + ".toml",
      script.sets);
}

run::Outcome run_at(const std::string& port, const experiment::Experiment& e) {
  run::Place place(port, e);
  place.prepare();
  run::RunOptions options;
  place.apply(options);
  return run::run(e, options);
}

const Script five_minutes{"endurance", {"sequence.repeat=99"}};

class OnTheRealProgram : public testing::TestWithParam<Script> {};

// Short ones twice: the emulator's behaviour depends only on the experiment.
TEST_P(OnTheRealProgram, TheLogIsTheSimulationsBitForBit) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  const experiment::Experiment e = loaded(GetParam());
  const run::Outcome simulated = run::run(e, {});
  for (int i = 0; i < (simulated.duration < 60 ? 2 : 1); ++i) {
    const run::Outcome far = run_at("lock-step:" + image("lock-step"), e);
    EXPECT_EQ(far.line, "");
    EXPECT_EQ(far.lost, 0u);
    EXPECT_EQ(far.ended_early(), simulated.ended_early());
    EXPECT_EQ(far.duration, simulated.duration);
    ASSERT_NO_FATAL_FAILURE(run::expect_same_log(simulated.table, far.table));
  }
}

// Test 1 is table 6-4's; the last one runs for five minutes.
INSTANTIATE_TEST_SUITE_P(
    LockStep, OnTheRealProgram,
    testing::Values(Script{"walk-test-1", {}}, Script{"walk-test-2", {}}, Script{"kick", {}},
                    Script{"cylinder-following", {}}, Script{"walk-with-ankle", {}},
                    Script{"feed-forward-cycling", {}}, Script{"faults/sensor-open", {}},
                    Script{"rig/feedback", {"log.period=400 ms"}},
                    Script{"rig/isometric", {"log.period=40 ms", "duration=13 s"}}, five_minutes),
    [](const auto& script) {
      std::string name = script.param.experiment;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

TEST(LockStep, TheLongScriptIsFiveMinutes) {
  EXPECT_GE(
      signals::tick_seconds * static_cast<double>(experiment::last_tick(loaded(five_minutes))),
      300);
}

TEST(EmulatedBoard, WalksOverItsSerialLine) {
  if (missing()) GTEST_SKIP() << what_is_missing;
  const experiment::Experiment e = loaded({"kick", {}});
  const run::Outcome far = run_at("emulated:" + image("application-mps2_an386"), e);
  EXPECT_EQ(far.line, "");
  EXPECT_FALSE(far.ended_early());
  EXPECT_EQ(far.supervised.gaps, 0u) << "ticks that were missed";
  // A computer that is busy with other work may be late with a command, never with many.
  EXPECT_LE(far.lost, 3u);
  const run::Outcome simulated = run::run(e, {});
  EXPECT_NEAR(far.duration, simulated.duration, 0.025) << "its plan comes a period later";
}

}  // namespace
}  // namespace sinew::firmware
