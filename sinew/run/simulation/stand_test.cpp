// Experiments on the stand: files, their contradictions, repeatable runs, sweeps, the drive's laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/config/diagnostics.h"
#include "sinew/gas/pulse.h"
#include "sinew/run/controllers/drive.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/run/simulation/test_same.h"
#include "sinew/world/stand.h"
#include "tests/places.h"

namespace sinew::run::stand_test {
namespace {

namespace fs = std::filesystem;
using experiment::Experiment;

const std::string folder = sinew::test::source_dir() + "/experiments/rig/";

std::vector<fs::path> all_files() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

TEST(RigFiles, ResolvedOnesRunAgainWithTheSameBits) {
  const fs::path copy = fs::path(testing::TempDir()) / "resolved.toml";
  for (const fs::path& file : all_files()) {
    SCOPED_TRACE(file.filename().string());
    Experiment e = experiment::load(file.string());
    e.stand->duration = std::min(e.stand->duration, 0.7);
    if (e.stand->sweep.step > 0) e.stand->sweep.to = e.stand->sweep.from + 2 * e.stand->sweep.step;
    std::ofstream(copy) << experiment::resolved(e, "0");
    const Experiment again = experiment::load(copy.string());
    expect_same(run(e).table, run(again).table);
    EXPECT_TRUE(run(e).table.complete);
  }
}

// The muscle must contain air at each prescribed length.
TEST(RigFiles, ALengthWithoutVolumeIsRefusedByItsKey) {
  const auto refusal = [](const std::vector<std::string>& sets) -> std::string {
    try {
      experiment::load(folder + "length-sweep.toml", sets);
    } catch (const config::Error& e) {
      return e.what();
    }
    return "none";
  };
  const std::string lengths =
      R"(load.lengths=[{at="0 s",length="3 in"},{at="20 s",length="4.3 in"}])";
  EXPECT_EQ(refusal({lengths}), "none");
  const std::string text = refusal({lengths, "element.external_volume=0 m3"});
  EXPECT_NE(text.find("load.lengths[1].length: found a chamber without volume"), text.npos) << text;
  EXPECT_NE(
      refusal({"log.period=0.1 ms", "duration=1e5 s"}).find("log.period: found 1e+09 samples"),
      std::string::npos);
}

// A load stretches the muscle beyond its thread's length, where it has no volume: the run ends with
// the element, the time and the cause.
TEST(RigRun, AirThatVanishesEndsTheRun) {
  Experiment e = experiment::load(folder + "pwm-25hz-5lb.toml");
  e.stand->element.external_volume = 0;
  e.stand->load.mass = 45;
  const Outcome out = run(e);
  ASSERT_EQ(out.failure.of, air::Failure::Of::air);
  EXPECT_GT(out.failure.time, 0.01);
  EXPECT_LT(out.failure.time, 0.2);
  const std::string cause = cause_of(e, out);
  EXPECT_NE(cause.find("the air of element bpa was not finite at "), cause.npos) << cause;
}

// A third of the gravity and three times the mass give the same weight: the load hangs at the same
// length.
TEST(RigRun, AWeightIsMassTimesTheGravityOfTheFile) {
  const auto hangs = [](const std::vector<std::string>& sets) {
    return plant::hanging_length(stand_setup(experiment::load(folder + "trapped-60-6.toml", sets)));
  };
  const double on_earth = hangs({});
  EXPECT_EQ(hangs({"load.gravity=9.80665 m/s2"}), on_earth)
      << "the standard one, unless it is said";
  EXPECT_NEAR(hangs({"load.gravity=4.903325 m/s2", "load.mass=12 lb"}), on_earth, 1e-12);
  EXPECT_GT(on_earth, hangs({"load.gravity=1.62 m/s2"}) + 1e-3) << "on the moon it weighs less";
}

TEST(RigRun, EveryTickVisitedIsTheSameRun) {
  for (const char* name : {"feedback.toml", "pwm-25hz-5lb.toml", "pressure-steps.toml"}) {
    Experiment e = experiment::load(folder + name);
    e.stand->duration = 2;
    expect_same(run(e).table, run(e, {.every_tick = true}).table);
  }
}

TEST(RigRun, ThreadsOfASweepChangeNothing) {
  Experiment e = experiment::load(folder + "duty-sweep.toml");
  e.stand->duration = 0.5;
  e.stand->sweep = {.from = 0.2, .to = 0.4, .step = 0.05};
  const Outcome one = run(e, {.threads = 1});
  expect_same(one.table, run(e, {.threads = 3}).table);
  ASSERT_EQ(one.table.column("/sweep/duty")->size(), 5u);
}

// A row of a sweep equals the run with that duty alone.
TEST(RigRun, ASweepIsItsRuns) {
  Experiment e = experiment::load(folder + "duty-sweep.toml");
  e.stand->sweep = {.from = 0.3, .to = 0.4, .step = 0.1};
  e.stand->duration = 1;
  const double swept = (*run(e).table.column("/true/sweep/length"))[1];
  e.stand->sweep = {};
  e.stand->drive.duty = 0.4;
  e.log.period = 1e-4;
  const signals::Table table = run(e).table;
  const signals::Column& length = *table.column("/true/stand/length");
  double sum = 0;
  for (std::size_t i = 8000; i < 10000; ++i) sum += length[i];
  EXPECT_NEAR(swept, sum / 2000, 1e-12);
}

// With the valve's delays, 50 % equals 42.5 % of an ideal valve, shifted by the opening delay.
TEST(RigRun, CommandedDutyThroughDelaysIsTheDeliveredOne) {
  Experiment delayed = experiment::load(folder + "pwm-25hz-5lb.toml");
  delayed.stand->element.inlet = "758";
  delayed.stand->drive.duty = 0.5;
  Experiment ideal = delayed;
  ideal.stand->element.inlet = "ideal";
  ideal.stand->drive.duty = gas::delivered_duty(0.5, 0.04, 0.004, 0.001);
  EXPECT_DOUBLE_EQ(ideal.stand->drive.duty, 0.425);
  const auto mean = [](const Experiment& e) {
    Experiment one = e;
    one.stand->sweep = {.from = e.stand->drive.duty, .to = e.stand->drive.duty + 0.01, .step = 1};
    return run(one).table;
  };
  const signals::Table a = mean(delayed), b = mean(ideal);
  const auto first = [](const signals::Table& of, const char* what) {
    return (*of.column(what))[0];
  };
  EXPECT_NEAR(first(a, "/true/sweep/length"), first(b, "/true/sweep/length"), 1e-5);
  EXPECT_NEAR(first(a, "/true/sweep/pressure") / first(b, "/true/sweep/pressure"), 1, 1e-3);
}

// Feedback uses counts: despite noise and an unknown load it moves the muscle back.
TEST(RigRun, PulsesThatFollowEachOtherAreOneLongPulse) {
  const auto table = [](const std::string& pulses) {
    return run(experiment::load(
                   sinew::test::source_dir() + "/experiments/rig/isometric.toml",
                   {"duration=1 s", "drive.period=40 ms", "drive.pulses=[" + pulses + "]"}))
        .table;
  };
  const signals::Table one = table(R"({at="30 ms",open="60 ms"})");
  for (const char* pulses : {R"({at="30 ms",open="20 ms"},{at="50 ms",open="40 ms"})",
                             R"({at="50 ms",open="40 ms"},{at="30 ms",open="20 ms"})",
                             R"({at="30 ms",open="10 ms"},{at="40 ms",open="50 ms"})",
                             R"({at="30 ms",open="60 ms"},{at="0.5 s",open="0.01 ms"})"}) {
    SCOPED_TRACE(pulses);
    ASSERT_NO_FATAL_FAILURE(expect_same(one, table(pulses)));
  }
}

TEST(RigRun, FeedbackGoesBackAfterATug) {
  const Experiment e = experiment::load(folder + "feedback.toml");
  const signals::Table table = run(e).table;
  const signals::Column& length = *table.column("/true/stand/length");
  const signals::Column& desired = *table.column("/desired/length");
  const signals::Column& counts = *table.column("/sensor/length/count");
  EXPECT_NEAR(length.back(), desired.back(), 0.05 * 0.0254);
  EXPECT_NEAR(robot::quantity(e.stand->sensors[0], counts.back()), length.back(), 0.005 * 0.0254);
  // Two more pounds stretch it while the valves rest
  EXPECT_GT(length[6100], length[5990]);
}

// --- a stand that the caller controls ------------------------------------------------------------

constexpr const char* driven_stands[] = {"feedback",       "feed-forward",    "pwm-25hz-5lb",
                                         "pressure-steps", "feedback-on-off", "creep"};

Experiment stand_of(const std::string& name) { return experiment::load(folder + name + ".toml"); }

std::vector<double> values(Simulation& s) {
  std::vector<double> out;
  for (std::size_t i = 0; i < s.channels().size(); ++i) out.push_back(s.read(i));
  return out;
}

// Advanced in any steps, read, saved and restored, in the same object or another: the same bits.
TEST(StandSimulation, CutsReadsAndSavesLeaveNoTrace) {
  std::mt19937 random(7);
  for (const char* name : driven_stands) {
    const Experiment e = stand_of(name);
    Simulation straight(e), cut(e);
    straight.advance_to(16000);
    while (cut.tick() < 16000) {
      cut.advance_to(std::min<signals::Tick>(16000, cut.tick() + random() % 700));
      (void)values(cut);
      const std::vector<std::byte> saved = cut.save();
      if (random() % 3 > 0) continue;
      cut.advance_by(0.05);
      cut.restore(saved);
    }
    EXPECT_EQ(values(straight), values(cut)) << name;
    Simulation other(e);
    other.restore(cut.save());
    other.advance_by(0.3);
    straight.advance_by(0.3);
    EXPECT_EQ(values(straight), values(other)) << name;
    EXPECT_EQ(straight.cause(), "") << name;
  }
}

TEST(StandSimulation, ASaveOfAnotherStandIsRefused) {
  Simulation one(stand_of("feedback")), other(stand_of("creep"));
  EXPECT_THROW(other.restore(one.save()), std::invalid_argument);
  EXPECT_TRUE(one.settings().empty());
  EXPECT_THROW(one.change("control.stiffness.hip", 1), std::invalid_argument);
}

TEST(StandSimulation, PacedAndWatchedIsTheSameRun) {
  Experiment e = stand_of("feedback");
  e.stand->duration = 1;
  const signals::Table alone = run(e).table;
  expect_same(alone, run(e, {.pace = 100}).table);
  expect_same(alone, run(e, {.extra_readers = 3}).table);
}

// --- files that contradict themselves -----------------------------------------------------------

std::string refusal(const std::string& name, const std::vector<std::string>& sets) {
  try {
    buildable(folder + name, sets);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "nothing";
}

TEST(RigFiles, SayWhatIsWrongWithThem) {
  const auto says = [](const std::vector<std::string>& sets, const std::string& what,
                       const std::string& name = "pwm-25hz-5lb.toml") {
    const std::string text = refusal(name, sets);
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  EXPECT_EQ(refusal("pwm-25hz-5lb.toml", {}), "nothing");
  says({"element.actuator=bpa"}, "element.actuator: found \"bpa\"; expected");
  says({"element.inlet=\"759\""}, "try \"758\"");
  says({"element.inlet=inlet"}, "element.exhaust: found \"\"");
  says({"element.exhaust=exhaust"}, "element.exhaust: found a key of a 2-way inlet");
  says({"load.mode=driven"}, "load.mass: found a key of mode = \"hanging\"");
  says({"load.mass=0 lb"}, "the mass must be above 0");
  says({"load.length=3 in"}, "load.length: found a key of mode = \"driven\"");
  says({"charge.mode=sealed"}, "drive.kind: found a key of charge.mode = \"valves\"");
  says({"charge.pressure=60 psi gauge"}, "charge.pressure: found a key of mode = \"regulated\"");
  says({"drive.duty=1.2"}, "drive.duty: found 1.2");
  says({"drive.period=20.03 ms"}, "drive.period: found no whole ticks");
  says({"drive.kind=feedback"}, "drive.desired: found none");
  says({"drive.gain=1 1/in"}, "drive.gain: found a key of kind = \"feedback\"");
  says({R"(drive.pulses=[{at="1 s",open="1 ms"},{at="1.02 s",open="1 ms"}])"},
       "drive.pulses[1]: found a second pulse of the inlet in one drive.period, 0.04 s",
       "isometric.toml");
  says({"drive.lenghts=1"}, "drive.lenghts");
  says({"drive.sensor=force"}, "drive.sensor: found \"force\"; expected length", "feedback.toml");
  says({"sensor.length.high=1 in"}, "sensor.length.high: found no range", "feedback.toml");
  says({"sweep.to=0"}, "sweep.to: found no more than from", "duty-sweep.toml");
  says({"load.mass=5000 lb"}, "hangs nowhere", "trapped-60-6.toml");
  says({"start.length=100 in"}, "start.length: found 100 in; expected at most",
       "trapped-60-6.toml");
  says({"start.pressure=4000 psi gauge"}, "start.pressure: found", "trapped-60-6.toml");
  says({"measured.from=60 s"}, "measured.from: found no row", "weights-60.toml");
}

TEST(RigFiles, OtherFormatsAreRefused) {
  const fs::path file = fs::path(testing::TempDir()) / "newer.toml";
  std::ofstream(file) << "format = \"sinew.rig/2\"\n";
  try {
    experiment::load(file.string());
    ADD_FAILURE();
  } catch (const config::Error& e) {
    EXPECT_NE(std::string(e.what()).find("\"sinew.rig/1\" or older"), std::string::npos);
  }
  try {
    experiment::load(sinew::test::source_dir() + "/robots/leg/valves.toml");
    ADD_FAILURE();
  } catch (const config::Error& e) {
    EXPECT_NE(std::string(e.what()).find("expected \"sinew.experiment/2\""), std::string::npos);
  }
}

// --- laws ---------------------------------------------------------------------------------------

TEST(DriveLaws, TheSteadyDutyLetsInWhatItLetsOut) {
  const gas::Air air;
  const gas::Flow flow{.area = 1.7e-6, .efficiency = 0.85};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> pressure(1.1e5, 7e5);
  for (int i = 0; i < 50; ++i) {
    const double p = pressure(random), d = steady_duty(flow, flow, air, 7.9e5, p);
    const double in = gas::mass_flow(flow, air, 7.9e5, p);
    const double out = gas::mass_flow(flow, air, p, air.atmosphere);
    EXPECT_NEAR(d * in, (1 - d) * out, 1e-12 * in);
  }
  EXPECT_EQ(steady_duty(flow, flow, air, 7.9e5, 7.9e5), 1);
  EXPECT_EQ(steady_duty(flow, flow, air, 7.9e5, air.atmosphere), 0);
}

TEST(DriveLaws, TheCommandedDutyIsTheDeliveredOneBackwards) {
  for (double d : {0.0, 0.2, 0.425, 0.8, 1.0}) {
    const double told = commanded_duty(d, 0.004, 0.001, 0.04);
    EXPECT_NEAR(gas::delivered_duty(told, 0.04, 0.004, 0.001), d, 1e-12);
  }
}

TEST(DriveLaws, TheHoldingPressureHolds) {
  const actuator::Bundle bundle{.actuator = actuator::thesis_actuator(), .count = 2};
  for (double load : {5.0, 20.0, 60.0}) {
    const double p = holding_pressure(bundle, 0.08, load, units::atmosphere, 8e5);
    EXPECT_NEAR(
        actuator::clamped_tension(bundle, 0.08, 0, p - units::atmosphere, units::atmosphere), load,
        1e-6);
  }
  EXPECT_NEAR(holding_pressure(bundle, 0.08, 1e6, units::atmosphere, 8e5), 8e5, 1);
}

TEST(DriveLaws, FeedbackOpensTheValveThatHelps) {
  EXPECT_EQ(on_off(0.02, 0.01, false, 0).inlet, 1);
  EXPECT_EQ(on_off(-0.02, 0.01, false, 0).exhaust, 1);
  EXPECT_EQ(on_off(0.005, 0.01, false, 0).inlet + on_off(0.005, 0.01, false, 0).exhaust, 0);
  EXPECT_EQ(on_off(0.005, 0.01, true, 1).inlet, 1);  // a 3-way valve stays where it was
  EXPECT_DOUBLE_EQ(proportional(0.1, 2, 0.01, true, 0.3).inlet, 0.5);
  EXPECT_DOUBLE_EQ(proportional(-0.1, 2, 0.01, false, 0).exhaust, 0.2);
  EXPECT_EQ(proportional(9, 2, 0.01, false, 0).inlet, 1);
  EXPECT_EQ(proportional(0.009, 2, 0.01, false, 0).inlet, 0);
}

}  // namespace
}  // namespace sinew::run::stand_test
