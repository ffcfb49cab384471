// Two legs on one trolley, each the thesis's, each with a gait controller of its own.
#include <gtest/gtest.h>

#include "runs.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/run/setup/installation.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::two_legs_test {
namespace {

using test::figure, test::seed, test::summary_of;
using units::inch;

experiment::Experiment load(const std::string& name) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml");
}

// At least four fifths of one leg's speed, each foot loaded for more than a third of the time, and
// not more than twice one leg's air per metre.
TEST(TwoLegs, WalkInAntiphase) {
  for (int n = 1; n <= 3; ++n) {
    const analysis::Summary two = summary_of("walk-two-legs", {seed(n)});
    const analysis::Summary one = summary_of("walk-test-1", {seed(n)});
    const char *speed = "trolley.mean_speed_m_per_s", *air = "air_used_kg_per_m";
    EXPECT_GE(figure(two, speed), 0.8 * figure(one, speed));
    EXPECT_LE(figure(two, air), 2 * figure(one, air));
    EXPECT_GE(figure(two, "legs.left.foot.loaded_share_true"), 0.35);
    EXPECT_GE(figure(two, "legs.right.foot.loaded_share_true"), 0.35);
    EXPECT_NEAR(figure(two, "legs.left.air_used_kg") + figure(two, "legs.right.air_used_kg"),
                figure(two, "air_used_kg"), 1e-12);
  }
}

// A leg that stands instead of walking does not carry the other one along.
TEST(TwoLegs, BothMakeTheSpeed) {
  const analysis::Summary both = summary_of("walk-two-legs");
  const analysis::Summary lame = summary_of(
      "walk-two-legs", {"plan={ stand = { phases = [\"propulsion\"] } }", "leg.right.plan=stand"});
  EXPECT_LT(figure(lame, "trolley.distance_m"), 0.5 * figure(both, "trolley.distance_m"));
}

// The legs' laws are those of the leg: the low level's data of each joint differ from the leg's in
// channels, valves and times alone.
TEST(TwoLegs, LawsAreThoseOfTheLeg) {
  const control::JointControllerConfig two = control::joint_controller_config(
                                           run::installation(load("walk-two-legs"))),
                                       one = control::joint_controller_config(
                                           run::installation(load("walk-test-1")));
  ASSERT_EQ(two.joints, 2 * one.joints);
  for (std::size_t j = 0; j < two.joints; ++j) {
    const control::JointConfig &its = two.joint[j], &leg = one.joint[j % one.joints];
    EXPECT_EQ(its.kind, leg.kind);
    EXPECT_EQ(its.angle_at_rest, leg.angle_at_rest);
    EXPECT_EQ(its.flexion, leg.flexion);
    EXPECT_EQ(its.lengths_swapped, leg.lengths_swapped);
    EXPECT_EQ(its.stiffness_source, leg.stiffness_source);
    EXPECT_EQ(its.stiffness_factor, leg.stiffness_factor);
    EXPECT_EQ(its.pole_clamp, leg.pole_clamp);
    for (const auto side : {&control::JointConfig::flexor, &control::JointConfig::extensor}) {
      EXPECT_EQ((its.*side).free_length, (leg.*side).free_length);
      EXPECT_EQ((its.*side).thread_length_squared, (leg.*side).thread_length_squared);
      EXPECT_EQ((its.*side).tension_ratio, (leg.*side).tension_ratio);
    }
  }
  EXPECT_EQ(two.period, one.period);
  EXPECT_EQ(two.truncation, one.truncation);
}

// Legs of three joints: each with the ankle and the shoe of robots/leg-with-ankle, six joints and
// four discs in all.
TEST(TwoLegs, WalkOnAnkles) {
  std::vector<std::string> sets{
      "foot.mass=0 lb",
      "foot.point={ heel = { along = \"-0.8 in\", across = \"-0.495 in\", radius = \"0.25 in\" }, "
      "toe = { along = \"0.8 in\", across = \"-0.495 in\", radius = \"0.25 in\" } }"};
  for (const std::string leg : {"left", "right"}) {
    sets.push_back("link." + leg + "_foot={ parent = \"" + leg +
                   "_tibia\", length = \"1 in\", mass = \"0.1 lb\", center_of_mass = \"0.3 in\", "
                   "inertia = \"0.05 lb in2\" }");
    sets.push_back("joint." + leg +
                   "_ankle={ kind = \"passive\", rest_angle = \"90 deg\", dry_friction = \"0.1 lbf "
                   "in\", damping = \"0.1 lbf in s/rad\", spring = \"5 lbf in/rad\", spring_angle "
                   "= \"90 deg\" }");
    sets.push_back("leg." + leg + ".joints=[\"" + leg + "_hip\", \"" + leg + "_knee\", \"" + leg +
                   "_ankle\"]");
    sets.push_back("start.joint_angles." + leg + "_ankle=125 deg");
  }
  const analysis::Summary s = summary_of("walk-two-legs", sets);
  EXPECT_GT(figure(s, "trolley.mean_speed_m_per_s") / inch, 3.7);
  for (const char* leg : {"legs.left.foot.", "legs.right.foot."}) {
    EXPECT_GE(figure(s, (leg + std::string("loaded_share_true")).c_str()), 0.35);
    EXPECT_GT(figure(s, (leg + std::string("heel.peak_load_true_N")).c_str()), 10);
    EXPECT_GT(figure(s, (leg + std::string("toe.peak_load_true_N")).c_str()), 10);
  }
}

// The legs' air, compared: the same legs half a step apart use the same.
TEST(TwoLegs, ShareTheWork) {
  const analysis::Summary s =
      summary_of("walk-two-legs", {"sequence.repeat=6", "trolley.track_length=20 ft"});
  const double left = figure(s, "legs.left.air_used_kg"),
               right = figure(s, "legs.right.air_used_kg");
  EXPECT_NEAR(left / right, 1, 0.1);
  EXPECT_NEAR(figure(s, "legs.left.foot.loaded_share_true") /
                  figure(s, "legs.right.foot.loaded_share_true"),
              1, 0.15);
}

}  // namespace
}  // namespace sinew::two_legs_test
