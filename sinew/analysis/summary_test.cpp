#include "sinew/analysis/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "sinew/analysis/record/test_log.h"

namespace sinew::analysis::summary_test {
namespace {

using test::constant;
using test::duties;
using test::walk;
using test::walking_leg;

double value(const Summary& s, std::string_view key) {
  const double* v = s.find(key);
  EXPECT_NE(v, nullptr) << key;
  return v ? *v : std::nan("");
}

TEST(Summary, TimesAndStepsAreThoseOfTheSequence) {
  const Summary s = summarize(walk(3, 0.6, 0.5).table, walking_leg());
  EXPECT_NEAR(value(s, "duration_s"), 4.1, 1e-12);
  EXPECT_NEAR(value(s, "sequence_duration_s"), 3, 1e-12);
  EXPECT_EQ(value(s, "steps"), 3);
  EXPECT_NEAR(value(s, "phases.swing.mean_duration_s"), 0.4, 1e-12);
  EXPECT_NEAR(value(s, "phases.propulsion.mean_duration_s"), 0.5, 1e-12);
}

// A foot that continues to move in the hold after the kick: x rises by 0.2 m in 0.2 s from 0.05 s
// on, beyond the extended position at half of that way.
TEST(Summary, TheKickHasATimeToTheExtendedPositionAndOneToThePeak) {
  Machine m = walking_leg();
  m.phases = m.sequence = {"retracted", "kick", "extended"};
  test::Log log(100);
  log.scalar("/plan/phase", [](double t) { return t < 0.295 ? 0.0 : t < 0.395 ? 1.0 : 2.0; });
  log.scalar("/plan/step", constant(0));
  const double start = 0.35;
  // The leg is straight and moves the hip only: x = l cos(theta).
  const double l = m.robot.links[0].length + m.robot.links[1].length;
  const auto x = [=](double t) {
    const double s = (t - start) / 0.2;
    return s < 0 ? -0.1 : s < 1 ? -0.1 + 0.2 * s : s < 1.5 ? 0.1 - 0.1 * (s - 1) : 0.05;
  };
  log.scalar("/joint/hip/angle", [=](double t) { return -std::acos(x(t) / l); });
  log.scalar("/joint/knee/angle", constant(0));
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "foot.extension_time_to_peak_s"), 0.8 * 0.2, 1e-9);
  EXPECT_NEAR(value(s, "foot.extension_whole_time_s"), start + 0.2 - 0.3, 1e-9);
  EXPECT_EQ(s.find("foot.extension_time_s"), nullptr) << "nobody said where to";

  const auto to = [&](double extended) {
    test::Log wanted = log;
    wanted.vector(
        "/desired/foot/position", [=](double t) { return t < 0.895 ? 0.7 : extended; },
        constant(0));
    return summarize(wanted.table, m);
  };
  EXPECT_NEAR(value(to(0.0), "foot.extension_time_s"), 0.8 * 0.1, 1e-9);
  EXPECT_NEAR(value(to(0.1), "foot.extension_time_s"), 0.8 * 0.2, 1e-9);
  EXPECT_EQ(to(0.2).find("foot.extension_time_s"), nullptr) << "it never gets there";
  EXPECT_NEAR(value(to(0.2), "foot.extension_time_to_peak_s"), 0.8 * 0.2, 1e-9);
}

// A reading that alternates between two counts: the velocity jumps by twice count / period.
TEST(Summary, VelocityJumpsOfAReadingThatFlickers) {
  const double count = 1.0 / 767;
  test::Log log = walk(2);
  log.scalar("/joint/hip/angle", constant(4));
  log.scalar("/joint/hip/velocity_estimate", [=](double t) {
    return std::llround(t / test::dt) % 2 == 0 ? count / test::dt : -count / test::dt;
  });
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "joints.hip.velocity_jump_rms_rad_per_s"), 200.0 / 767, 1e-12);
  EXPECT_NEAR(value(s, "joints.hip.velocity_jump_largest_rad_per_s"), 200.0 / 767, 1e-12);
  EXPECT_EQ(value(s, "joints.hip.excursion_rad"), 0);
}

