// Tests the supervisor with wrong readings, and conditions that always hold.
#include "sinew/control/supervise/supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sinew/control/supervise/test_stand.h"

namespace sinew::control::supervisor_test {
namespace {

// --- readings -----------------------------------------------------------------------------------

TEST(Supervisor, ThreeReadingsOutOfRangeVentWithinHalfAMillisecond) {
  for (const std::uint16_t counts : {0, 99, 4001, 4095, 65535}) {
    Stand stand;
    stand.replace_reading = constant_reading(hip_angle, counts, 20);
    stand.run(60);
    EXPECT_EQ(stand.trip().cause, Trip::Cause::range);
    EXPECT_EQ(stand.trip().channel.index, hip_angle);
    EXPECT_EQ(stand.trip().counts, counts);
    EXPECT_EQ(stand.trip().before, 1895);
    EXPECT_EQ(stand.trip().low, 100);
    EXPECT_EQ(stand.trip().high, 4000);
    const Tick third = 2200 + 3;  // the hip's conversion is read at tick 3
    EXPECT_EQ(stand.trip().at, third);
    ASSERT_TRUE(stand.vented.has_value());
    EXPECT_LE(*stand.vented - third, 5);
    EXPECT_EQ(stand.supervisor.state().fault, Status::fault);
  }
}

TEST(Supervisor, EvenWhereALawsOutputTakesAPeriod) {
  JointControllerConfig leg = test_leg();
  leg.output_delay = 100;
  Stand stand(limits(), leg);
  stand.replace_reading = constant_reading(hip_angle, 4095, 20);
  stand.run(60);
  ASSERT_TRUE(stand.vented.has_value());
  EXPECT_LE(*stand.vented - 2203, 5);
}

TEST(Supervisor, AMachineWithoutAVentTimeIsVentedForASecond) {
  JointControllerConfig leg = test_leg();
  leg.shutdown_vent = 0;
  Stand stand(limits(), leg);
  stand.replace_reading = constant_reading(hip_angle, 4095, 20);
  stand.run(121);
  EXPECT_EQ(stand.vented.value_or(0), 2204);
  EXPECT_EQ(stand.supervisor.state().phase, Phase::venting);
  stand.run(3);
  EXPECT_EQ(stand.supervisor.state().phase, Phase::off);
  EXPECT_FALSE(stand.valves.an_exhaust_open());
}

// The laws continue with the last good counts: the edges are those of a leg at rest.
TEST(Supervisor, SingleBadSamplesNeverEndARun) {
  Stand honest, stand;
  stand.replace_reading = [](std::uint8_t c, int scan, signals::Reading r) {
    if (c == hip_angle && scan > 3 && scan % 2) r.counts = scan % 4 == 1 ? 4095 : 1895 + 120;
    return r;
  };
  honest.run(500);
  stand.run(500);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  EXPECT_EQ(stand.supervised().sensor[hip_angle].rejected, 248u);
  EXPECT_EQ(stand.supervised().rejected, 248u);
  EXPECT_EQ(stand.supervisor.state().reading[hip_angle].counts, 1895);
  EXPECT_EQ(stand.supervisor.state().joint[hip].angle_output,
            honest.supervisor.state().joint[hip].angle_output);
}

TEST(Supervisor, TwoInARowDoNotEndARunEither) {
  Stand stand;
  stand.replace_reading = [](std::uint8_t c, int scan, signals::Reading r) {
    if (c == hip_angle && scan % 3) r.counts = 0;
    return r;
  };
  stand.run(300);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  EXPECT_EQ(stand.supervised().rejected, 200u);
}

TEST(Supervisor, FasterThanItCanMoveThreeTimesVents) {
  Stand stand;
  stand.replace_reading =
      constant_reading(hip_angle, 1895 + 151, 20);  // 50, 100, 150 would have been possible
  stand.run(40);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::rate);
  EXPECT_EQ(stand.trip().at, 2203);
  EXPECT_EQ(stand.trip().high, 50);
  EXPECT_LE(stand.vented.value_or(1'000'000) - 2203, 5);

