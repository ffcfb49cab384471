#include "bench/peers/mujoco_leg.h"

#include <gtest/gtest.h>

#include "bench/peers/experiments.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/world/machine.h"

namespace sinew::bench {
namespace {

// Airborne, without friction, both by RK4 on the same nodes.
TEST(MujocoLeg, FallsAsOursDoes) {
  plant::Setup s = run::planar_setup(walk());
  s.muscles.clear();
  s.robot.muscles.clear();
  s.robot.sensors.clear();
  s.robot.ground.height = -10;
  s.robot.trolley.drag = s.robot.trolley.breakaway = 0;
  s.robot.trolley.track_length = 9;
  for (robot::Joint& j : s.robot.joints) j.dry_friction = 0;
  plant::ChainWorld<2> ours(s);
  MujocoLeg theirs(s, {}, Integrator::rk4);
  for (int ms = 0; ms < 1000; ++ms) theirs.step_body();
  const plant::Truth t = ours.truth(1.0);
  EXPECT_NEAR(theirs.motion().hip, t.angle[0], 1e-9);
  EXPECT_NEAR(theirs.motion().knee, t.angle[1], 1e-9);
  EXPECT_NEAR(theirs.motion().x, t.x, 1e-9);
}

}  // namespace
}  // namespace sinew::bench