// An error with four turning points in one swing, and an amplitude that is too small in the others.
TEST(Summary, TurningPointsAreCountedPerPhaseAndTime) {
  const double deg = std::numbers::pi / 180;
  const auto error = [=](double t) {
    const double in_swing = (t - 2) / 0.4;  // of the third step: two periods of 3 deg
    if (in_swing >= 0 && in_swing < 1) return 3 * deg * std::sin(4 * std::numbers::pi * in_swing);
    return 0.3 * deg * std::sin(40 * t);  // too small
  };
  test::Log log = walk(3);
  log.scalar("/desired/joint/hip/angle", [](double t) { return 5 + 0.1 * t; });
  log.scalar("/joint/hip/angle", [=](double t) { return 5 + 0.1 * t + error(t); });
  const Summary s = summarize(log.table, walking_leg());
  const std::string swing = "phases.swing.joints.hip.", push = "phases.propulsion.joints.hip.";
  EXPECT_EQ(value(s, swing + "turning_points"), 4);
  EXPECT_EQ(value(s, swing + "fewest_turning_points"), 0);
  EXPECT_EQ(value(s, swing + "most_turning_points"), 4);
  EXPECT_NEAR(value(s, swing + "oscillation_amplitude_rad"), 3 * deg, 1e-9);
  EXPECT_NEAR(value(s, swing + "largest_oscillation_amplitude_rad"), 3 * deg, 1e-9);
  EXPECT_EQ(value(s, push + "turning_points"), 0);
  EXPECT_EQ(value(s, push + "oscillation_amplitude_rad"), 0);
  EXPECT_EQ(s.find("phases.swing.joints.knee.turning_points"), nullptr);
}

TEST(Summary, TrackingOfASineThatLags) {
  const double w = 2 * std::numbers::pi, lag = 0.03, amplitude = 0.2;
  test::Log log = walk(2, 0.5, 0.5);
  log.scalar("/joint/hip/angle", [=](double t) { return 5 + amplitude * std::sin(w * (t - lag)); });
  log.scalar("/desired/joint/hip/angle", [=](double t) { return 5 + amplitude * std::sin(w * t); });
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "joints.hip.tracking_rms_rad"),
              std::sqrt(2.0) * amplitude * std::sin(0.5 * w * lag), 1e-13);
  EXPECT_NEAR(value(s, "joints.hip.max_angle_rad"), 5.2, 1e-3);
  EXPECT_NEAR(value(s, "joints.hip.min_angle_rad"), 4.8, 1e-3);
}

// A slow lag and an offset vanish, an oscillation of 10 Hz within a swing remains.
TEST(Summary, OscillationIsWhatShakesInTheSwing) {
  const double amplitude = 0.05, w = 20 * std::numbers::pi;
  test::Log log = walk(3, 0.5, 0.5);
  log.scalar("/desired/joint/hip/angle", [](double t) { return 4 + 0.3 * t; });
  log.scalar("/joint/hip/angle",
             [=](double t) { return 4.1 + 0.3 * t + amplitude * std::sin(w * t); });
  const double half = std::numbers::pi * 0.1;
  const double gain = 1 - std::sin(21 * half) / (21 * std::sin(half));
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "joints.hip.swing_oscillation_rms_rad"), gain * amplitude / std::sqrt(2.0),
              1e-12);
  EXPECT_NEAR(value(s, "joints.hip.swing_oscillation_later_steps_rms_rad"),
              gain * amplitude / std::sqrt(2.0), 1e-12);
}

