// Warnings of a robot that does nothing, or that can go no further.
#include <gtest/gtest.h>

#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/warnings.h"
#include "sinew/units/constants.h"

namespace sinew::analysis::idle_test {
namespace {

using test::constant;
using test::Log;
using test::walk;
using units::degree;

Machine machine() {
  Machine m = test::walking_leg();
  m.valves = {{.name = "inlet", .opening = 2e-3, .closing = 1e-3, .coil = {}, .shut = 2e-3},
              {.name = "exhaust", .opening = 2e-3, .closing = 1e-3, .coil = {}, .shut = 2e-3}};
  m.actuators[0].braid.thread_length = 0.107;
  return m;
}

// --- valves ---

TEST(UnopenedValves, AreThoseThatDeliverLittleOfTheirDuty) {
  Log log = walk(2);
  log.pulses("/valve/hip_flexor/inlet/open", 1.5e-3, 1);
  log.pulses("/valve/knee_extensor/inlet/open", 1.4e-3, 1);
  log.pulses("/valve/hip_extensor/inlet/open", 4.1e-3, 1);
  log.pulses("/valve/knee_flexor/inlet/open", 0, 1);
  const auto found = unopened_valves(log.table, machine());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(
      found[0].text,
      "hip_flexor and 1 more muscle: the inlet hardly opens: 0 % of the time for 7.54 % "
      "commanded; half of its 100 pulses last 1.5 ms at most, and the valve takes 2 ms to open; "
      "try more low_level.pwm_ticks, or a quicker valve");
  ASSERT_EQ(found[0].spans.size(), 1u);
  EXPECT_NEAR(found[0].spans[0].to, 0.99, 1e-9);
}

// A pulse as long as the delay ends when the shutter would begin to move.
TEST(UnopenedValves, APulseAsLongAsTheDelayOpensNothing) {
  Log log = walk(2);
  log.pulses("/valve/hip_flexor/exhaust/open", 2e-3, 1);
  EXPECT_EQ(unopened_valves(log.table, machine()).size(), 1u);
}

TEST(UnopenedValves, AreNoneWhereAirWentThrough) {
  Log log = walk(2);
  log.pulses("/valve/hip_flexor/inlet/open", 1e-3, 1);
  log.scalar("/true/muscle/hip_flexor/air_in", [](double t) { return 1e-6 * t; });
  EXPECT_TRUE(unopened_valves(log.table, machine()).empty());
  Machine ideal = machine();
  ideal.valves.clear();
  EXPECT_TRUE(unopened_valves(log.table, ideal).empty()) << "a valve without delay opens at once";
}

// --- air ---

Log without_air(const test::Of& desired) {
  Log log = walk(2, 0.5);
  log.scalar("/desired/joint/hip/angle", desired);
  for (const char* muscle : {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"})
    log.scalar(std::string("/true/muscle/") + muscle + "/air_in", constant(0));
  return log;
}

TEST(UnusedAir, IsReportedOfAPlanThatMovesAJoint) {
  const Log log = without_air([](double t) { return 4.8 + 0.1 * t; });
  const auto found = unused_air(log.table, machine());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text,
            "no muscle took any air in the 2 s of the plan, whatever it commanded: the robot does "
            "nothing");
}

TEST(UnusedAir, IsReportedOfAnInletThatWasCommandedToOpen) {
  Log log = without_air(constant(4.8));
  EXPECT_TRUE(unused_air(log.table, machine()).empty()) << "joints that are held may need no air";
  log.scalar("/muscle/knee_flexor/inlet_duty", constant(0.01));
  EXPECT_EQ(unused_air(log.table, machine()).size(), 1u);
}

TEST(UnusedAir, IsUnknownForHardwareAndNotReportedOfAnIdleJoint) {
  Log hardware = walk(2);
  hardware.scalar("/desired/joint/hip/angle", [](double t) { return 4.8 + 0.1 * t; });
  EXPECT_TRUE(unused_air(hardware.table, machine()).empty());

  Machine off = machine();
  off.robot.joints[0].enabled = false;
  const Log log = without_air([](double t) { return 4.8 + 0.1 * t; });
  EXPECT_TRUE(unused_air(log.table, off).empty());
}

// --- track ---

TEST(EndedTracks, AreReportedWithTheTimeInTheSummary) {
  Machine m = machine();
  m.robot.trolley.present = true;
  m.robot.trolley.track_length = 0.1;
  Log log = walk(2, 0.5);
  log.scalar("/true/trolley/position", [](double t) { return t < 1.4995 ? 0.05 : 0.1001; });
  const auto found = ended_tracks(log.table, m);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text,
            "the trolley reaches the end of its track at 1.50 s, 1.00 s before the sequence is "
            "over: distance and mean speed are up to there");
  const Summary s = summarize(log.table, m);
  ASSERT_NE(s.find("trolley.stop_reached_s"), nullptr);
  EXPECT_NEAR(*s.find("trolley.stop_reached_s"), 1.0, 1e-9);

  m.robot.trolley.track_length = 0.2;
  EXPECT_TRUE(ended_tracks(log.table, m).empty());
  EXPECT_EQ(summarize(log.table, m).find("trolley.stop_reached_s"), nullptr);
}

// --- joints ---

// The hip rests at 278 deg; its muscles are 3.15 in long there and have arms of 1 in.
std::vector<Warning> turned(const test::Of& angle) {
  Log log = walk(2);
  log.scalar("/true/joint/hip/angle", angle);
  return joints_beyond_range(log.table, machine());
}

TEST(OverturnedJoints, GoRoundByMoreThanATurn) {
  const auto found = turned([](double t) { return (278 + 200 * t) * degree; });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text, "hip: turned 398 deg from its rest angle: more than a whole turn");
  ASSERT_EQ(found[0].spans.size(), 1u);
  EXPECT_LT(found[0].spans[0].from, 0.9) << "a muscle ends before";
}

TEST(OverturnedJoints, RequireMoreOfAMuscleThanItsThreadHas) {
  // 3.15 in + pi/2 in = 119.9 mm; the thread has 107 mm.
  const auto found = turned([](double t) { return (278 + (t < 1 ? 0 : 90)) * degree; });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text,
            "hip: turned 90 deg from its rest angle: hip_extensor would be 119.9 mm long, beyond "
            "its thread's 107 mm");
}

TEST(OverturnedJoints, AreNoneWithinWhatMusclesReach) {
  EXPECT_TRUE(turned([](double t) { return (278 + 20 * t) * degree; }).empty());
  EXPECT_TRUE(turned([](double t) { return (278 - 360 + 20 * t) * degree; }).empty())
      << "of equal angles the one next to the rest angle is meant";
}

}  // namespace
}  // namespace sinew::analysis::idle_test
