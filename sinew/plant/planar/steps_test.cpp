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

}  // namespace
}  // namespace sinew::plant