TEST(Summary, PassivenessIsOfTheBusiestMuscleOfTheBusiestJoint) {
  test::Log log = walk(2, 0.6, 0.4);
  duties(log, "hip_flexor", 0.02, 0.04);
  duties(log, "hip_extensor", 0.03, 0.01);
  duties(log, "knee_flexor", 0.11, 0.23);
  duties(log, "knee_extensor", 0.02, 0.03);
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "muscles.hip_extensor.passiveness"), 0.96, 1e-14);
  EXPECT_NEAR(value(s, "joints.hip.passiveness"), 0.94, 1e-14);   // table 6-4
  EXPECT_NEAR(value(s, "joints.knee.passiveness"), 0.66, 1e-14);  // table 6-4
  EXPECT_NEAR(value(s, "passiveness"), 0.66, 1e-14);
  EXPECT_NEAR(value(s, "muscles.knee_flexor.mean_exhaust_duty"), 0.23, 1e-14);
}

// A 3-way valve always joins its muscle to the supply or to the room, so it is never passive.
TEST(Summary, A3WayValveIsNeverPassive) {
  Machine m = walking_leg();
  m.valves = {{.name = "inlet", .kind = gas::Valve::Kind::three_way}};
  test::Log log = walk(2);
  duties(log, "hip_flexor", 0.3, 0);
  log.pulses("/valve/hip_flexor/inlet/open", 1e-3, 2.0);
  const Summary s = summarize(log.table, m);
  EXPECT_EQ(value(s, "muscles.hip_flexor.passiveness"), 0);
  EXPECT_EQ(value(s, "muscles.hip_flexor.passiveness_delivered"), 0);
  m.valves = {{.name = "inlet"}};
  EXPECT_NEAR(value(summarize(log.table, m), "muscles.hip_flexor.passiveness"), 0.7, 1e-14);
}

// Pulses of 1 ms with dead times of 0.4 and 0.9 ms deliver air for 15 % of the time, not 10.
TEST(Summary, DeliveredDutiesCarryTheDeadTimes) {
  Machine m = walking_leg();
  m.valves = {{"inlet", 0.4e-3, 0.9e-3}, {"exhaust", 1.5e-3, 0}};
  test::Log log = walk(2);
  log.pulses("/valve/hip_flexor/inlet/open", 1e-3, 2.0);
  log.pulses("/valve/hip_flexor/exhaust/open", 1e-3, 2.0);  // too short to open
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "muscles.hip_flexor.delivered_inlet_duty"), 0.15, 1e-9);
  EXPECT_EQ(value(s, "muscles.hip_flexor.delivered_exhaust_duty"), 0);
  EXPECT_NEAR(value(s, "muscles.hip_flexor.passiveness_delivered"), 0.85, 1e-9);
  EXPECT_EQ(value(s, "valves.switchings"), 400);
  EXPECT_EQ(value(s, "valves.switchings_per_step"), 200);
  EXPECT_NEAR(value(s, "valves.coil_time_s"), 0.4, 1e-9);
  EXPECT_EQ(s.find("valves.switchings_per_m"), nullptr);  // no trolley in this log
}

// 400 pulses of 1 ms at 2 W, half of them with a boost to 10 W for 0.25 ms. The figure is absent if
// the power of one valve is not given.
TEST(Summary, CoilsTakeTheirPowerByTheirTime) {
  Machine m = walking_leg();
  m.valves = {{"inlet", 0, 0, {.power = 2, .boost_power = 10, .boost_time = 0.25e-3}},
              {"exhaust", 0, 0, {.power = 2}}};
  test::Log log = walk(2);
  log.pulses("/valve/hip_flexor/inlet/open", 1e-3, 2.0);
  log.pulses("/valve/hip_flexor/exhaust/open", 1e-3, 2.0);
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "valves.coil_energy_J"), 400 * 2e-3 + 200 * 8 * 0.25e-3, 1e-9);
  EXPECT_NEAR(value(s, "valves.coil_energy_per_step_J"), value(s, "valves.coil_energy_J") / 2,
              1e-9);
  m.valves[1].coil = {};
  EXPECT_EQ(summarize(log.table, m).find("valves.coil_energy_J"), nullptr);
}

