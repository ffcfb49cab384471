// Another plumbing of the leg changes its walk as the laws of the plumbing predict.
#include <gtest/gtest.h>

#include "runs.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::plumbing_test {
namespace {

using test::figure, test::seed, test::summary_of;
using units::inch;

// 5.1: the same path, supply and muscles, the same distance within an inch and a half, an equally
// small spread; and ten times the air at least, because no valve ever seals.
TEST(Plumbing, ThreeWayValvesWalkAsFarOnTenTimesTheAir) {
  for (int n = 1; n <= 5; ++n) {
    const analysis::Summary two = summary_of("walk-test-1", {seed(n)}),
                            three = summary_of("walk-3-way", {seed(n)});
    EXPECT_NEAR(figure(three, "trolley.distance_m") / inch,
                figure(two, "trolley.distance_m") / inch, 1.5);
    EXPECT_GT(figure(three, "air_used_kg_per_m"), 10 * figure(two, "air_used_kg_per_m"));
    EXPECT_GT(figure(three, "valves.coil_energy_J_per_m"),
              figure(two, "valves.coil_energy_J_per_m"));
    EXPECT_EQ(figure(three, "passiveness"), 0);
    EXPECT_GT(figure(two, "passiveness"), 0.6);
  }
}

// For any size of valve between the leg's two, and for Robot III's own valve.
TEST(Plumbing, TheValvesSizeDoesNotExcuseTheAir) {
  const double two = figure(summary_of("walk-test-1"), "air_used_per_step_kg");
  for (const char* area : {"9.774e-6 ft2", "2.142e-5 ft2"}) {
    const std::string set = std::string("valve.three_way.flow.area=") + area;
    EXPECT_GT(figure(summary_of("walk-3-way", {set}), "air_used_per_step_kg"), 8 * two) << area;
  }
  std::vector<std::string> sets;
  for (const char* m : {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"})
    sets.push_back(std::string("muscle.") + m + ".inlet.valve=\"758\"");
  EXPECT_GT(figure(summary_of("walk-3-way", sets), "air_used_per_step_kg"), 8 * two);
}

// Between the two: a regulator vents the air that it supplied, but it seals the muscle in between.
TEST(Plumbing, RegulatorsWalkOnAirBetweenTheTwo) {
  for (int n = 1; n <= 3; ++n) {
    const analysis::Summary two = summary_of("walk-test-1", {seed(n)}),
                            three = summary_of("walk-3-way", {seed(n)}),
                            regulated = summary_of("walk-with-regulators", {seed(n)});
    EXPECT_NEAR(figure(regulated, "trolley.distance_m") / inch, 55, 3);
    EXPECT_GT(figure(regulated, "air_used_per_step_kg"),
              1.05 * figure(two, "air_used_per_step_kg"));
    EXPECT_LT(figure(regulated, "air_used_per_step_kg"),
              0.1 * figure(three, "air_used_per_step_kg"));
  }
}

// A regulator is always open: its muscle may be faster than a step of the body. Air that flows to
// and fro in each step would be counted again and again.
TEST(Plumbing, RegulatorsTakeNoMoreAirInLongSteps) {
  for (const char* conductance : {"1 L/(s bar)", "10 L/(s bar)"}) {
    const auto air = [&](const char* step) {
      const std::string wide = std::string("valve.regulator.flow.sonic_conductance=") + conductance;
      return figure(summary_of("walk-with-regulators", {wide, step}), "air_used_kg");
    };
    EXPECT_NEAR(air("plant_steps.body=1 ms") / air("plant_steps.body=0.2 ms"), 1, 0.01);
  }
}

// A slow one walks less far: half the distance at 200 ms.
TEST(Plumbing, SlowRegulatorsSlowTheWalk) {
  const auto distance = [](const char* time) {
    const std::string set = std::string("valve.regulator.regulator.time_constant=") + time;
    return figure(summary_of("walk-with-regulators", {set}), "trolley.distance_m");
  };
  EXPECT_GT(distance("10 ms"), distance("100 ms"));
  EXPECT_LT(distance("200 ms"), 0.5 * distance("10 ms"));
}

// --- air consumption of a robot that carries its tank -------------------------------------------

// The air that has left the tank has entered the muscles: m = dP V/(R T).
TEST(Endurance, TheTankLosesWhatTheMusclesTake) {
  const analysis::Summary s = summary_of("endurance", {"sequence.repeat=25"});
  const double lost = units::absolute(300 * units::psi) - figure(s, "supply.end_tank_pressure_Pa");
  const double volume = 0.5e-3, gas_constant = 286.98629312304, temperature = 528 * units::rankine;
  const double air = lost * volume / (gas_constant * temperature);
  EXPECT_NEAR(figure(s, "air_used_kg"), air, 1e-6 * air);
}

TEST(Endurance, PlumbingDecidesHowFarATankLasts) {
  const auto steps = [](const char* name) {
    const std::string robot = sinew::test::source_dir() + "/robots/" + name + "/robot.toml";
    return figure(summary_of("endurance", {"sequence.repeat=25", "robot=" + robot}),
                  "supply.full_steps");
  };
  const double two = steps("leg"), regulated = steps("leg-with-regulators"),
               three = steps("leg-3-way");
  EXPECT_GE(two, 17);
  EXPECT_GE(two, regulated);
  EXPECT_GT(regulated, 10 * three);
}

// A line that never falls was full for at least the whole run, and has no time of its fall.
TEST(Endurance, ALineThatHoldsOutHasALowerBound) {
  const analysis::Summary s = summary_of("endurance", {"sequence.repeat=1"});
  EXPECT_EQ(s.find("supply.full_time_s"), nullptr);
  EXPECT_EQ(s.find("supply.full_steps"), nullptr);
  EXPECT_NEAR(figure(s, "supply.full_time_at_least_s"), figure(s, "duration_s"), 2.0);
  EXPECT_EQ(figure(s, "supply.full_steps_at_least"), 1);
  EXPECT_GT(figure(s, "supply.full_distance_at_least_m"), 0);
}

// 4.2's tank of 100 gallons, at its own 100 psi: a walk uses very little of it.
TEST(Endurance, TheThesissTankHardlyMoves) {
  const analysis::Summary s = summary_of(
      "walk-test-1", {"air.supply={ kind = \"tank\", volume = \"378.5 L\", initial_pressure = "
                      "\"100 psi gauge\", pressure = \"100 psi gauge\" }"});
  const double end = figure(s, "supply.end_tank_pressure_Pa");
  EXPECT_NEAR((units::absolute(100 * units::psi) - end) / units::psi, 0.05, 0.02);
}

// --- hoses --------------------------------------------------------------------------------------

// 3.4: a hose reduces the flow, so the walk gets shorter with it; it adds hardly any damping.
TEST(Hoses, TakeWayAndHardlyDamp) {
  double last = figure(summary_of("walk-test-1"), "trolley.distance_m");
  const char* shakes = "joints.hip.swing_oscillation_rms_rad";
  const double plain = figure(summary_of("walk-test-1"), shakes);
  for (const char* length : {"0.5 m", "1 m", "2 m", "4 m"}) {
    std::vector<std::string> sets;
    for (const char* m : {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"})
      sets.push_back(std::string("muscle.") + m + ".hose={ law = \"pipe\", length = \"" + length +
                     "\", inner_diameter = \"2.5 mm\" }");
    const analysis::Summary s = summary_of("walk-test-1", sets);
    EXPECT_LT(figure(s, "trolley.distance_m"), last) << length;
    EXPECT_GT(figure(s, shakes), 0.85 * plain) << length;
    last = figure(s, "trolley.distance_m");
  }
}

}  // namespace
}  // namespace sinew::plumbing_test
