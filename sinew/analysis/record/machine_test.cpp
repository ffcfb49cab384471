#include "sinew/analysis/record/machine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/actuator/life.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/kinematics.h"
#include "tests/places.h"

namespace sinew::analysis::machine_test {
namespace {

const std::string experiments = sinew::test::source_dir() + "/experiments/";

Machine read(const std::string& name, const std::vector<std::string>& sets = {}) {
  return read_machine(config::compose(experiments + name, sets));
}

TEST(Machine, ReadsTheWalkOfTheThesis) {
  const Machine m = read("walk-test-1.toml");
  EXPECT_EQ(m.phases, (std::vector<std::string>{"swing", "foot_plant", "propulsion"}));
  EXPECT_EQ(m.sequence, m.phases);
  EXPECT_EQ(m.title, "Walking, test 1");
  EXPECT_FALSE(m.reported.empty());
  EXPECT_TRUE(has_leg(m));
  EXPECT_NEAR(robot::two_links(m.robot).l1, 8.875 * 0.0254, 1e-15);
  EXPECT_DOUBLE_EQ(m.period, 0.01);
  EXPECT_TRUE(is_swing(m, 0) && is_stance(m, 1) && is_stance(m, 2));
  EXPECT_FALSE(is_swing(m, -1) || is_stance(m, -1) || is_stance(m, 3));
  EXPECT_EQ(find_phase(m, "propulsion"), 2);
  EXPECT_EQ(find_phase(m, "kick"), -1);
}

TEST(Machine, ActuatorsCarryTheirMusclesBladder) {
  const Machine m = read("walk-test-1.toml");
  const robot::Muscle& muscle = m.robot.muscles.front();
  const actuator::Actuator a = robot::actuator_of(muscle, m.actuators);
  EXPECT_GT(a.braid.thread_length, 0);
  EXPECT_EQ(a.bladder.stiffness, muscle.bladder_stiffness);

  const Machine loose = read("walk-test-1.toml", {"actuator.bpa.bladder.fit=oversized"});
  EXPECT_EQ(robot::actuator_of(loose.robot.muscles.front(), loose.actuators).bladder.stiffness, 0);
}

// The leg's bounds follow from the three failures of 6.4, rounded outwards.
TEST(Machine, TheLegsLifeIsThatOfThreeBursts) {
  const Machine m = read("walk-test-1.toml");
  double actuators = 0;
  for (const robot::Muscle& muscle : m.robot.muscles) actuators += muscle.count;
  const actuator::Bounds counted = actuator::life_from_failures(3, 200 * actuators);
  const actuator::Life& life = m.actuators.front().life;
  EXPECT_EQ(life.cycles_over, std::floor(counted.least));
  EXPECT_EQ(life.cycles_under, std::ceil(counted.most));
}

TEST(Machine, ValvesHaveTheDelaysOfTheirProfile) {
  const auto delays = [](const std::string& profile) {
    return valve_of(read("walk-test-1.toml",
                         {"valve.inlet.opening_delay=2 ms", "valve.inlet.closing_delay=1 ms",
                          "valve.inlet.profile=" + profile}),
                    "inlet");
  };
  EXPECT_DOUBLE_EQ(delays("dead time").opening, 2e-3);
  EXPECT_DOUBLE_EQ(delays("dead time").closing, 1e-3);
  EXPECT_DOUBLE_EQ(delays("ideal").opening, 0);
  EXPECT_DOUBLE_EQ(valve_of(Machine{}, "inlet").opening, 0);
}

TEST(Machine, ARobotWithoutAFootHasNoLeg) { EXPECT_FALSE(has_leg(read("one-joint.toml"))); }

TEST(Machine, ABadBandIsFoundWithItsPlace) {
  config::Node root = config::compose(experiments + "walk-test-1.toml");
  config::Node& first = root.find("reported")->children.at(0);
  first.find("value")->text = "53 to 60 lb";
  try {
    read_machine(root);
    FAIL() << "no error";
  } catch (const config::Error& e) {
    ASSERT_EQ(e.problems().size(), 1u);
    EXPECT_EQ(e.problems()[0].key, "reported[0].wording");
    EXPECT_GT(e.problems()[0].where.line, 0);
    EXPECT_NE(std::string(e.what()).find("found \"53 to 60 lb\""), std::string::npos);
  }
}

}  // namespace
}  // namespace sinew::analysis::machine_test
