// The law of the body step: it suits a machine's fastest rate in every pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "sinew/plant/machine/machine.h"
#include "sinew/plant/planar/friction_contacts_members.h"
#include "sinew/plant/planar/test_setups.h"

namespace sinew::plant {
namespace {

// A leg on a light shoe whose heel and toe reach from a hair to a hand's breadth past the ankle.
Setup leg_on_a_shoe(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Setup s = leg_without_muscles(4.95, 5.40);
  s.robot.ground.present = true;
  robot::Link shoe{"shoe", 0.03, 0.02 + 0.1 * share(random), 0.01, 0};
  shoe.inertia = shoe.mass * 1e-4 * (1 + 3 * share(random));
  s.robot.links.push_back(shoe);
  robot::Joint ankle;
  ankle.name = "ankle";
  ankle.kind = robot::Joint::Kind::passive;
  s.robot.joints.push_back(ankle);
  s.start.joint_angle.push_back(6.2 * share(random));
  s.start.blocked.push_back(false);
  s.robot.foot.mass = 0;
  s.robot.foot.points = {{"heel", -0.05 * share(random), -0.01, 0.005},
                         {"toe", 0.05 * share(random), -0.01, 0.005}};
  return s;
}

TEST(Steps, SuitEveryPose) {
  constexpr double stable = 2.785;  // RK4, of a decay
  std::mt19937 random(8);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  int divided = 0;
  for (int machine = 0; machine < 40; ++machine) {
    const plant::Setup s = leg_on_a_shoe(random);
    const BodyMechanism<3, 4, 8> mechanism(s);
    const FrictionContacts<3, 4> contacts(mechanism.constants(), s.robot);
    const double step = mechanism.node_step(s);
    double fastest = 0;
    BodyState<3> m = mechanism.start();
    for (int pose = 0; pose < 2000; ++pose) {
      const Body<3> body(mechanism.constants(), m);
      fastest = std::max(fastest, contacts.stiffest_rate(body, m, s.robot));
      for (std::size_t j = 0; j < 3; ++j) m.at[first_link + j] = turn(random);
    }
    EXPECT_LT(step * fastest, stable) << machine;
    divided += step < s.steps.body;
  }
  EXPECT_GT(divided, 10);
}

// A node is left out only where no disc comes to the ground before the next: all coordinates go on
// with their rates.
TEST(Steps, AreLongWhereNoDiscCanTouch) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), rates(-12, 12);
  std::uniform_real_distribution<double> sinking(-1, 1);
  int in_air = 0, near = 0, on_ground = 0;
  for (int machine = 0; machine < 20; ++machine) {
    plant::Setup s = leg_on_a_shoe(random);
    const BodyMechanism<3, 4, 8> mechanism(s);
    const FrictionContacts<3, 4> contacts(mechanism.constants(), s.robot);
    const double step = mechanism.node_step(s);
    for (int pose = 0; pose < 500; ++pose) {
      BodyState<3> m = mechanism.start();
      for (std::size_t j = 0; j < 3; ++j) {
        m.at[first_link + j] = turn(random);
        m.rate[first_link + j] = rates(random);
      }
      m.rate[up] = sinking(random);
      const std::int64_t next = mechanism.next_multiple(2, step, mechanism.pose(0, m), m);
      ASSERT_GE(next, 3);
      double deepest = -1;
      for (int i = 0; i < contacts.discs(); ++i)
        deepest = std::max(deepest, contacts.depth(Body<3>(mechanism.constants(), m), m, i));
      on_ground += deepest >= 0;
      EXPECT_TRUE(deepest < 0 || next == 3);
      if (next == 3) continue;
      EXPECT_LE(static_cast<double>(next - 2) * step, s.steps.body * (1 + 1e-9));
      ++in_air;
      near += deepest > -0.01;
      for (int part = 1; part <= 10; ++part) {
        BodyState<3> later = m;
        for (std::size_t c = 0; c < 5; ++c)
          later.at[c] += 0.1 * part * static_cast<double>(next - 2) * step * m.rate[c];
        const Body<3> body(mechanism.constants(), later);
        for (int i = 0; i < contacts.discs(); ++i)
          EXPECT_LT(contacts.depth(body, later, i), 0) << machine;
      }
    }
  }
  EXPECT_GT(in_air, 500);
  EXPECT_GT(near, 5);
  EXPECT_GT(on_ground, 300);
}

}  // namespace
}  // namespace sinew::plant
