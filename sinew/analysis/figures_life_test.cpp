// Figures on wear: cycles of a log with known motion, shares of a life and of a valve's switchings.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/selection.h"
#include "sinew/analysis/summary.h"

namespace sinew::analysis::figures_life_test {
namespace {

using test::constant;
using test::walk;

constexpr double arm = 0.02, longest = 0.1;  // [m]

Machine leg() {
  Machine m = test::walking_leg();
  m.actuators[0].long_end.length = longest;
  for (robot::Joint& j : m.robot.joints) j.moment_arm = arm;
  return m;
}

// The hip swings twice about its rest angle, with an amplitude of `swing` [rad]; its flexor's
// pressure follows.
test::Log swings(const Machine& m, double swing) {
  test::Log log = walk(2, 0, test::dt);
  const auto wave = [](double t) { return std::cos(2 * std::numbers::pi * t); };
  log.scalar("/joint/hip/angle",
             [=, &m](double t) { return m.robot.joints[0].rest_angle + swing * wave(t); });
  log.scalar("/true/muscle/hip_flexor/pressure", [=](double t) { return 3e5 + 1e5 * wave(t); });
  log.scalar("/true/muscle/hip_flexor/air_in", constant(1));
  return log;
}

double value(const Summary& s, const std::string& key) {
  const double* at = s.find(key);
  EXPECT_NE(at, nullptr) << key;
  return at ? *at : std::nan("");
}

TEST(Wear, CyclesOfASwing) {
  const Machine m = leg();
  const Summary s = summarize(swings(m, 0.25).table, m);
  for (const std::string muscle : {"muscles.hip_flexor.", "muscles.hip_extensor."}) {
    EXPECT_EQ(value(s, muscle + "contraction_cycles"), 2) << muscle;
    EXPECT_NEAR(value(s, muscle + "largest_contraction_range"), 0.5 * arm / longest, 1e-9);
  }
  EXPECT_EQ(value(s, "muscles.hip_flexor.pressure_cycles_true"), 2);
  EXPECT_NEAR(value(s, "muscles.hip_flexor.largest_pressure_range_true_diff_Pa"), 2e5, 1);
  EXPECT_EQ(s.find("muscles.hip_flexor.pressure_cycles"), nullptr) << "no sensor";
  EXPECT_EQ(s.find("muscles.knee_flexor.contraction_cycles"), nullptr) << "not logged";
  EXPECT_EQ(s.find("muscles.hip_flexor.life_share_over"), nullptr) << "no [life]";
}

TEST(Wear, NoiseIsNoCycle) {
  const Machine m = leg();
  const Summary s = summarize(swings(m, 0.02).table, m);
  EXPECT_EQ(value(s, "muscles.hip_flexor.contraction_cycles"), 0);
  EXPECT_EQ(value(s, "muscles.hip_flexor.largest_contraction_range"), 0);
}

TEST(Wear, ASensorOfPressureCountsToo) {
  Machine m = leg();
  m.robot.sensors.push_back({.name = "p",
                             .kind = robot::Sensor::Kind::pressure,
                             .of = "hip_flexor",
                             .assumed_scale = 1e-5});
  test::Log log = swings(m, 0.25);
  const double per_count = 1 / (1e-5 * m.robot.converter.counts_per_volt());
  log.scalar("/sensor/p/count",
             [](double t) { return 500 + 100 * std::cos(2 * std::numbers::pi * t); });
  const Summary s = summarize(log.table, m);
  EXPECT_EQ(value(s, "muscles.hip_flexor.pressure_cycles"), 2);
  EXPECT_NEAR(value(s, "muscles.hip_flexor.largest_pressure_range_diff_Pa"), 200 * per_count, 1);
}

// Two cycles at the reference: at least 2/5000 and at most 2/1000 of a life.
TEST(Wear, SharesOfALife) {
  Machine m = leg();
  m.actuators[0].life = {.contraction = 0.1,
                         .cycles_over = 1000,
                         .cycles_under = 5000,
                         .exponent_least = 1,
                         .exponent_most = 8};
  const std::string over = "muscles.hip_flexor.life_share_over",
                    under = "muscles.hip_flexor.life_share_under";
  const Summary both = summarize(swings(m, 0.25).table, m);
  EXPECT_NEAR(value(both, over), 2.0 / 5000, 1e-9);
  EXPECT_NEAR(value(both, under), 2.0 / 1000, 1e-8);

  m.actuators[0].life.cycles_under = 0;
  const Summary low = summarize(swings(m, 0.25).table, m);
  EXPECT_EQ(low.find(over), nullptr);
  EXPECT_NEAR(value(low, under), 2.0 / 1000, 1e-8);

  m.actuators[0].life.pressure = 4e5;
  EXPECT_NEAR(value(summarize(swings(m, 0.25).table, m), under), 2.0 / 1000, 1e-8);
  m.actuators[0].life.pressure = 2e5;
  EXPECT_EQ(summarize(swings(m, 0.25).table, m).find(under), nullptr) << "pressed harder";

  m.actuators[0].life = {.contraction = 0.1, .cycles_under = 5000};
  const Summary high = summarize(swings(m, 0.25).table, m);
  EXPECT_EQ(high.find(under), nullptr);
  EXPECT_NEAR(value(high, over), 2.0 / 5000, 1e-9);
}

TEST(Wear, AValveUsesItsSwitchings) {
  Machine m = leg();
  m.robot.muscles[0].inlet = "rated";
  m.robot.muscles[0].exhaust = "other";
  m.valves = {{.name = "rated", .rated_switchings = 1000}, {.name = "other"}};
  test::Log log = swings(m, 0.25);
  const std::string name = m.robot.muscles[0].name;
  log.pulses("/valve/" + name + "/inlet/open", 1e-3, 1);
  log.pulses("/valve/" + name + "/exhaust/open", 1e-3, 1);
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "valves." + name + ".inlet_life_share"), 0.1, 1e-12);
  EXPECT_EQ(s.find("valves." + name + ".exhaust_life_share"), nullptr);
}

