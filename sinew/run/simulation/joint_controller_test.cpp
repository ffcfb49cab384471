// Setup of the low level for robots other than the leg.
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/run/setup/installation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/check.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "tests/places.h"

namespace sinew::run::joint_controller_run_test {
namespace {

using Kind = control::JointKind;

const std::string walk = sinew::test::source_dir() + "/experiments/walk-test-1.toml";

experiment::Experiment one_step(std::vector<std::string> sets = {}) {
  sets.push_back("sequence.repeat=1");
  return experiment::load(walk, sets);
}

std::string refusal(const experiment::Experiment& e) {
  try {
    refuse_contradictions("experiment", e);
    refuse_unbuildable(e);
  } catch (const config::Error& error) {
    return error.what();
  }
  return "nothing";
}

gas::Valve three_way(const experiment::Experiment& e) {
  for (const gas::Valve& v : e.valves)
    if (v.kind == gas::Valve::Kind::three_way) return v;
  return {};
}

void use_three_way(experiment::Experiment& e, const std::string& joint) {
  for (robot::Muscle& m : e.robot.muscles)
    if (m.joint == joint) m.inlet = three_way(e).name, m.exhaust = "";
}

// --- the law follows the valves ------------------------------------------------------------------

TEST(JointControllerRuns, ThreeWayValvesMakeAThreeWayJoint) {
  experiment::Experiment e = one_step();
  use_three_way(e, "knee");
  e.robot.joints[1].pressure_law.bias = 0.35;
  const control::JointControllerConfig c = control::joint_controller_config(installation(e));
  EXPECT_EQ(c.joint[0].kind, Kind::antagonist);
  EXPECT_EQ(c.joint[1].kind, Kind::three_way);
  EXPECT_EQ(c.joint[1].bias, 35);
  EXPECT_EQ(refusal(e), "nothing");
}

// Robot III's control, 5.1: it moves, its valves are never shut, and it uses more air.
TEST(JointControllerRuns, AThreeWayLegMovesAndSpendsMoreAir) {
  const experiment::Experiment sealed = one_step();
  experiment::Experiment e = one_step();
  use_three_way(e, "hip"), use_three_way(e, "knee");
  const auto air = [](const Outcome& out) {
    double sum = 0;
    for (const char* m : {"hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor"})
      sum += out.table.column("/true/muscle/" + std::string(m) + "/air_in")->back();
    return sum;
  };
  const Outcome two = run(sealed), three = run(e);
  EXPECT_EQ(three.status, signals::Status::ok);
  const signals::Column& angle = *three.table.column("/true/joint/hip/angle");
  EXPECT_GT(*std::ranges::max_element(angle) - *std::ranges::min_element(angle), 0.3);
  EXPECT_GT(air(three), 2 * air(two));
  EXPECT_TRUE(three.table.find("/valve/hip_flexor/exhaust/open")->time_ns.empty());
}

TEST(JointControllerRuns, RefusesValvesThatDoNotGoTogether) {
  experiment::Experiment e = one_step();
  e.robot.muscles[0].exhaust = "";
  EXPECT_NE(refusal(e).find("muscle.hip_flexor.exhaust: found none; expected a valve, as the inlet "
                            "seals"),
            std::string::npos);
  e = one_step();
  use_three_way(e, "hip");
  e.robot.muscles[0].exhaust = "exhaust";
  EXPECT_NE(refusal(e).find("none, as the inlet also vents"), std::string::npos);
  e = one_step();
  e.robot.muscles[1].inlet = three_way(e).name, e.robot.muscles[1].exhaust = "";
  EXPECT_NE(refusal(e).find("a valve of the same kind as muscle hip_flexor's"), std::string::npos);
}

// Both muscles of the hip have regulators: the angle follows, and the set points are logged.
experiment::Experiment regulated_hip(double angle_integral) {
  experiment::Experiment e = one_step();
  gas::Valve v = e.valves.front();
  v.name = "regulator", v.kind = gas::Valve::Kind::regulator;
  v.regulator = {.range = 6.5e5, .time_constant = 0.01};
  e.valves.push_back(v);
  for (robot::Muscle& m : e.robot.muscles)
    if (m.joint == "hip") m.inlet = v.name, m.exhaust = "";
  e.robot.joints[0].stiffness_source = robot::StiffnessSource::none;
  e.robot.joints[0].pressure_law = {.bias = 0.4, .angle_integral = angle_integral};
  e.robot.foot.present = e.robot.ground.present = false;
  return e;
}

// Mean of |desired - actual| of the hip over the second half of the swing  [rad].
double error_in_swing(const Outcome& out) {
  const signals::Column &is = *out.table.column("/joint/hip/angle"),
                        &want = *out.table.column("/desired/joint/hip/angle"),
                        &phase = *out.table.column("/plan/phase");
  std::vector<double> errors;
  for (std::size_t i = 0; i < is.size(); ++i)
    if (phase[i] == 0) errors.push_back(std::abs(want[i] - is[i]));
  double sum = 0;
  for (std::size_t i = errors.size() / 2; i < errors.size(); ++i) sum += errors[i];
  return sum / static_cast<double>(errors.size() - errors.size() / 2);
}

TEST(JointControllerRuns, RegulatorsFollowTheirSetPoints) {
  const experiment::Experiment e = regulated_hip(0.006);
  EXPECT_EQ(refusal(e), "nothing");
  EXPECT_EQ(control::joint_controller_config(installation(e)).joint[0].kind, Kind::regulated);
  EXPECT_NEAR(control::joint_controller_config(installation(e)).joint[0].regulator.angle_integral,
              0.006,
              1e-9);  // % in 10 ms
  const Outcome out = run(e), plain = run(regulated_hip(0));
  EXPECT_LT(error_in_swing(out), 0.5 * error_in_swing(plain));

  const signals::Series* set = out.table.find("/valve/hip_flexor/inlet/set_point");
  ASSERT_NE(set, nullptr);
  const signals::Column& share = set->columns[0];
  EXPECT_GT(share.size(), 300u);  // one per period
  EXPECT_GT(*std::ranges::max_element(share), 0.4);
  EXPECT_LE(*std::ranges::max_element(share), 1.0);
  EXPECT_EQ(share.back(), 0.0);  // shut down
  EXPECT_EQ(out.table.find("/muscle/hip_flexor/inlet_duty"), nullptr);
}

// The leg's cylinder in its loop: last joint, valves after the muscles', duties of B.1. With B.1's
// gain it oscillates; damped, and with a ninth of the gain, it reaches the planned position.
TEST(JointControllerRuns, TheCylinderGoesWhereThePlanWantsIt) {
  const std::string air = sinew::test::source_dir() + "/experiments/leg-in-air.toml";
  const experiment::Experiment e = experiment::load(
      air, {"sequence.repeat=1", "cylinder.mode=valves", "cylinder.position_gain=0.1 %/count",
            "cylinder.damping=3 lbf s/in", R"(phase.swing.cylinder={ position = ["0.7 in"] })"});
  const control::JointControllerConfig c = control::joint_controller_config(installation(e));
  ASSERT_EQ(c.joints, 3u);
  EXPECT_EQ(c.joint[2].kind, Kind::cylinder);
  EXPECT_EQ(c.joint[2].flexor.inlet.index, 8);
  EXPECT_EQ(c.joint[2].extensor.exhaust.index, 11);
  EXPECT_EQ(c.joint[2].feedforward, (control::Duties{55, 55, 45, 45}));
  EXPECT_EQ(c.joint[2].law_tick, 1);

  const Outcome out = run(e);
  const signals::Column &is = *out.table.column("/cylinder/position"),
                        &want = *out.table.column("/desired/cylinder/position"),
                        &phase = *out.table.column("/plan/phase");
  double last_error = 1, lowest = 1;
  for (std::size_t i = 0; i < is.size(); ++i) {
    if (phase[i] >= 0) last_error = want[i] - is[i];
    lowest = std::min(lowest, is[i]);
  }
  EXPECT_NEAR(want.back(), 0.7 * 0.0254, 1e-12);
  EXPECT_NEAR(last_error, 0, 0.003);  // a proportional law has a steady error
  EXPECT_GT(lowest, -0.002);          // the stop
  EXPECT_GT(out.table.find("/valve/cylinder_up/inlet/open")->time_ns.size(), 200u);
}

// --- muscles ------------------------------------------------------------------------------------

// Torque of a count with another scale and another arm, relative to that of the flexor.
TEST(JointControllerRuns, TensionRatioIsOfTorquePerCount) {
  experiment::Experiment e = one_step();
  EXPECT_EQ(control::joint_controller_config(installation(e)).joint[0].extensor.tension_ratio,
            1.0f);
  const int s = robot::tension_sensor_of(e.robot, 1);
  e.robot.sensors[static_cast<std::size_t>(s)].assumed_scale /= 2;
  EXPECT_NEAR(control::joint_controller_config(installation(e)).joint[0].extensor.tension_ratio, 2,
              1e-6);
  e.robot.muscles[1].cam.radius = 1.5 * e.robot.joints[0].moment_arm;
  const control::JointConfig hip = control::joint_controller_config(installation(e)).joint[0];
  EXPECT_NEAR(hip.extensor.tension_ratio, 3, 1e-6);
  EXPECT_NEAR(hip.extensor.free_length, hip.flexor.free_length / 1.5, 1);
}

TEST(JointControllerRuns, AJointWithOneMuscle) {
  for (const std::size_t gone : {0u, 1u}) {
    experiment::Experiment e = one_step();
    const std::string name = e.robot.muscles[gone].name;
    e.robot.muscles.erase(e.robot.muscles.begin() + static_cast<std::ptrdiff_t>(gone));
    std::erase_if(e.robot.sensors, [&](const robot::Sensor& s) { return s.of == name; });
    const control::JointConfig hip = control::joint_controller_config(installation(e)).joint[0];
    EXPECT_EQ(hip.flexor.present, gone == 1);
    EXPECT_EQ(hip.extensor.present, gone == 0);
    EXPECT_FALSE(robot::is_plain(e.robot));
    EXPECT_TRUE(robot::contradictions(e.robot).empty());
    const Outcome out = run(e);  // gravity replaces the missing muscle
    EXPECT_EQ(out.status, signals::Status::ok);
    for (const double angle : *out.table.column("/true/joint/hip/angle"))
      ASSERT_TRUE(std::isfinite(angle));
  }
}

// One muscle is the flexor of knee and hip, on a cam half as large.
TEST(JointControllerRuns, AMuscleOverTwoJoints) {
  experiment::Experiment e = one_step();
  e.robot.muscles[0].second = {.joint = "knee", .role = robot::Muscle::Role::flexor};
  e.robot.muscles[0].second.cam.radius = 0.5 * e.robot.joints[1].moment_arm;
  std::erase_if(e.robot.sensors, [](const robot::Sensor& s) { return s.of == "knee_flexor"; });
  e.robot.muscles.erase(e.robot.muscles.begin() + 2);
  const control::JointControllerConfig c = control::joint_controller_config(installation(e));
  const control::MuscleConfig &hip = c.joint[0].flexor, &knee = c.joint[1].flexor;
  EXPECT_EQ(hip.inlet.index, knee.inlet.index);
  EXPECT_EQ(hip.tension.index, knee.tension.index);
  EXPECT_NEAR(hip.share, 2.0 / 3, 1e-6);
  EXPECT_NEAR(knee.share, 1.0 / 3, 1e-6);
  // Flexion lowers the knee's angle: a rising angle lengthens the muscle, by half as much.
  EXPECT_NEAR(hip.other_travel, 0.5, 1e-6);
  EXPECT_NEAR(knee.other_travel, -2, 1e-6);

  EXPECT_TRUE(robot::contradictions(e.robot).empty());
  const Outcome out = run(e);
  EXPECT_EQ(out.status, signals::Status::ok);
  // With one pulse train, every edge changes the valve's state.
  const signals::Series *inlet = out.table.find("/valve/hip_flexor/inlet/open"),
                        *exhaust = out.table.find("/valve/hip_flexor/exhaust/open");
  EXPECT_GT(inlet->time_ns.size(), 50u);
  for (const signals::Series* s : {inlet, exhaust})
    for (std::size_t i = 1; i < s->columns[0].size(); ++i)
      ASSERT_NE(s->columns[0][i], s->columns[0][i - 1]);
}

// --- period and interrupts ----------------------------------------------------------------------

// 5.2: the interrupt comes a hundred times in a period. In ticks of 100 us, 90 and 151 Hz are 111
// and 66 ticks.
TEST(JointControllerRuns, InterruptsOverrunAbove100Hz) {
  for (const int ticks : {50, 66, 100, 111, 125, 200}) {
    experiment::Experiment e = one_step({"low_level.interrupt_time=100 us"});
    e.robot.low_level.pwm_ticks = ticks;
    EXPECT_EQ(control::laws_overrun(e.robot), ticks < 100) << ticks;
  }
}

TEST(JointControllerRuns, OverrunsAreCounted) {
  const Outcome out = run(one_step({"low_level.interrupt_time=101 us"}));
  EXPECT_GT(out.controller.overruns, 2 * 250u);  // two laws per period of 10 ms, more than 2.5 s
  const signals::Column* logged = out.table.column("/low_level/overruns");
  ASSERT_NE(logged, nullptr);
  EXPECT_EQ(logged->back(), out.controller.overruns);
  const Outcome in_time = run(one_step());
  EXPECT_EQ(in_time.controller.overruns, 0u);
  EXPECT_EQ(in_time.table.find("/low_level/overruns"), nullptr);
}

}  // namespace
}  // namespace sinew::run::joint_controller_run_test
