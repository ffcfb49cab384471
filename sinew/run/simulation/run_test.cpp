// The whole loop: same bits for any observation, no allocation, convergence, and refusals.
#include "sinew/run/simulation/run.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/control/setup/supervision.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/clock.h"
#include "sinew/run/simulation/loop.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/run/simulation/test_same.h"
#include "sinew/world/machine.h"
#include "tests/counted_heap.h"
#include "tests/places.h"

namespace sinew::run::run_test {
namespace {

using test::allocations;
using test::counting;

const std::string source = sinew::test::source_dir();

experiment::Experiment walk(std::vector<std::string> sets = {}) {
  sets.push_back("sequence.repeat=1");  // one step is enough for these
  return experiment::load(source + "/experiments/walk-test-1.toml", sets);
}

TEST(Run, TwiceTheSameBits) {
  const experiment::Experiment e = walk();
  const Outcome a = run(e), b = run(e);
  EXPECT_EQ(a.status, signals::Status::ok);
  EXPECT_TRUE(a.table.complete);
  EXPECT_EQ(a.nodes, b.nodes);
  expect_same(a.table, b.table);
}

TEST(Run, ExtraReadersChangeNothing) {
  const experiment::Experiment e = walk();
  expect_same(run(e).table, run(e, {.extra_readers = 3}).table);
}

TEST(Run, VisitingEveryTickChangesNothing) {
  const experiment::Experiment e = walk();
  expect_same(run(e).table, run(e, {.every_tick = true}).table);
}

// Reads and changes a run while it is advanced.
TEST(Run, HeldTakesNoMemory) {
  for (const char* name : {"walk-test-1", "walk-with-hoses", "walk-with-regulators",
                           "cylinder-following", "faults/sensor-open"}) {
    Simulation held(
        experiment::load(source + "/experiments/" + name + ".toml", {"sequence.repeat=1"}));
    const std::size_t angle = held.find("/true/joint/hip/angle");
    allocations = 0;
    counting = true;
    held.advance_to(held.last() / 4);
    (void)held.read(angle);
    held.change("control.stiffness.hip", 1.0);
    held.advance_to(held.last() / 2);
    counting = false;
    EXPECT_EQ(allocations, 0) << name;
  }
}

TEST(Run, ThreadsChangeNothing) {
  const experiment::Experiment e = walk();
  const Outcome alone = run(e);
  Outcome together[3];
  std::vector<std::thread> threads;
  for (Outcome& o : together) threads.emplace_back([&] { o = run(e); });
  for (std::thread& t : threads) t.join();
  for (const Outcome& o : together) expect_same(alone.table, o.table);
}

// A row has a reading of every sensor, also before the first period of the laws is over.
TEST(Run, NoRowIsBeforeTheFirstReading) {
  for (const std::string period : {"0.1", "0.2", "0.5", "1", "5", "7", "10"})
    for (const std::string ticks : {"100", "200"}) {
      const Outcome o = run(experiment::load(
          source + "/experiments/one-joint.toml",
          {"log.period=" + period + " ms", "low_level.pwm_ticks=" + ticks,
           "control.high_level_period=20 ms", "start.settle=0 s", "sequence.repeat=1"}));
      const signals::Series& counts = *o.table.find("/sensor/lever_angle/count");
      for (const double count : counts.columns[0]) ASSERT_GT(count, 1000) << period << ticks;
      EXPECT_LT(counts.time_ns.front(), 20'000'000) << period << ticks;
    }
}

TEST(Run, AFasterLogSeesTheSameRun) {
  const Outcome slow = run(walk()), fast = run(walk({"log.period=0.5 ms"}));
  const auto& a = *slow.table.find("/valve/hip_flexor/inlet/open");
  const auto& b = *fast.table.find("/valve/hip_flexor/inlet/open");
  EXPECT_EQ(a.time_ns, b.time_ns);
  EXPECT_EQ(slow.nodes, fast.nodes);
  EXPECT_GT(fast.table.find("/true/trolley/position")->time_ns.size(),
            19 * slow.table.find("/true/trolley/position")->time_ns.size());
}

// A log replayed through the controller gives the edges that it contains.
TEST(Run, ARecordedRunReplaysItsOwnEdges) {
  const experiment::Experiment e = walk();
  const Outcome recorded = run(e), again = replay(e, recorded.table);
  std::size_t edges = 0;
  for (const signals::Series& s : recorded.table.series) {
    if (s.topic.name.rfind("/valve/", 0) != 0) continue;
    const signals::Series* t = again.table.find(s.topic.name);
    ASSERT_NE(t, nullptr);
    EXPECT_EQ(s.time_ns, t->time_ns) << s.topic.name;
    EXPECT_EQ(s.columns, t->columns) << s.topic.name;
    edges += s.time_ns.size();
  }
  EXPECT_GT(edges, 200u);
}

TEST(Run, ALogWithoutASensorCannotBeReplayed) {
  const experiment::Experiment e = walk();
  try {
    replay(e, signals::Table{});
    FAIL();
  } catch (const std::invalid_argument& problem) {
    EXPECT_STREQ(problem.what(), "the log has no /sensor/cylinder_position/count");
  }
}

// However a plan ends, one row follows its sequence, with the final state.
TEST(Run, TheLastRowStandsAfterTheSequence) {
  const Outcome vents = run(walk());
  const std::vector<double> end = vents.table.find("/plan/phase")->columns[0].in_memory();
  const auto after =
      static_cast<std::size_t>(std::find(end.rbegin(), end.rend(), 2.0).base() - end.begin());
  ASSERT_LT(after, end.size());

  for (const char* set : {"sequence.finish=hold", "low_level.vent_time=0 s"}) {
    const Outcome o = run(walk({set}));
    const auto& phase = o.table.find("/plan/phase")->columns[0];
    ASSERT_EQ(phase.size(), after + 1) << set;
    EXPECT_EQ(phase.back(), -1) << set;
    const auto& x = o.table.find("/true/trolley/position")->columns[0];
    // The exhausts of the run that vents have been open for 1.2 ms there.
    EXPECT_NEAR(x.back(), vents.table.find("/true/trolley/position")->columns[0][after], 1e-5)
        << set;
  }
  // With hold, the laws continue; without a vent, the valves stay shut.
  const auto last = [](const Outcome& o, const char* topic) {
    return o.table.find(topic)->columns[0].back();
  };
  EXPECT_EQ(last(run(walk({"low_level.vent_time=0 s"})), "/muscle/knee_flexor/inlet_duty"), 0);
}

// Runs an experiment, checks that its loop allocates no memory, and returns the record.
signals::Table expect_no_heap(const experiment::Experiment& e, signals::Tick end,
                              Steering* steering = nullptr) {
  Simulation simulation(e, steering);
  Recorder recorder(e, simulation.columns(), simulation.controllers(), simulation.machine(), end);
  SimulatedClock clock;

  allocations = 0;
  counting = true;
  simulation.advance(end, clock, recorder);
  counting = false;
  EXPECT_EQ(simulation.cause(), "") << e.name;
  EXPECT_EQ(allocations, 0) << e.name;
  return recorder.take();
}

// No allocation while it runs, and before it only page locations per hour of recording.
TEST(Run, TakesNoMemoryForItsDuration) {
  const auto walk_for = [](int steps) {
    return experiment::load(source + "/experiments/walk-test-1.toml",
                            {"sequence.repeat=" + std::to_string(steps)});
  };
  const experiment::Experiment e = walk_for(80);  // some pages of each column
  expect_no_heap(e, experiment::last_tick(e));

  const Controllers controllers(e, nullptr);
  const auto taken_for = [&](double hours) {
    const auto end = std::llround(3600 * hours / signals::tick_seconds);
    test::bytes = 0;
    counting = true;
    const Recorder recorder(e, columns(e), controllers, nullptr, end);
    counting = false;
    return static_cast<double>(test::bytes);
  };
  const double short_run = taken_for(1), long_run = taken_for(11);
  EXPECT_LT(short_run, 20e6);
  EXPECT_LT((long_run - short_run) / 10, 100e3);
  EXPECT_GT(long_run, short_run);
}

TEST(Run, NoHeapInTheLoop) {
  const auto no_heap = [](const experiment::Experiment& e) {
    return expect_no_heap(e, experiment::last_tick(e));
  };
  EXPECT_GT(no_heap(walk()).find("/plan/phase")->time_ns.size(), 300u);
  no_heap(
      walk({"air.supply.kind=tank", "air.supply.volume=1 L",
            "air.supply.initial_pressure=100 psi gauge", "air.wall_time=0.3 s",
            "muscle.hip_flexor.hose.law=pipe", "muscle.hip_flexor.hose.length=1 m",
            "muscle.hip_flexor.hose.inner_diameter=2.5 mm", "muscle.hip_flexor.hose.volume=5 mL",
            "muscle.knee_flexor.leak.area=0.01 mm2", "valve.exhaust.fails_above=90 psi diff"}));
  no_heap(experiment::load(source + "/experiments/walk-with-ankle.toml", {"sequence.repeat=1"}));
  for (const char* name :
       {"feedback", "feed-forward", "pwm-25hz-15lb", "pressure-steps", "trapped-60-6"}) {
    const auto stand = experiment::load(source + "/experiments/rig/" + name + ".toml");
    EXPECT_EQ(expect_no_heap(stand, 20000).column("/true/stand/length")->size(), 2000u) << name;
  }
}

TEST(Run, NoHeapInTheLoopWhileChangesArrive) {
  const experiment::Experiment e = walk();
  Steering steering;
  std::atomic<bool> over{false};
  std::thread person([&] {
    for (int i = 0; !over; ++i) {
      steering.change(static_cast<std::size_t>(i % 8), 1e-4 * (i % 11));
      if (i % 5 == 0) steering.release(static_cast<std::size_t>(i % 8));
      std::this_thread::yield();
    }
  });
  expect_no_heap(e, experiment::last_tick(e), &steering);
  over = true;
  person.join();
}

TEST(Run, EveryShippedExperimentRuns) {
  for (const auto& file : std::filesystem::directory_iterator(source + "/experiments")) {
    if (file.path().extension() != ".toml") continue;
    const experiment::Experiment e = experiment::load(file.path().string());
    EXPECT_TRUE(e.warnings.empty()) << file.path();
    const Outcome o = run(e);
    EXPECT_EQ(o.status, signals::Status::ok) << file.path();
    for (const signals::Series& s : o.table.series) {
      if (s.topic.name.rfind("/true/", 0) != 0) continue;
      for (const signals::Column& column : s.columns) {
        EXPECT_TRUE(
            std::all_of(column.begin(), column.end(), [](double v) { return std::isfinite(v); }))
            << file.path() << s.topic.name;
      }
    }
  }
}

TEST(Run, EveryShippedRobotWalksTheSamePlan) {
  for (const char* robot : {"leg-as-printed", "leg-ideal"}) {
    const experiment::Experiment e = walk({"robot=" + source + "/robots/" + robot + "/robot.toml"});
    EXPECT_EQ(e.robot.name, robot);
    EXPECT_EQ(run(e).status, signals::Status::ok) << robot;
  }
}

// An experiment can be repeated from resolved.toml alone, with the same bits.
TEST(Resolved, RunsAgainToTheSameBits) {
  const experiment::Experiment e = walk();
  const auto path =
      std::filesystem::temp_directory_path() / ("resolved-" + std::to_string(::getpid()) + ".toml");
  {
    std::FILE* file = std::fopen(path.c_str(), "w");
    const std::string text = experiment::resolved(e, "test");
    std::fwrite(text.data(), 1, text.size(), file);
    std::fclose(file);
  }
  const experiment::Experiment again = experiment::load(path.string());
  expect_same(run(e).table, run(again).table);
  std::filesystem::remove(path);
}

std::string refusal(const std::vector<std::string>& sets) {
  try {
    walk(sets);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Load, ReportsContradictions) {
  EXPECT_NE(refusal({"muscle.hip_flexor.inlet.valve=inlett"}).find("found \"inlett\"; expected"),
            std::string::npos);
  EXPECT_NE(refusal({"log.period=0.25 ms"}).find("multiple of 0.1 ms"), std::string::npos);
  EXPECT_NE(refusal({"plant=mars"}).find("expected planar"), std::string::npos);
  EXPECT_NE(refusal({"control.high_level_period=15 ms"}).find("multiple of the low level's period"),
            std::string::npos);
}

// Machines that are impossible, and machines that are refused.
TEST(Load, RefusesWhatCannotBe) {
  const auto expect = [](const char* set, const char* text) {
    EXPECT_NE(refusal({set}).find(text), std::string::npos) << set << ": " << refusal({set});
  };
  expect("start.trolley=100 in", "expected 0 to the track's end, 60 in");
  expect("muscle.hip_flexor.mount_length=9 in", "expected less than the thread's length");
  expect("link.femur.center_of_mass=30 in", "expected within the link, 8.875 in");
  expect("phase.swing.duration=4e6 s", "expected at most 1000000 s");
  expect("low_level.pwm_ticks=50", "predict.dat counts the ticks");
  expect("low_level.output_delay=0", "expected 1 to 100");
}

TEST(Clock, PacedTimeWaits) {
  PacedClock clock(10.0);  // ten times real time
  const auto before = std::chrono::steady_clock::now();
  for (signals::Tick t = 0; t <= 2000; t += 100) clock.wait_until(t);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
  EXPECT_GE(wall.count(), 0.0199);
}

}  // namespace
}  // namespace sinew::run::run_test