TEST(Summary, AirIsCountedPerStepAndPerMetre) {
  test::Log log = walk(2, 0.5, 0.5);
  for (const robot::Muscle& m : walking_leg().robot.muscles)
    log.scalar("/true/muscle/" + m.name + "/air_in", [](double t) { return 1e-4 * t; });
  log.scalar("/true/trolley/position", [](double t) { return 0.25 * t; });
  Machine m = walking_leg();
  m.robot.trolley.track_length = 10;
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "muscles.hip_flexor.air_used_kg"), 1e-4 * 2.99, 1e-15);
  EXPECT_NEAR(value(s, "air_used_kg"), 4e-4 * 2.99, 1e-14);
  EXPECT_NEAR(value(s, "air_used_per_step_kg"), 4e-4, 1e-14);
  EXPECT_NEAR(value(s, "air_used_kg_per_m"), 8e-4 / 0.5, 1e-13);
}

TEST(Summary, SpeedIsUpToTheStopOfTheTrack) {
  test::Log log = walk(4, 0.5, 0.5);
  log.scalar("/true/trolley/position",
             [](double t) { return std::min(1.2, 0.5 * std::max(0.0, t - 0.5)); });
  Machine m = walking_leg();
  m.robot.trolley.track_length = 1.2;
  const Summary stopped = summarize(log.table, m);
  EXPECT_NEAR(value(stopped, "trolley.distance_m"), 1.2, 1e-12);
  EXPECT_NEAR(value(stopped, "trolley.mean_speed_m_per_s"), 0.5, 1e-3);
  m.robot.trolley.track_length = 2;
  EXPECT_NEAR(value(summarize(log.table, m), "trolley.mean_speed_m_per_s"), 0.3, 1e-12);
}

// The torques are zero, so that the error of the estimate is minus the true force.
TEST(Summary, GroundReactionBesideTheTrueOne) {
  test::Log log = walk(2);
  log.scalar("/joint/hip/angle", constant(5)).scalar("/joint/knee/angle", constant(5.3));
  for (const robot::Muscle& m : walking_leg().robot.muscles)
    log.scalar("/muscle/" + m.name + "/tension", constant(100));
  log.vector("/true/foot/force", constant(3),
             [](double t) { return test::phase_at(t) == 0 ? 1000.0 : 4.0; });
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "ground_reaction.mean_normal_stance_N"), 0, 1e-12);
  EXPECT_NEAR(value(s, "ground_reaction.mean_normal_stance_true_N"), 4, 1e-12);
  EXPECT_NEAR(value(s, "ground_reaction.peak_normal_true_N"), 4, 1e-12);
  EXPECT_NEAR(value(s, "ground_reaction.estimate_rms_error_N"), 5, 1e-12);
  EXPECT_NEAR(value(s, "ground_reaction.estimate_mean_error_normal_N"), -4, 1e-12);
}

// A leg at rest under a moving trolley: sticks for the first 30 % of propulsion, else slides at
// 0.1 m/s.
TEST(Summary, StickShareOfTheFirstHalfOfPropulsion) {
  test::Log log = walk(2);
  log.vector("/true/foot/force", constant(0), constant(20));
  for (const char* joint : {"hip", "knee"}) {
    log.scalar(std::string("/true/joint/") + joint + "/angle", constant(5));
    log.scalar(std::string("/true/joint/") + joint + "/velocity", constant(0));
  }
  log.scalar("/true/trolley/velocity", [](double t) {
    const double s = std::fmod(t + 1e-9, 1.0);
    return s >= 0.5 && s < 0.65 ? 0.001 : 0.1;
  });
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "foot.stick_share_first_half_propulsion"), 0.6, 1e-12);
  EXPECT_NEAR(value(s, "foot.stick_share_propulsion"), 0.3, 1e-12);
  EXPECT_NEAR(value(s, "foot.slip_per_step_m"), 0.1 * 0.45 + 0.001 * 0.15, 1e-12);
}