  Stand possible;
  possible.replace_reading = constant_reading(hip_angle, 1895 + 150, 20);
  possible.run(40);
  EXPECT_EQ(possible.trip().cause, Trip::Cause::none);
  EXPECT_EQ(possible.supervised().rejected, 2u);
}

// At the limit's rate, for as long as the range allows, no reading is rejected.
TEST(Supervisor, AsFastAsItCanIsFine) {
  Stand stand;
  stand.replace_reading = [](std::uint8_t c, int scan, signals::Reading r) {
    const int phase = scan % 80;  // 0 .. 2000 and back
    if (c == hip_angle) r.counts = static_cast<std::uint16_t>(200 + 50 * std::abs(phase - 40));
    return r;
  };
  stand.run(400);
  EXPECT_EQ(stand.supervised().rejected, 0u);
}

// A false reading in the first scan does not make later good ones bad.
TEST(Supervisor, TheFirstReadingMayLie) {
  Stand stand;
  stand.replace_reading = constant_reading(hip_angle, 3900, 0, 1);
  stand.run(50);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  EXPECT_EQ(stand.supervisor.state().reading[hip_angle].counts, 1895);
}

TEST(Supervisor, AGaugeMayStandAtEitherEnd) {
  for (const std::uint16_t counts : {0, 4095}) {
    Stand stand;
    stand.replace_reading = constant_reading(hip_tension, counts, 0);
    stand.run(300);
    EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
    EXPECT_EQ(stand.supervised().rejected, 0u);
    EXPECT_EQ(stand.supervised().sensor[hip_tension].frozen, 0u);
  }
}

TEST(Supervisor, AFrozenReadingIsCountedAndNamed) {
  Stand stand;
  stand.run(200);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::none);
  // All but the first reading: a law has run before the second.
  EXPECT_EQ(stand.supervised().sensor[hip_angle].frozen, 199u);
  EXPECT_EQ(stand.supervised().sensor[hip_angle].longest, 199u);
  EXPECT_EQ(stand.supervised().sensor[hip_tension].frozen, 199u);

  Stand moves;
  moves.replace_reading = [](std::uint8_t c, int scan, signals::Reading r) {
    if (c == hip_angle) r.counts = static_cast<std::uint16_t>(r.counts + scan / 40 % 2);
    return r;
  };
  moves.run(400);
  EXPECT_EQ(moves.supervised().sensor[hip_angle].frozen, 0u);  // never 50 in a row

  Stand idle;
  for (JointCommand& c : idle.command.joint) c.duties = {};
  idle.run(400);
  EXPECT_EQ(idle.supervised().sensor[hip_angle].frozen, 0u);  // not driven
}

TEST(Supervisor, AFrozenReadingEndsARunOnlyByItsLimit) {
  SuperviseConfig config = limits();
  config.sensor[hip_angle].frozen_limit = 70;
  Stand stand(config);
  stand.run(120);
  EXPECT_EQ(stand.trip().cause, Trip::Cause::frozen);
  EXPECT_EQ(stand.trip().channel.index, hip_angle);
  EXPECT_EQ(stand.trip().at, 7003);
  EXPECT_TRUE(stand.vented.has_value());
}

// --- laws with random inputs --------------------------------------------------------------------

// Without limits and gaps the edges are those of the joint controller.
TEST(Supervisor, WhereNothingIsWrongTheEdgesAreTheSpines) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 30; ++trial) {
    const JointControllerConfig leg = any_leg(random);
    const auto seed = static_cast<unsigned>(random());
    const bool every_tick = random() % 2;
    const auto edges = [&](auto&& controller) {
      std::mt19937 inputs(seed);
      std::vector<std::array<Tick, 3>> out;
      Tick t = 0;
      while (t < 20'000) {
        if (controller.starts_period(t)) controller.command(any_command(inputs, leg, false));
        for (const signals::Edge& e : controller.edges(t))
          out.push_back({e.at, e.valve.index, e.open});
        if (const signals::Conversion* c = controller.due(t))
          controller.take(*c, {static_cast<std::uint16_t>(inputs() % 4096), Status::ok}, t);
        t = every_tick ? t + 1 : controller.next_event(t);
      }
      return out;
    };
    const auto alone = edges(JointController(leg)), supervised = edges(Supervisor(leg, {}));
    EXPECT_GT(alone.size(), 500u);
    EXPECT_EQ(alone, supervised);
  }
}

