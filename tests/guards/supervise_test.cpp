// False readings, impossible commands and skipped ticks, in quantity: a real fault ends the run in
// time, noise alone does not, and the valves obey in all cases.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "sinew/control/setup/supervision.h"
#include "sinew/control/supervise/test_fuzz.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::experiment {
namespace {

using control::Trip;
using signals::Tick;
using What = Fault::What;

constexpr Tick period = 100;  // of the low level [ticks]

// Counts the tries of this process: ctest gives each test one of its own.
struct Tally {
  std::int64_t broken = 0, noisy = 0, stuck = 0, rejected = 0;
  control::FuzzCount fuzz;
};
Tally tally;

// Prints the number of tries, one line each for the output of ./check.
class Tell : public ::testing::Environment {
 public:
  void TearDown() override {
    const auto number = [](std::int64_t n) { return static_cast<long long>(n); };
    if (tally.broken > 0)
      std::printf("guard: %lld sensors broken, vented in time\n", number(tally.broken));
    if (tally.noisy > 0)
      std::printf("guard: %lld noisy runs with %lld readings rejected, none ended\n",
                  number(tally.noisy), number(tally.rejected));
    if (tally.stuck > 0) std::printf("guard: %lld sensors stuck\n", number(tally.stuck));
    if (tally.fuzz.periods > 0)
      std::printf("guard: %lld periods with %lld gaps, %lld times both valves open\n",
                  number(tally.fuzz.periods), number(tally.fuzz.gaps),
                  number(tally.fuzz.both_open));
  }
};
const auto* const tell = ::testing::AddGlobalTestEnvironment(new Tell);

// Tries of each kind.
int count() {
  const char* asked = std::getenv("SINEW_GUARD_COUNT");
  return asked ? std::max(1, std::atoi(asked)) : 200;
}

double in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// The bench's lever, up and down once; and the leg's two joints in the air.
const Experiment& bench() {
  static const Experiment e =
      load(sinew::test::source_dir() + "/experiments/one-joint.toml", {"sequence.repeat=1"});
  return e;
}
const Experiment& leg() {
  static const Experiment e =
      load(sinew::test::source_dir() + "/experiments/leg-in-air.toml", {"sequence.repeat=1"});
  return e;
}

struct Trial {
  Experiment experiment;
  std::string sensor;
  double first_lie = 0;  // [s]
};

Trial any_trial(std::mt19937& random) {
  Trial out{random() % 4 ? bench() : leg(), "", 0};
  out.experiment.seed = static_cast<int>(random() % 1'000'000);
  std::vector<std::string> angles;
  for (const robot::Sensor& s : out.experiment.robot.sensors)
    if (s.kind == robot::Sensor::Kind::angle) angles.push_back(s.name);
  out.sensor = angles[random() % angles.size()];
  out.first_lie = in(random, 0.05, 1.5);
  return out;
}

// When all inlets are shut and all exhausts open, by the edges of the log; -1: never.
Tick vented_at(const run::Outcome& outcome, const Experiment& e, Tick from) {
  Tick all = from;
  for (const robot::Muscle& m : e.robot.muscles)
    for (const auto& [which, wanted] : {std::pair{"inlet", 0.0}, std::pair{"exhaust", 1.0}}) {
      const signals::Series& s = *outcome.table.find("/valve/" + m.name + "/" + which + "/open");
      Tick since = wanted == 0 ? 0 : -1;  // all are closed before the first edge
      for (std::size_t i = 0; i < s.time_ns.size(); ++i) {
        const Tick at = s.time_ns[i] / signals::tick_nanoseconds;
        if (at > from + 5) break;
        const bool now = s.columns[0][i] == wanted;
        if (!now) since = -1;
        if (now && since < 0) since = at;
      }
      if (since < 0) return -1;
      all = std::max(all, since);
    }
  return all;
}

void expect_vented_in_time(const Trial& trial, const char* what) {
  const Experiment& e = trial.experiment;
  const run::Outcome out = run::run(e);
  const int channel = robot::find_sensor(e.robot, trial.sensor);
  const Trip& trip = out.supervised.trip;
  ASSERT_TRUE(trip.cause == Trip::Cause::range || trip.cause == Trip::Cause::rate)
      << what << " of " << trial.sensor << " at " << trial.first_lie << " s, seed " << e.seed;
  EXPECT_EQ(trip.channel.index, channel);
  EXPECT_EQ(out.controller.fault, signals::Status::fault);

  // The first scan that reads a false value, and the third.
  const Tick read = e.robot.sensors[static_cast<std::size_t>(channel)].tick;
  const double scan = (trial.first_lie / signals::tick_seconds - static_cast<double>(read)) /
                      static_cast<double>(period);
  const Tick third = (static_cast<Tick>(std::ceil(scan - 1e-9)) + 2) * period + read;
  EXPECT_EQ(trip.at, third) << what;
  const Tick vented = vented_at(out, e, third);
  ASSERT_GE(vented, 0) << what << ", seed " << e.seed;
  EXPECT_LE(vented - third, 5);
  EXPECT_NE(to_text(trip, e.robot).find("sensor " + trial.sensor), std::string::npos);
}

void break_sensor(What what, double amount, const char* name) {
  std::mt19937 random(static_cast<unsigned>(what) + (amount < 0 ? 100 : 0));
  for (int i = 0; i < count(); ++i) {
    Trial trial = any_trial(random);
    trial.experiment.faults = {
        {.at = trial.first_lie, .of = trial.sensor, .what = what, .amount = amount}};
    expect_vented_in_time(trial, name);
    tally.broken += !::testing::Test::HasFailure();
  }
}

TEST(Supervise, AnOpenPotentiometerIsVentedInTime) { break_sensor(What::open, 0, "open"); }
TEST(Supervise, AShortedOneIsVentedInTime) { break_sensor(What::shorted, 0, "short"); }
TEST(Supervise, OneAtTheUpperRailIsVentedInTime) { break_sensor(What::offset, 4095, "top rail"); }
TEST(Supervise, OneAtTheLowerRailIsVentedInTime) {
  break_sensor(What::offset, -4095, "bottom rail");
}

// As noisy as its file specifies, and at most one reading of ten false, never two in a row.
TEST(Supervise, NoiseWithinItsFileAndSingleBadSamplesDoNotTrip) {
  std::mt19937 random(3);
  std::int64_t rejected = 0;
  for (int i = 0; i < count(); ++i) {
    Trial trial = any_trial(random);
    Experiment& e = trial.experiment;
    for (robot::Sensor& s : e.robot.sensors) s.noise *= in(random, 0, 6);
    double at = 0.02;
    while (at < 2) {
      const What kinds[] = {What::open, What::shorted, What::offset, What::noise, What::dropout};
      const What what = kinds[random() % 5];
      const double amount = what == What::dropout ? 1
                            : what == What::noise ? in(random, 0, 1000)
                                                  : in(random, -4095, 4095);
      e.faults.push_back(
          {.at = at, .lasts = 0.01, .of = trial.sensor, .what = what, .amount = amount});
      at += in(random, 0.03, 0.3);
    }
    const run::Outcome out = run::run(e);
    EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::none)
        << to_text(out.supervised.trip, e.robot) << ", seed " << e.seed;
    EXPECT_EQ(out.status, signals::Status::ok);
    rejected += out.supervised.rejected;
    ++tally.noisy;
    tally.rejected += out.supervised.rejected;
  }
  EXPECT_GT(rejected, count());
}