// Steps 1 .. 3 are 2 mm apart; step 0 differs by much more.
TEST(Summary, StepRepeatLeavesOutTheFirstStep) {
  test::Log log = walk(4, 0, 0.1);
  log.vector(
      "/true/foot/position",
      [](double t) {
        const double step = std::floor(t + 1e-9);
        return std::sin(2 * std::numbers::pi * t) + (step == 0 ? 7 : 0.002 * step);
      },
      constant(-0.3));
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "foot.step_repeat_true_rms_m"), 0.002 * std::sqrt(2.0 / 3.0), 2e-4);
}

// The trolley reaches the track's end in step 3, which is therefore left out.
TEST(Summary, StepRepeatEndsWithTheTrack) {
  test::Log log = walk(4, 0, 0.1);
  log.scalar("/true/trolley/position", [](double t) { return 0.1 * t; });
  log.vector(
      "/true/foot/position", [](double t) { return t < 3.1 ? 0.0 : 5.0; }, constant(-0.3));
  Machine m = walking_leg();
  m.robot.trolley.track_length = 0.35;
  EXPECT_NEAR(value(summarize(log.table, m), "foot.step_repeat_true_rms_m"), 0, 1e-12);
  m.robot.trolley.track_length = 10;
  EXPECT_GT(value(summarize(log.table, m), "foot.step_repeat_true_rms_m"), 1);
  m.robot.trolley.track_length = 0.25;  // only one step remains
  EXPECT_EQ(summarize(log.table, m).find("foot.step_repeat_true_rms_m"), nullptr);
}

TEST(Summary, MeanAndSpreadOfASensor) {
  Machine m = walking_leg();
  test::Log log = walk(2, 0.5, 0.5);
  const std::string name = m.robot.sensors[0].name;
  log.scalar("/sensor/" + name + "/count", [](double t) {
    if (t < 0.5 - 1e-9 || t > 2.5 - 1e-9) return 0.0;  // outside the sequence
    return std::llround(t / test::dt) % 2 == 0 ? 1897.0 : 1893.0;
  });
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "sensors." + name + ".mean_count"), 1895, 1e-9);
  EXPECT_NEAR(value(s, "sensors." + name + ".std_count"), 2, 1e-9);
}

TEST(Summary, PhasesEndWhereTheirLastRowStands) {
  test::Log log = walk(2, 0.3, 0.3);
  log.scalar("/true/joint/hip/angle", [](double t) { return t; });
  log.scalar("/true/muscle/knee_flexor/pressure", [](double t) { return 1e5 * t; });
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_NEAR(value(s, "phases.swing.joints.hip.end_angle_true_rad"), 1.3 + 0.39, 1e-9);
  EXPECT_NEAR(value(s, "phases.propulsion.muscles.knee_flexor.end_pressure_Pa"), 2.29e5, 1e-4);
  EXPECT_EQ(s.find("phases.swing.joints.hip.end_angle_rad"), nullptr);
}

TEST(Summary, RelaxedIsTheEndOfAPhaseOfThatName) {
  test::Log log = walk(1);
  log.scalar("/joint/hip/angle", [](double t) { return 5 + t; });
  Machine m = walking_leg();
  EXPECT_EQ(summarize(log.table, m).find("joints.hip.relaxed_angle_rad"), nullptr);
  m.phases[0] = "relaxed";
  EXPECT_NEAR(value(summarize(log.table, m), "joints.hip.relaxed_angle_rad"), 5.39, 1e-12);
}

