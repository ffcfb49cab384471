// Laws that a planar world keeps, with and without muscles.
#include "sinew/plant/planar/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sinew/plant/planar/test_setups.h"

namespace sinew::plant {
namespace {

TEST(World, EnergyIsKeptWithoutMusclesAndFriction) {
  World<2> world(leg_without_muscles(0.6, -0.9));
  const double before = energy(world.constants(), world.pose());
  world.advance(10.0);
  const double drift = energy(world.constants(), world.pose()) - before;
  // Relative to the energy that swings: the fall of both links from upright.
  const double scale = 9.80665 * (world.constants().first_moment[0] + world.constants().first_moment[1]);
  EXPECT_LE(std::abs(drift) / scale, 1e-7);
}

TEST(World, MomentumAlongTheTrackIsKept) {
  World<2> world(leg_without_muscles(0.6, -0.9));
  world.advance(5.0);
  EXPECT_NEAR(momentum(world.constants(), world.pose()), 0.0, 1e-9);
}

}  // namespace
}  // namespace sinew::plant