// With skipped ticks an unsupervised joint controller opens inlet and exhaust of a muscle together;
// the supervisor prevents this.
TEST(Supervisor, NeverBothOpenAmongSkippedTicks) {
  std::mt19937 random(7);
  FuzzCount alone, supervised;
  const FuzzOptions options{.gap_every = 40, .late_every = 50};
  for (int trial = 0; trial < 60; ++trial) {
    const JointControllerConfig leg = any_leg(random);
    JointController unsupervised(leg);
    fuzz(unsupervised, 300, options, random, alone);
    SuperviseConfig config;
    config.gap_vent = 1'000'000;
    Supervisor supervisor(leg, config);
    fuzz(supervisor, 300, options, random, supervised);
  }
  EXPECT_GT(alone.both_open, 0);
  EXPECT_EQ(supervised.both_open, 0);
  EXPECT_EQ(supervised.not_finite, 0);
  EXPECT_GT(supervised.gaps, 4000);
  RecordProperty("both_open_alone", static_cast<int>(alone.both_open));
}

// With pulses of 30 ticks: after the edges of a visited tick no valve is open that should have
// shut, even if ticks or the law that would shut it were skipped.
TEST(Supervisor, WhatShouldHaveShutInAGapShutsAtTheFirstTickAfterIt) {
  constexpr Tick pulse = 30;
  std::mt19937 random(11);
  SuperviseConfig config;
  config.gap_vent = 1'000'000;
  const JointControllerConfig leg = test_leg();
  Command command = rest_command(leg);
  for (JointCommand& c : command.joint) {
    c.enabled = c.open_loop = true;
    c.duties = {pulse, 0, 0, pulse};
  }
  int gaps = 0, edges = 0;
  Supervisor supervisor(leg, config);
  ValveWatch valves(leg);
  std::array<Tick, 12> opened{};
  for (Tick t = 0; t < 2'000'000;) {
    if (supervisor.starts_period(t)) supervisor.command(command);
    for (const signals::Edge& e : supervisor.edges(t)) {
      valves.drive(e);
      if (e.open) opened[e.valve.index] = t;
      ++edges;
    }
    if (const signals::Conversion* c = supervisor.due(t))
      supervisor.take(*c, {1000, Status::ok}, t);
    for (int v = 0; v < 12; ++v)
      ASSERT_FALSE(valves.is_open(v) && t >= opened[static_cast<std::size_t>(v)] + pulse)
          << "valve " << v << " at " << t;
    t = supervisor.next_event(t);
    if (random() % 20 != 0) continue;
    t += any_gap(random);
    ++gaps;
  }
  EXPECT_GT(gaps, 9000);
  EXPECT_GT(edges, 30'000);
}

TEST(Supervisor, RefusesLimitsThatCannotBe) {
  const auto with = [](const std::function<void(SuperviseConfig&)>& change) {
    SuperviseConfig config = limits();
    change(config);
    const char* text = problem(config);
    return std::string(text ? text : "");
  };
  EXPECT_EQ(with([](SuperviseConfig&) {}), "");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.sensor[2].low = 4001; }),
            "a sensor's plausible range ends before it begins");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.sensor[2].max_step = 0; }),
            "a sensor's max_step must not be 0");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.command[0].max_gain = NAN; }),
            "limits of stiffness and gains must not be beyond the laws'");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.command[0].high = 40'000; }),
            "the range of a commanded angle must lie within the laws'");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.vent_commands = 2; }), "hold comes before vent");
  EXPECT_EQ(with([](SuperviseConfig& c) { c.gap_vent = 1; }),
            "gap_shut must be at least 1 and not above gap_vent");
}

}  // namespace
}  // namespace sinew::control::supervisor_test
