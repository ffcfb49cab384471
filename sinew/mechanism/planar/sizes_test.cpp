// Mechanisms of any shape are compiled for several sizes: the size affects speed alone, and the
// largest has room for 24 links.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "sinew/mechanism/planar/test_setups.h"
#include "sinew/world/machine.h"

namespace sinew::plant::sizes_test {
namespace {

// The leg on its ground with friction, and passive links behind its tibia.
Setup leg_with_tail(int more) {
  plant::Setup s = leg_with_muscles(4.95, 5.40);
  s.robot.ground.present = true;
  s.robot.trolley.drag = 2;
  for (robot::Joint& j : s.robot.joints) j.dry_friction = 0.1, j.damping = 0.05;
  for (int k = 0; k < more; ++k) {
    robot::Link link = s.robot.links[1];
    link.name = "tail" + std::to_string(k);
    link.length *= 0.1, link.center_of_mass *= 0.1, link.mass *= 0.3, link.inertia *= 0.1;
    s.robot.links.push_back(link);
    robot::Joint joint;
    joint.name = link.name;
    joint.kind = robot::Joint::Kind::passive;
    joint.rest_angle = joint.spring_angle = 0.5;
    joint.spring = 0.5;
    joint.damping = 0.01;
    joint.dry_friction = 0.01;
    s.robot.joints.push_back(joint);
    s.start.joint_angle.push_back(0.5);
    s.start.blocked.push_back(false);
  }
  return s;
}

template <class... Worlds>
void expect_same_bits(const Setup& s) {
  std::tuple<Worlds...> worlds{Worlds(s)...};
  std::mt19937 random(4);
  double force = 0;
  for (signals::Tick t = 100; t <= 8000; t += 100) {
    const signals::Edge edge{t, {static_cast<std::uint8_t>(random() % 8)}, random() % 3 == 0};
    std::vector<Truth> seen;
    std::apply(
        [&](auto&... world) {
          ((world.drive(edge), seen.push_back(world.truth(static_cast<double>(t) * 1e-4))), ...);
        },
        worlds);
    for (std::size_t w = 1; w < seen.size(); ++w)
      ASSERT_EQ(std::memcmp(&seen[0], &seen[w], sizeof(Truth)), 0) << "world " << w << " at " << t;
    force = std::max(force, seen[0].foot[0].force_y);
  }
  EXPECT_GT(force, 1);  // its foot has carried load
}

TEST(Sizes, HaveTheSameBits) {
  expect_same_bits<BodyWorld, SizedBodyWorld<2, 4, 8>, LargeBodyWorld>(leg_with_tail(0));
  expect_same_bits<BodyWorld, LargeBodyWorld>(leg_with_tail(1));
  expect_same_bits<BodyWorld, SizedBodyWorld<4, 4, 8>, LargeBodyWorld>(leg_with_tail(2));
  expect_same_bits<BodyWorld, LargeBodyWorld>(leg_with_tail(4));
}

// Energy, and momentum along the track, of trees up to the largest. The ends of a long chain move
// fast: the step is short.
TEST(Sizes, LargeTreesKeepEnergyAndMomentum) {
  std::mt19937 random(7);
  for (const std::size_t links : {9u, 16u, 24u}) {
    plant::Setup s = random_tree(random, links);
    s.robot.trolley.total_mass += robot::leg_mass(s.robot);
    s.steps.body = 1e-4;
    LargeBodyWorld world(s);
    const auto& k = world.constants();
    double scale = 0;
    for (std::size_t i = 0; i < k.links(); ++i) scale += k.gravity * std::abs(k.first_moment[i]);
    const double before = energy(k, world.motion());
    world.advance(0.5);
    EXPECT_LE(std::abs(energy(k, world.motion()) - before) / scale, 1e-5) << links;
    EXPECT_LE(std::abs(momentum(k, world.motion())[0]) / k.sliding_mass, 1e-6) << links;
  }
}

}  // namespace
}  // namespace sinew::plant::sizes_test
