// Tests one muscle at a joint, one over two joints, and invalid configurations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>

#include "sinew/control/joint/laws.h"
#include "sinew/control/joint/test_bench.h"

namespace sinew::control::muscles_test {
namespace {

using signals::Edge;

// --- one muscle at a joint, and one over two joints ---------------------------------------------

TEST(SingleMuscle, LeavesTheOtherSideAlone) {
  Bench bench(leg_with([](JointControllerConfig& c) {
    c.joints = 1;
    c.joint[hip].extensor = {.present = false};
  }));
  bench.command.joint[hip].stiffness = 30;
  bench.reading[1] = 1895 - 400;
  bench.reading[3] = 700;
  bench.run(10);
  const JointState& seen = bench.controller.state().joint[hip];
  EXPECT_EQ(seen.duties.extensor_inlet, 0);
  EXPECT_EQ(seen.duties.extensor_exhaust, 0);
  EXPECT_GT(seen.duties.flexor_inlet, 0);
  // [27] of one muscle
  const int length = 2416 + 400;
  EXPECT_NEAR(seen.stiffness, 33.0 * 700 / (3 * length - 10465225 / length), 1e-3);
  for (const Edge& e : bench.edges) EXPECT_LT(e.valve.index, 2);
}

// Hip flexor and knee flexor are the same muscle.
JointControllerConfig biarticular(float hip_share, float travel = 0) {
  return leg_with([&](JointControllerConfig& c) {
    c.joints = 2;
    MuscleConfig &at_hip = c.joint[hip].flexor, &at_knee = c.joint[knee].flexor;
    at_knee.inlet = at_hip.inlet, at_knee.exhaust = at_hip.exhaust,
    at_knee.tension = at_hip.tension;
    at_hip.share = hip_share, at_knee.share = 1 - hip_share;
    at_hip.other_travel = travel;
    for (JointConfig& j : c.joint) j.stiffness_source = StiffnessSource::none;
  });
}

TEST(SharedMuscle, DutyIsTheWeightedSum) {
  for (const float share : {0.0f, 0.25f, 0.5f, 1.0f}) {
    Bench bench(biarticular(share));
    bench.reading[1] = 1895 - 1000;  // hip: 35 %
    bench.reading[2] = 1175 - 505;   // knee: -60 %
    bench.run(20);
    const int expected = static_cast<int>(share * 35 - (1 - share) * 60);
    for (const std::size_t j : {hip, knee}) {
      const Duties& d = bench.controller.state().joint[j].duties;
      EXPECT_EQ(d.flexor_inlet - d.flexor_exhaust, expected) << share;
    }
    EXPECT_NEAR(bench.open_share(0, 10), std::max(0.0, 0.01 * expected), 1e-9);
    EXPECT_NEAR(bench.open_share(1, 10), std::max(0.0, -0.01 * expected), 1e-9);
  }
}

TEST(SharedMuscle, BothAskingTheSameIsDone) {
  for (int duty = -100; duty <= 100; duty += 7)
    for (const float share : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f})
      EXPECT_EQ(shared_duty(share, duty, 1 - share, duty, Truncation::each_law), duty);
}

// Each valve has one pulse train: no edge twice, no edge without a change, never both open.
TEST(SharedMuscle, IsDrivenOnce) {
  Bench bench(biarticular(0.4f));
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    for (std::uint16_t& r : bench.reading) r = static_cast<std::uint16_t>(random() % 4096);
    bench.command.joint[random() % 2].enabled ^= random() % 8 == 0;
    bench.run(1);
  }
  bench.controller.shut_down(bench.now - 1);
  bench.run(150);
  std::array<bool, 12> open{};
  for (const Edge& e : bench.edges) {
    ASSERT_NE(open[e.valve.index], e.open);
    open[e.valve.index] = e.open;
    ASSERT_FALSE(open[e.valve.index & ~1] && open[e.valve.index | 1]);
  }
  EXPECT_EQ(open, (std::array<bool, 12>{}));
}

TEST(SharedMuscle, ItsLengthFollowsBothJoints) {
  JointControllerConfig config = biarticular(0.5f, -0.5f);
  config.joint[hip].stiffness_source = StiffnessSource::force;
  Bench bench(config);
  bench.reading[1] = 1895;
  bench.reading[2] = 1175 + 200;  // shortens it by 100 counts at the hip
  bench.reading[3] = bench.reading[4] = 900;
  bench.run(3);
  JointConfig alone = config.joint[hip];
  const float expected =
      joint_stiffness(alone, Truncation::each_law, Pair{2416 - 100, 2416}, Pair{900, 900}).value;
  EXPECT_EQ(bench.controller.state().joint[hip].stiffness, expected);
}

// --- invalid configurations ---------------------------------------------------------------------

TEST(JointControllerConfig, ProblemsOfTheKinds) {
  const auto of = [](const std::function<void(JointControllerConfig&)>& change) {
    const JointControllerConfig config = leg_with(change);
    const char* p = problem(config);
    return std::string(p ? p : "");
  };
  EXPECT_NE(of([](JointControllerConfig& c) {
              c.joint[hip].velocity.estimator = Estimator::sensor,
              c.joint[hip].velocity.channel = {20};
            }).find("not converted"),
            std::string::npos);
  EXPECT_NE(of([](JointControllerConfig& c) {
              c.joint[hip].velocity = {.estimator = Estimator::weighted_average, .samples = 17};
            }).find("2 to 16 samples"),
            std::string::npos);
  EXPECT_NE(of([](JointControllerConfig& c) {
              c.joint[hip].stiffness_source = StiffnessSource::extensor_force;
              c.joint[hip].extensor.present = false;
            }).find("not there"),
            std::string::npos);
  EXPECT_NE(of([](JointControllerConfig& c) { c.dead_band = 101; }).find("dead_band"),
            std::string::npos);
  EXPECT_NE(
      of([](JointControllerConfig& c) { c.joint[hip].kind = JointKind::passive; }).find("passive"),
      std::string::npos);
  // An equal inlet alone does not make a shared muscle; nor can both sides of a joint share one.
  EXPECT_NE(of([](JointControllerConfig& c) {
              c.joint[knee].flexor.inlet = c.joint[hip].flexor.inlet;
            }).find("same valve"),
            std::string::npos);
  EXPECT_NE(of([](JointControllerConfig& c) {
              c.joint[hip].extensor.inlet = c.joint[hip].flexor.inlet;
              c.joint[hip].extensor.exhaust = c.joint[hip].flexor.exhaust;
            }).find("same valve"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::control::muscles_test