TEST(Summary, ClippingAndPeaksOfAMuscle) {
  Machine m = walking_leg();  // 1 V/N: 819.2 counts per newton
  test::Log log = walk(1);
  log.scalar("/sensor/hip_extensor_sensor/count",
             [](double t) { return t > 0.745 ? 4095 : 819.2; });
  log.scalar("/muscle/hip_extensor/tension", [](double t) { return 100 + t; });
  log.scalar("/true/muscle/hip_extensor/tension", [](double t) { return 200 - t; });
  const Summary s = summarize(log.table, m);
  EXPECT_NEAR(value(s, "muscles.hip_extensor.clipped_share"), 0.25, 1e-12);
  EXPECT_NEAR(value(s, "muscles.hip_extensor.measured_peak_tension_N"), 4095 / 819.2, 1e-12);
  EXPECT_NEAR(value(s, "muscles.hip_extensor.own_scale_peak_tension_N"), 100.99, 1e-12);
  EXPECT_NEAR(value(s, "muscles.hip_extensor.peak_tension_N"), 200, 1e-12);
}

TEST(Summary, MissingReadingsAreLeftOut) {
  test::Log log = walk(2);
  log.scalar("/joint/hip/stiffness", [](double t) { return t < 0.995 ? std::nan("") : 4.0; });
  log.scalar("/joint/knee/stiffness", constant(std::nan("")));
  const Summary s = summarize(log.table, walking_leg());
  EXPECT_DOUBLE_EQ(value(s, "joints.hip.stiffness_mean_Nm_per_rad"), 4);
  EXPECT_DOUBLE_EQ(value(s, "joints.hip.stiffness_std_Nm_per_rad"), 0);
  EXPECT_EQ(s.find("joints.knee.stiffness_mean_Nm_per_rad"), nullptr);
}

TEST(Summary, WithoutTruthThereIsNoTrueKey) {
  test::Log log = walk(3, 0.5, 0.5);
  log.scalar("/joint/hip/angle", constant(5)).scalar("/joint/knee/angle", constant(5.3));
  for (const robot::Muscle& m : walking_leg().robot.muscles) {
    log.scalar("/muscle/" + m.name + "/tension", constant(100));
    duties(log, m.name, 0.1, 0.1);
  }
  const Summary s = summarize(log.table, walking_leg());
  for (const Entry& e : s.entries()) EXPECT_EQ(e.key.find("true"), e.key.npos) << e.key;
  for (const char* key : {"trolley.distance_m", "air_used_kg", "foot.slip_per_step_m",
                          "ground_reaction.estimate_rms_error_N"})
    EXPECT_EQ(s.find(key), nullptr) << key;
  for (const char* key : {"passiveness", "ground_reaction.mean_normal_stance_N",
                          "trolley.distance_from_torques_m", "foot.step_repeat_rms_m"})
    EXPECT_NE(s.find(key), nullptr) << key;
}

TEST(Summary, LogsThatHoldLittleOrNothing) {
  EXPECT_TRUE(summarize({}, walking_leg()).entries().empty());
  EXPECT_TRUE(summarize({}, Machine{}).entries().empty());
  test::Log empty(0);
  empty.scalar("/plan/phase", constant(0)).scalar("/joint/hip/angle", constant(0));
  EXPECT_TRUE(summarize(empty.table, walking_leg()).entries().empty());

  // No row is in the sequence, so that the duration is the only figure.
  test::Log idle(50);
  idle.scalar("/plan/phase", constant(-1)).scalar("/joint/hip/angle", constant(5));
  const Summary s = summarize(idle.table, walking_leg());
  EXPECT_NEAR(value(s, "duration_s"), 0.5, 1e-12);
  EXPECT_EQ(s.find("joints.hip.max_angle_rad"), nullptr);
}

TEST(Summary, OfACutLogTheLastStepDoesNotCount) {
  test::Log log = walk(3);
  log.table.complete = false;
  EXPECT_EQ(value(summarize(log.table, walking_leg()), "steps"), 2);
}

}  // namespace
}  // namespace sinew::analysis::summary_test
