// Faulty sensors, from the list in the file to the end of the run, and the limits of a robot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sinew/air/fault.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/control/setup/supervision.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/faulty_port.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/test_same.h"
#include "tests/places.h"

namespace sinew::run::fault_test {
namespace {

using control::Trip;
using signals::Reading;
using signals::Status;
using signals::Tick;
using What = experiment::Fault::What;

const std::string source = sinew::test::source_dir();

experiment::Experiment bench(std::vector<std::string> sets = {}) {
  sets.push_back("sequence.repeat=1");
  return experiment::load(source + "/experiments/one-joint.toml", sets);
}

// Returns the readings of a body with constant readings, every 10 ms.
class Still final : public signals::Port {
 public:
  Status start(const signals::Scan&) noexcept override { return Status::ok; }
  Status drive(signals::Edge) noexcept override { return Status::ok; }
  Reading read(signals::Channel, Tick now) noexcept override {
    return {static_cast<std::uint16_t>(2000 + now / 100), Status::ok};
  }
  Status stop(Tick) noexcept override { return Status::ok; }
};

std::vector<Reading> read(const experiment::Fault& fault, int scans, int seed = 1) {
  experiment::Experiment e = bench();
  e.seed = seed;
  e.faults = {fault};
  Still body;
  FaultyPort port(e, body);
  std::vector<Reading> out;
  for (int i = 0; i < scans; ++i) out.push_back(port.read({0}, 100 * i + 1));
  return out;
}

experiment::Fault of_lever(What what, double amount = robot::not_set) {
  return {.at = 0.1, .of = "lever_angle", .what = what, .amount = amount};
}

TEST(Fault, ReadsAsItsWordPromises) {
  const auto at_20 = [](const experiment::Fault& f) { return read(f, 30)[20].counts; };
  EXPECT_EQ(at_20(of_lever(What::open)), 4095);
  EXPECT_EQ(at_20(of_lever(What::shorted)), 0);
  EXPECT_EQ(at_20(of_lever(What::stuck)), 2009);  // before 0.1 s
  EXPECT_EQ(at_20(of_lever(What::offset, -300)), 1720);
  EXPECT_EQ(at_20(of_lever(What::slip, 3000)), 4095);
  EXPECT_EQ(read(of_lever(What::dropout), 30)[20].status, Status::late);
  for (const What what : {What::open, What::stuck, What::dropout}) {
    const std::vector<Reading> before = read(of_lever(what), 10);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(before[static_cast<std::size_t>(i)].counts, 2000 + i);
  }
}

TEST(Fault, ActsFromItsBeginningToItsEnd) {
  experiment::Fault fault = of_lever(What::shorted);
  fault.lasts = 0.05;
  const std::vector<Reading> r = read(fault, 30);
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(r[static_cast<std::size_t>(i)].counts == 0, i >= 10 && i < 15) << i;
}

// Half of the readings are lost, as the seed determines; noise has its standard deviation and no
// mean.
TEST(Fault, NoiseAndDropoutsAreAsLargeAsTheySay) {
  constexpr int n = 4000;
  const auto lost = [&](int seed) {
    std::vector<bool> out;
    for (const Reading& r : read(of_lever(What::dropout, 0.3), n, seed))
      out.push_back(r.status == Status::late);
    return out;
  };
  EXPECT_NEAR(static_cast<double>(std::ranges::count(lost(1), true)) / n, 0.3, 0.03);
  EXPECT_EQ(lost(1), lost(1));
  EXPECT_NE(lost(1), lost(2));

  double sum = 0, squares = 0;
  const std::vector<Reading> noisy = read(of_lever(What::noise, 40), 2000);
  for (std::size_t i = 10; i < noisy.size(); ++i) {
    const double d = noisy[i].counts - (2000.0 + static_cast<double>(i));
    sum += d, squares += d * d;
  }
  EXPECT_NEAR(sum / 1990, 0, 4);
  EXPECT_NEAR(std::sqrt(squares / 1990), 40, 3);
}

TEST(Fault, EndsTheRunAndIsNamed) {
  experiment::Experiment e = bench();
  e.faults = {{.at = 1, .of = "lever_angle", .what = What::open}};
  const Outcome out = run(e);
  EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::range);
  EXPECT_EQ(out.supervised.trip.at, 10'201);  // read at tick 1 of the third scan
  EXPECT_EQ(out.controller.fault, Status::fault);
  const std::string text = control::to_text(out.supervised.trip, e.robot);
  EXPECT_TRUE(
      text.starts_with("sensor lever_angle at 1.0201 s: 4095 count three times in a row, "
                       "outside its plausible "))
      << text;

  // The log has the converted values with their times.
  const auto column = [&](const char* topic) { return out.table.find(topic)->columns[0]; };
  EXPECT_EQ(column("/sensor/lever_angle/count").back(), 4095);
  EXPECT_EQ(column("/sensor/lever_angle/count")[99] == 4095, false);
  EXPECT_EQ(column("/true/sensor/lever_angle/fault")[99], 0);
  EXPECT_EQ(column("/true/sensor/lever_angle/fault").back(), 1);
  EXPECT_EQ(column("/low_level/tripped").back(), 1);
  // The last sample is before the last scan.
  EXPECT_NEAR(column("/sensor/lever_angle/rejected").back(), out.supervised.rejected, 1);
}

// A sensor fault affects readings only; an inactive one leaves the log as without the list.
TEST(Fault, ThatComesTooLateChangesNoBit) {
  experiment::Experiment e = bench();
  const Outcome without = run(e);
  e.faults = {{.at = 1000, .of = "lever_angle", .what = What::open}};
  const Outcome with = run(e);
  for (const signals::Series& s : without.table.series) {
    const signals::Series* other = with.table.find(s.topic.name);
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(s.time_ns, other->time_ns);
    for (std::size_t c = 0; c < s.columns.size(); ++c)
      for (std::size_t i = 0; i < s.columns[c].size(); ++i)
        ASSERT_TRUE(s.columns[c][i] == other->columns[c][i] || std::isnan(s.columns[c][i]))
            << s.topic.name;
  }
}

TEST(Fault, IsTheSameHoweverItIsLookedAt) {
  experiment::Experiment e = bench();
  e.faults = {{.at = 0.5, .of = "lever_angle", .what = What::noise, .amount = 30},
              {.at = 1, .lasts = 1, .of = "flexor_tension", .what = What::dropout, .amount = 0.5}};
  const Outcome once = run(e);
  EXPECT_EQ(once.supervised.trip.cause, Trip::Cause::none);
  EXPECT_GT(once.controller.late, 20u);
  expect_same(once.table, run(e, {.every_tick = true}).table);
}

// The log holds the faulty readings: a replay decides the same edges, and the list does not act
// twice.
TEST(Fault, ARunWithOneReplaysItsOwnEdges) {
  experiment::Experiment e = bench();
  e.faults = {{.at = 0.5, .of = "lever_angle", .what = What::offset, .amount = 30},
              {.at = 1, .of = "lever_angle", .what = What::open}};
  const Outcome recorded = run(e), again = replay(e, recorded.table);
  EXPECT_EQ(again.supervised.trip.at, recorded.supervised.trip.at);
  std::size_t edges = 0;
  for (const signals::Series& s : recorded.table.series) {
    if (!s.topic.name.starts_with("/valve/")) continue;
    EXPECT_EQ(s.time_ns, again.table.find(s.topic.name)->time_ns) << s.topic.name;
    edges += s.time_ns.size();
  }
  EXPECT_GT(edges, 50u);
}

TEST(Fault, StandsInTheResolvedFile) {
  experiment::Experiment e = bench();
  e.faults = {
      {.at = 1.25, .lasts = 0.5, .of = "lever_angle", .what = What::offset, .amount = -12.5},
      {.at = 2, .of = "flexor_tension", .what = What::slip, .amount = 100},
      {.at = 2.5, .of = "flexor_tension", .what = What::dropout, .amount = 0.25},
      {.at = 3, .of = "lever_angle", .what = What::open}};
  e.robot.sensors[0].plausible = {300, 3900};
  e.robot.sensors[0].max_rate = 20'000;
  e.robot.sensors[0].frozen_limit = 1.5;
  const experiment::Experiment again = experiment::load(
      config::parse_text(experiment::resolved(e, "test"), "resolved.toml"), "resolved.toml");
  ASSERT_EQ(again.faults.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const experiment::Fault &a = e.faults[i], &b = again.faults[i];
    EXPECT_EQ(a.at, b.at);
    EXPECT_EQ(a.of, b.of);
    EXPECT_EQ(a.what, b.what);
    EXPECT_TRUE(a.lasts == b.lasts || (std::isnan(a.lasts) && std::isnan(b.lasts)));
    EXPECT_TRUE(a.amount == b.amount || (std::isnan(a.amount) && std::isnan(b.amount)));
  }
  EXPECT_EQ(again.robot.sensors[0].plausible, e.robot.sensors[0].plausible);
  EXPECT_EQ(again.robot.sensors[0].max_rate, 20'000);
  EXPECT_EQ(again.robot.sensors[0].frozen_limit, 1.5);
  expect_same(run(e).table, run(again).table);
}

// --- the air ---

experiment::Fault of_air(const std::string& of, What what, double at,
                         double lasts = robot::not_set) {
  return {.at = at, .lasts = lasts, .of = of, .what = what};
}

TEST(AirFault, StandsInTheResolvedFile) {
  experiment::Experiment e = bench();
  e.faults = {of_air("flexor.inlet", What::stuck_open, 1.25, 0.5),
              of_air("flexor.exhaust", What::stuck_shut, 1.25),
              of_air("extensor.inlet", What::leaking, 0.5, 1),
              of_air("extensor", What::leaking, 0.5, 1),
              of_air("flexor", What::ruptured, 3),
              of_air("extensor", What::blocked, 2, 0.1),
              of_air("supply", What::failed, 2, 0.1),
              of_air("supply", What::failed, 2.5)};
  e.faults[2].share = 0.05;
  e.faults[3].area = 1e-8;
  e.faults[3].conductance = 2e-12;
  e.faults[6].pressure = 3e5;
  const experiment::Experiment again = experiment::load(
      config::parse_text(experiment::resolved(e, "test"), "resolved.toml"), "resolved.toml");
  ASSERT_EQ(again.faults.size(), e.faults.size());
  for (std::size_t i = 0; i < e.faults.size(); ++i) {
    EXPECT_EQ(again.faults[i].what, e.faults[i].what);
    EXPECT_EQ(experiment::to_text(again.faults[i]), experiment::to_text(e.faults[i]));
  }
  EXPECT_EQ(experiment::to_text(e.faults[2]),
            "extensor.inlet leaking (5 % of its area) from 0.5 s to 1.5 s");
  EXPECT_EQ(experiment::to_text(e.faults[4]), "flexor ruptured from 3 s on");
  expect_same(run(e).table, run(again).table);
}

// The plant is given parts by their numbers, and a rupture of a tenth of an actuator's bore.
TEST(AirFault, ComesToPartsOfThePlant) {
  experiment::Experiment e = bench();
  e.faults = {of_air("extensor.exhaust", What::stuck_shut, 1, 0.5), of_lever(What::open),
              of_air("extensor", What::ruptured, 1), of_air("supply", What::failed, 2)};
  const std::vector<air::AirFault> air = air_faults(e);
  ASSERT_EQ(air.size(), 3u);
  EXPECT_EQ(air[0].what, air::AirFault::What::stuck_shut);
  EXPECT_EQ(air[0].of, 3);
  EXPECT_EQ(air[0].begin, 1);
  EXPECT_EQ(air[0].end, 1.5);
  EXPECT_EQ(air[1].of, 1);
  const robot::Muscle& m = e.robot.muscles[1];
  const auto& braid = robot::actuator_of(m, e.actuators).braid;
  const double widest = braid.thread_length / (braid.turns * 3.14159265358979);
  EXPECT_GT(air[1].leak.area, 0.03 * widest * widest / 4);
  EXPECT_LT(air[1].leak.area, 0.315 * widest * widest / 4);
  EXPECT_EQ(air[2].pressure, e.air.atmosphere);
}

// The log has the times at which it acted, however short, and all the air; its sensors are correct.
TEST(AirFault, IsInTheLogWithTheAirsBalance) {
  experiment::Experiment e = bench();
  e.faults = {of_air("flexor.inlet", What::stuck_open, 1.0042, 1e-3),
              of_air("flexor", What::leaking, 1.2)};
  e.faults[1].area = 2e-8;
  const signals::Table table = run(e).table;
  const auto column = [&](const char* topic) { return table.find(topic)->columns[0]; };
  EXPECT_EQ(std::ranges::count(column("/true/valve/flexor/inlet/fault"), 1.0), 1);
  EXPECT_EQ(column("/true/valve/flexor/inlet/fault")[101], 1);
  EXPECT_EQ(column("/true/muscle/flexor/fault")[119], 0);
  EXPECT_EQ(column("/true/muscle/flexor/fault").back(), 1);
  EXPECT_EQ(table.find("/true/sensor/lever_angle/fault"), nullptr);

  const auto gained = [&](const std::string& topic) {
    const signals::Column c = column(topic.c_str());
    return c.back() - c.front();
  };
  double in = 0, out = 0;
  for (const std::string m : {"/true/muscle/flexor", "/true/muscle/extensor"})
    in += gained(m + "/air_in"), out += gained(m + "/air_out");
  const double leaked = gained("/true/muscle/flexor/air_leaked");
  EXPECT_GT(leaked, 1e-6);
  EXPECT_NEAR((gained("/true/air/mass") - in + out + leaked) / in, 0, 1e-12);
}

// The air of hoses is in the balance, even in a run without faults; without it, 0.1 % of the air or
// more would be missing.
TEST(AirFault, NeedNotBeForTheAirOfHosesToBeInTheBalance) {
  experiment::Experiment e = bench();
  for (robot::Muscle& m : e.robot.muscles)
    m.hose = {
        .law = gas::Hose::Law::pipe, .length = 0.5, .inner_diameter = 2.5e-3, .volume = 2.5e-6};
  const signals::Table table = run(e).table;
  const auto column = [&](const std::string& topic) -> const signals::Column& {
    return table.find(topic)->columns[0];
  };
  const signals::Column& all = column("/true/air/mass");
  double off = 0, off_without = 0, most = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    double kept = 0, in_muscles = 0, in = 0;
    for (const std::string m : {"/true/muscle/flexor", "/true/muscle/extensor"}) {
      const auto gained = [&](const char* what) {
        return column(m + what)[i] - column(m + what).front();
      };
      in += gained("/air_in");
      kept += gained("/air_in") - gained("/air_out");
      in_muscles += gained("/mass");
    }
    off = std::max(off, std::abs(all[i] - all.front() - kept));
    off_without = std::max(off_without, std::abs(in_muscles - kept));
    most = std::max(most, in);
  }
  EXPECT_LT(off / most, 1e-12);
  EXPECT_GT(off_without / most, 1e-3);
}

TEST(AirFault, ThatComesTooLateChangesNoBit) {
  experiment::Experiment e = bench();
  const Outcome without = run(e);
  e.faults = {of_air("flexor.inlet", What::stuck_open, 1000)};
  const Outcome with = run(e);
  for (const signals::Series& s : without.table.series) {
    const signals::Series* other = with.table.find(s.topic.name);
    ASSERT_NE(other, nullptr);
    for (std::size_t c = 0; c < s.columns.size(); ++c)
      for (std::size_t i = 0; i < s.columns[c].size(); ++i)
        ASSERT_TRUE(s.columns[c][i] == other->columns[c][i] || std::isnan(s.columns[c][i]))
            << s.topic.name;
  }
}

// Both kinds of faults at once: of the port's readings and of the body's air.
TEST(AirFault, GoesWithALieOfASensor) {
  experiment::Experiment e = bench();
  e.faults = {of_air("flexor", What::leaking, 0.5, 1), of_lever(What::noise, 30)};
  e.faults[0].area = 1e-8;
  const Outcome once = run(e);
  EXPECT_EQ(once.status, Status::ok);
  expect_same(once.table, run(e, {.every_tick = true, .extra_readers = 2}).table);
  // Noise depends on the index in the whole list: a fault inserted before changes it, one after
  // does not.
  std::swap(e.faults[0], e.faults[1]);
  EXPECT_NE(run(e).table.find("/sensor/lever_angle/count")->columns[0],
            once.table.find("/sensor/lever_angle/count")->columns[0]);
}

// --- limits -------------------------------------------------------------------------------------

// robots/leg: travel from the length of the mount to that of the thread, over cams of 1 in; 767
// counts per radian, more than the potentiometer's 714.
TEST(Supervision, AnAngleIsPlausibleWithinItsMusclesReach) {
  const experiment::Experiment e = experiment::load(source + "/experiments/walk-test-1.toml");
  const control::SuperviseConfig c = control::supervise_config(installation(e));
  const int hip = robot::find_sensor(e.robot, "hip_angle");
  const control::SensorLimits& limit = c.sensor[static_cast<std::size_t>(hip)];
  EXPECT_GT(limit.low, 0);
  EXPECT_LT(limit.high, 4095);
  const auto way = [&](const char* muscle) {
    const auto& m = e.robot.muscles[static_cast<std::size_t>(robot::find_muscle(e.robot, muscle))];
    const double thread = robot::actuator_of(m, e.actuators).braid.thread_length;
    return 1.1 * (thread - m.mount_length) / 0.0254 * 767 + 3;  // and six times the noise
  };
  EXPECT_NEAR(limit.low, 1895 - way("hip_flexor"), 1.5);  // the hip flexor raises the angle
  EXPECT_NEAR(limit.high, 1895 + way("hip_extensor"), 1.5);
  EXPECT_GT(way("hip_flexor"), 700);
  EXPECT_NEAR(limit.max_step, 60 * 767 * 0.01 + 6, 2);
  const int tension = robot::find_sensor(e.robot, "hip_flexor_tension");
  const control::SensorLimits& gauge = c.sensor[static_cast<std::size_t>(tension)];
  EXPECT_EQ(gauge.low, 0);
  EXPECT_GE(gauge.high, 4095);
  EXPECT_TRUE(gauge.rests_at_ends);
}

// A potentiometer may be mounted so that it rests at the converter's end; this is no fault.
TEST(Supervision, WhereItRestsIsPlausible) {
  for (const double rest : {0.0, 2.0, 4095.0}) {
    experiment::Experiment e = bench();
    e.robot.sensors[0].at_rest = e.robot.sensors[0].assumed_at_rest = rest;
    const control::SensorLimits limit = control::supervise_config(installation(e)).sensor[0];
    EXPECT_EQ(limit.low, rest < 4000 ? 0 : limit.low);
    EXPECT_EQ(limit.high, rest > 4000 ? 4095 : limit.high);
    EXPECT_LE(limit.low, rest);
    EXPECT_GE(limit.high, rest);
  }
}

TEST(Supervision, TheFilesLimitsCount) {
  experiment::Experiment e = bench();
  e.robot.sensors[0].plausible = {1900, 2500};
  e.robot.sensors[0].max_rate = 20'000;
  e.robot.sensors[0].frozen_limit = 0.3;
  const control::SensorLimits limit = control::supervise_config(installation(e)).sensor[0];
  EXPECT_EQ(limit.low, 1900);
  EXPECT_EQ(limit.high, 2500);
  EXPECT_EQ(limit.max_step, 206);
  EXPECT_EQ(limit.frozen_limit, 30u);

  e.faults = {{.at = 0.8, .of = "lever_angle", .what = What::stuck}};
  const Outcome out = run(e);
  EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::frozen);
  EXPECT_TRUE(control::to_text(out.supervised.trip, e.robot).find("its frozen_limit") !=
              std::string::npos);
}

TEST(Supervision, ACommandThatIsTooFastIsRejected) {
  experiment::Experiment e = experiment::load(source + "/experiments/knee-staircase.toml");
  e.robot.low_level.command_rate = 1;
  const Outcome out = run(e);
  EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::command);
  EXPECT_TRUE(control::to_text(out.supervised.trip, e.robot)
                  .starts_with("the commands for joint knee at "));
}

}  // namespace
}  // namespace sinew::run::fault_test
