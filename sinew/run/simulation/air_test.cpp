// The options of a file's air reach the plant: each is checked by a law over a whole run, and
// contradictions by their messages.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/world/machine.h"
#include "tests/places.h"

namespace sinew::run::air_test {
namespace {

using Sets = std::vector<std::string>;

experiment::Experiment walk(Sets sets = {}) {
  sets.push_back("sequence.repeat=1");
  return buildable(sinew::test::source_dir() + "/experiments/walk-test-1.toml", sets);
}

std::string refusal(const Sets& sets) {
  try {
    walk(sets);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

const Sets tank{"air.supply.kind=tank", "air.supply.volume=1 L",
                "air.supply.initial_pressure=100 psi gauge"};
const Sets pipe{"muscle.hip_flexor.hose.law=pipe", "muscle.hip_flexor.hose.length=1 m",
                "muscle.hip_flexor.hose.inner_diameter=2.5 mm"};

bool plain(const experiment::Experiment& e) {
  const plant::Setup s = planar_setup(e);
  return air::AirNetwork<plant::most_muscles>(s.muscles, s.air, s.supply, s.cylinder, {},
                                              s.steps.body)
      .plain();
}

double last(const signals::Table& table, const std::string& topic) {
  for (const signals::Series& s : table.series)
    if (s.topic.name == topic) return s.columns[0].back();
  ADD_FAILURE() << "no " << topic;
  return 0;
}

TEST(AirOfAFile, ReachesThePlant) {
  EXPECT_TRUE(plain(walk()));
  Sets hose = pipe;
  hose.push_back("muscle.hip_flexor.hose.volume=5 mL");
  hose.push_back("muscle.knee_flexor.leak.area=0.01 mm2");
  hose.push_back("muscle.knee_flexor.leak.conductance=2e-11 kg/(s Pa)");
  const plant::Setup s = planar_setup(walk(hose));
  EXPECT_EQ(s.muscles[0].hose.law, gas::Hose::Law::pipe);
  EXPECT_EQ(s.muscles[0].hose.length, 1);
  EXPECT_EQ(s.muscles[0].hose.inner_diameter, 2.5e-3);
  EXPECT_NEAR(s.muscles[0].hose.volume, 5e-6, 1e-20);
  EXPECT_NEAR(s.muscles[2].leak.area, 1e-8, 1e-22);
  EXPECT_EQ(s.muscles[2].leak.conductance, 2e-11);
  EXPECT_EQ(s.muscles[1].hose.law, gas::Hose::Law::none);

  for (const Sets& sets :
       {tank, pipe, Sets{"air.wall_time=0.3 s"}, Sets{"muscle.hip_flexor.leak.area=0.01 mm2"}})
    EXPECT_FALSE(plain(walk(sets))) << sets[0];
  const plant::Setup slow = planar_setup(walk({"valve.exhaust.opening_delay_slope=1e-9 s/Pa"}));
  EXPECT_EQ(slow.muscles[0].exhaust.opening_delay_slope, 1e-9);
}

// The mass that the muscles took equals that lost by the tank: m R T/V.
TEST(AirOfAFile, ATankLosesWhatTheMusclesTake) {
  const experiment::Experiment e = walk(tank);
  const Outcome out = run(e);
  double taken = 0;
  for (const robot::Muscle& m : e.robot.muscles)
    taken += last(out.table, "/true/muscle/" + m.name + "/air_in");
  const double drop = taken * e.air.gas_constant * e.air.temperature / 1e-3;
  EXPECT_GT(drop, 2e4);  // a step takes a few percent of the pressure
  EXPECT_NEAR(last(out.table, "/true/supply/tank_pressure"), e.supply.initial_pressure - drop, 1.0);
  EXPECT_EQ(last(out.table, "/true/supply/pressure"),
            last(out.table, "/true/supply/tank_pressure"));
}

// Inflow = outflow + leakage + increase in the muscle.
TEST(AirOfAFile, ALeakIsInTheBalance) {
  const Outcome out = run(walk({"muscle.knee_extensor.leak.area=0.05 mm2"}));
  const std::string at = "/true/muscle/knee_extensor/";
  const double in = last(out.table, at + "air_in"), leaked = last(out.table, at + "air_leaked");
  EXPECT_GT(leaked, 0.02 * in);
  double first = 0;
  for (const signals::Series& s : out.table.series)
    if (s.topic.name == at + "mass") first = s.columns[0].front();
  EXPECT_NEAR(in, last(out.table, at + "air_out") + leaked + last(out.table, at + "mass") - first,
              1e-3 * in);
}

// 4.3: with its spring, the reversed exhaust does not open against more than 35 psi.
TEST(AirOfAFile, AnExhaustThatFailsHoldsItsAir) {
  const auto vented = [](const Sets& sets) {
    const Outcome out = run(walk(sets));
    return last(out.table, "/true/muscle/hip_flexor/air_out");
  };
  EXPECT_LT(vented({"valve.exhaust.fails_above=35 psi diff"}), 0.5 * vented({}));
  EXPECT_EQ(vented({"valve.exhaust.fails_above=150 psi diff"}),
            vented({"valve.exhaust.fails_above=200 psi diff"}));
}

// Pressure regulators replace all valves: the low level sends levels, and the joints follow.
TEST(AirOfAFile, RegulatorsTakeTheLowLevelsSetPoints) {
  experiment::Experiment e = walk();
  for (gas::Valve& v : e.valves)
    if (v.name == "inlet") {
      v.kind = gas::Valve::Kind::regulator;
      v.regulator = {.range = 6.2e5, .time_constant = 0.02};
    }
  for (robot::Muscle& m : e.robot.muscles) m.exhaust.clear();
  ASSERT_FALSE(plain(e));
  const Outcome out = run(e);
  ASSERT_EQ(out.status, signals::Status::ok);
  double most = 0, least = 1e9;
  for (const signals::Series& s : out.table.series)
    if (s.topic.name == "/true/muscle/knee_flexor/pressure")
      for (const double p : s.columns[0]) {
        most = std::max(most, p);
        least = std::min(least, p);
      }
  EXPECT_GT(most, e.air.atmosphere + 0.3 * 6.2e5);  // levels arrive and have an effect
  EXPECT_LE(most, e.air.atmosphere + 6.2e5);
  EXPECT_LT(least, e.air.atmosphere + 0.2 * 6.2e5);
}

TEST(AirOfAFile, WhatDoesNotFitTogetherIsReported) {
  const auto says = [](const Sets& sets, const std::string& words) {
    const std::string text = refusal(sets);
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says({"air.supply.kind=tank"}, "air.supply.volume: missing; expected m3 (volume)");
  says({"air.supply.volume=1 L"},
       "air.supply.volume: found a key of kind = \"tank\"; expected pressure alone");
  says({"valve.inlet.kind=regulator"}, "valve.inlet.regulator: found no range");
  says({"valve.inlet.kind=3-way"},
       "muscle.hip_flexor.exhaust: found \"exhaust\"; expected none, as the inlet also vents");
  says({"valve.exhaust.kind=3-way"},
       "muscle.hip_flexor.exhaust.valve: found \"exhaust\"; expected a 2-way valve");
  says({"muscle.hip_flexor.hose.length=1 m"},
       "muscle.hip_flexor.hose.length: found a key of another law; expected law = \"pipe\"");
  says({"muscle.hip_flexor.hose.volume=5 mL"},
       "muscle.hip_flexor.hose.volume: found a hose that resists nothing");
  says({"valve.exhaust.fails_above=35 psi"}, "psi");
  says({"air.wall_time=1 us"}, "air.wall_time: found less than 0.1 ms");
  says({"air.supply.kind=tank", "air.supply.volume=1 L", "air.supply.initial_pressure=5 psi abs"},
       "air.supply.initial_pressure: found 5 psi abs; expected above the atmosphere");
  says({"cylinder.mode=regulator", "cylinder.pressure=200 psi gauge"},
       "cylinder.pressure: found 200 psi gauge; expected at most the supply's, 100 psi gauge");
  says({"start.lift=1 in"}, "start.lift: found 1 in; expected 0: no cylinder lifts the body");
  says({"valve.inlet.drive=speed-up"}, "valve.inlet.speed_up: found not both delays of the drive");
  says({"joint.hip.pressure_law.bias=30 %"},
       "joint.hip.pressure_law.bias: found a joint with 2-way valves");
  says({"joint.hip.pressure_law.angle_integral=1 %/(count s)"},
       "joint.hip.pressure_law.angle_integral: found a joint without regulators");
  says({"joint.hip.spring=1 lbf in/rad"}, "joint.hip.spring_angle: missing");
  says({"joint.hip.damper=1e6 lbf in s/rad"}, "plant_steps.body: found a machine that needs steps");
  says({R"(muscle.hip_flexor.cam={angle=["240 deg","320 deg"],radius=["0 in","0 in"]})"},
       "muscle.hip_flexor.cam.radius: found 0 at the joint's rest angle");
  says({R"(muscle.hip_flexor.cam={angle=["240 deg","320 deg"],radius=["1 in","1 in"]})",
        "muscle.hip_flexor.moment_arm=1 in"},
       "muscle.hip_flexor.moment_arm: found a round cam and a table");
  Sets thin = pipe;
  thin.push_back("muscle.hip_flexor.hose.volume=0.0001 mL");
  EXPECT_EQ(refusal(thin), "nothing");  // quick air is integrated ahead
  thin.push_back("air.wall_time=0.3 s");
  says(thin, "a hose or a cylinder's chamber that fills within");
}

}  // namespace
}  // namespace sinew::run::air_test