// Rows of an imported table that are too far apart for pulses give no figure of the valves.
TEST(Wear, ValvesWithoutTheirPulsesHaveAWarningAndNoFigures) {
  Machine m = leg();
  m.robot.muscles[0].inlet = m.robot.muscles[0].exhaust = "rated";
  m.valves = {{.name = "rated", .rated_switchings = 1000}};
  test::Log log = swings(m, 0.25);
  const std::string name = m.robot.muscles[0].name;
  for (const char* which : {"/inlet/open", "/exhaust/open"})
    log.pulses("/valve/" + name + which, 1e-3, 1);
  const std::vector<std::string> keys = {
      "valves.switchings", "valves.coil_time_s", "valves." + name + ".inlet_life_share",
      "muscles." + name + ".delivered_inlet_duty", "muscles." + name + ".passiveness_delivered"};
  const Summary known = summarize(log.table, m);
  EXPECT_TRUE(known.find(keys[0]) && known.find(keys[1]) && known.find(keys[2]));
  EXPECT_TRUE(coarse_valves(log.table).empty());

  log.table.series.back().topic.description = signals::coarse_edges;
  log.table.series[log.table.series.size() - 2].topic.description = signals::coarse_edges;
  const Summary s = summarize(log.table, m);
  for (const std::string& key : keys) EXPECT_EQ(s.find(key), nullptr) << key;
  ASSERT_EQ(s.warnings.size(), known.warnings.size() + 1);
  EXPECT_EQ(texts(coarse_valves(log.table)),
            std::vector<std::string>{
                "the rows of the table are too far apart to give the pulses of 2 valves: figures "
                "of delivered duties, switchings and coils are absent"});
}

// A selection of one figure reads the channels of that figure, and has its bits.
TEST(Wear, CanBeSelected) {
  Machine m = leg();
  m.actuators[0].life = {.contraction = 0.1, .cycles_under = 5000};
  const test::Log log = swings(m, 0.25);
  const std::string key = "muscles.hip_extensor.contraction_cycles";
  const Selection selection({key}, log.table, m);
  EXPECT_TRUE(selection.topics().contains("/joint/hip/angle"));
  EXPECT_FALSE(selection.topics().contains("/true/muscle/hip_extensor/pressure"));
  const auto chosen = selection.figures(log.table, m);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(value(*chosen, key), 2);
  const std::string life = "muscles.hip_flexor.life_share_over";
  EXPECT_EQ(value(*Selection({life}, log.table, m).figures(log.table, m), life),
            value(summarize(log.table, m), life));
}

}  // namespace
}  // namespace sinew::analysis::figures_life_test