// A frozen reading does not end a run; it is counted, where its joint is driven.
TEST(Supervise, AStuckPotentiometerIsCountedAndEndsNoRun) {
  std::mt19937 random(5);
  int counted = 0;
  for (int i = 0; i < count(); ++i) {
    Trial trial = any_trial(random);
    trial.experiment.faults = {{.at = trial.first_lie, .of = trial.sensor, .what = What::stuck}};
    const run::Outcome out = run::run(trial.experiment);
    EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::none) << trial.experiment.seed;
    const int s = robot::find_sensor(trial.experiment.robot, trial.sensor);
    ++tally.stuck;
    counted += out.supervised.sensor[static_cast<std::size_t>(s)].frozen > 0;
  }
  EXPECT_GT(counted, count() / 2);
}

// --- the low level alone ------------------------------------------------------------------------

// 5,000 periods a try: random gaps, commands that are NaN, false readings.
TEST(Supervise, ValvesObeyWhateverComes) {
  std::mt19937 random(9);
  control::FuzzCount& all = tally.fuzz;
  for (int i = 0; i < count(); ++i)
    for (int part = 0; part < 10; ++part) {
      const control::JointControllerConfig config = control::any_leg(random);
      control::SuperviseConfig limits;
      const bool trips = random() % 4 == 0;  // else it continues, so that more is tested
      if (!trips) limits.gap_vent = limits.vent_commands = limits.bad_readings = 1'000'000;
      for (std::size_t s = 0; s < 7; ++s)
        limits.sensor[s] = {.low = 100, .high = 4000, .max_step = 2000, .joint = 1};
      ASSERT_EQ(control::problem(limits), nullptr);
      control::Supervisor supervisor(config, limits);
      const control::FuzzOptions options{.gap_every = 5 + static_cast<unsigned>(random() % 200),
                                         .impossible_every = 5,
                                         .late_every = 50,
                                         .counts = 5000};
      control::fuzz(supervisor, 500, options, random, all);
      const control::Supervised& seen = supervisor.supervised();
      if (!trips) {  // a run that has ended checks no more
        EXPECT_GT(seen.rejected, 0u);
      }
      if (seen.trip.cause != Trip::Cause::none) {
        EXPECT_NE(supervisor.state().phase, control::Phase::running);
        EXPECT_EQ(supervisor.state().fault, signals::Status::fault);
      }
    }
  EXPECT_EQ(all.both_open, 0);
  EXPECT_EQ(all.not_finite, 0);
  EXPECT_GT(all.gaps, 100 * count());
  EXPECT_GT(all.edges, 10'000 * count());
}

}  // namespace
}  // namespace sinew::experiment
