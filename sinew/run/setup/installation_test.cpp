// An experiment's keys for the low level reach the controllers' constants.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/installation.h"
#include "tests/places.h"

namespace sinew::run::installation_test {
namespace {

const std::string walk = sinew::test::source_dir() + "/experiments/walk-test-1.toml";

control::JointConfig hip_of(const std::vector<std::string>& sets) {
  return control::joint_controller_config(installation(buildable(walk, sets))).joint[0];
}

std::string refusal(const std::vector<std::string>& sets) {
  try {
    control::joint_controller_config(installation(buildable(walk, sets)));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

// Returns the key of the hip's velocity estimator from "<estimator>", ...
std::string velocity(const std::string& keys) {
  return "joint.hip.velocity={ estimator = " + keys + " }";
}

TEST(VelocityKeys, BecomeTheLowLevelsConstants) {
  EXPECT_EQ(hip_of({}).velocity.estimator, control::Estimator::difference);
  const control::VelocityConfig line =
      hip_of({velocity(R"("weighted average", samples = 6)")}).velocity;
  EXPECT_EQ(line.samples, 6);
  EXPECT_EQ(line.weight, control::line_weights(6, 100));

  const control::VelocityConfig bounded =
      hip_of({velocity(R"("bounded observer", acceleration = "100 rad/s2",)"
                       R"( speed_limit = "5 rad/s")")})
          .velocity;
  EXPECT_NEAR(bounded.margin, 767, 1e-3);
  EXPECT_NEAR(bounded.limit, 5 * 767, 1e-3);
  EXPECT_EQ(bounded.speed_gain, 0);
  EXPECT_EQ(bounded.decay, 1);

  const control::VelocityConfig kalman =
      hip_of({velocity(R"("kalman", acceleration = "100 rad/s2", inertia = "0.02 kg m2",)"
                       R"( tensions = true)")})
          .velocity;
  // 1 in of arm, 0.17 V/lbf, 819.2 counts/V
  const double torque = 0.0254 * 4.4482216152605 / (0.17 * 819.2);
  EXPECT_NEAR(kalman.speed_gain, 0.01 * torque * 767 / 0.02, 1e-5);
  EXPECT_GT(kalman.speed_share, 0);
}

TEST(VelocityKeys, RefuseWhatCannotBe) {
  EXPECT_NE(refusal({velocity(R"("kalman")")}).find("acceleration"), std::string::npos);
  EXPECT_NE(refusal({velocity(R"("kalman", acceleration = "9 rad/s2", tensions = true)")})
                .find("inertia: found none"),
            std::string::npos);
  EXPECT_NE(refusal({velocity(R"("sensor")")}).find("0 sensors of its velocity; expected one"),
            std::string::npos);
  EXPECT_NE(refusal({velocity(R"("weighted average", samples = 3,)"
                              R"( weights = ["50 1/s", "0 1/s", "-40 1/s"])")})
                .find("a joint at rest has no speed"),
            std::string::npos);
}

TEST(StiffnessSourceKey, ReportsWhichSensorsTheLawWaitsFor) {
  EXPECT_EQ(hip_of({}).law_tick, 9);
  EXPECT_EQ(hip_of({"joint.hip.stiffness_source=flexor force"}).law_tick, 7);
  EXPECT_EQ(hip_of({"joint.hip.stiffness_source=none"}).law_tick, 3);
  EXPECT_NE(refusal({"joint.hip.stiffness_source=pressures"})
                .find("muscle.hip_flexor: found 0 sensors of its pressure"),
            std::string::npos);
}

TEST(LowLevelKeys, ReachTheLowLevel) {
  const control::JointControllerConfig c = control::joint_controller_config(
      installation(buildable(walk, {"low_level.dead_band=3 %", "low_level.hold_limit=7",
                                    "low_level.interrupt_time=101 us"})));
  EXPECT_EQ(c.dead_band, 3);
  EXPECT_EQ(c.hold_limit, 7u);
  EXPECT_TRUE(c.laws_overrun);
  EXPECT_FALSE(control::joint_controller_config(
                   installation(buildable(walk, {"low_level.interrupt_time=100 us"})))
                   .laws_overrun);
  EXPECT_NE(refusal({"low_level.dead_band=2.5 %"}).find("whole percents"), std::string::npos);
}

}  // namespace
}  // namespace sinew::run::installation_test
