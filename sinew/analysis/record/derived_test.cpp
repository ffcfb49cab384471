#include "sinew/analysis/record/derived.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sinew/actuator/stiffness.h"
#include "sinew/analysis/record/test_log.h"
#include "sinew/robot/kinematics.h"

namespace sinew::analysis::derived_test {
namespace {

using test::constant;
using test::walk;
using test::walking_leg;

constexpr double hip = 5.0, knee = 5.3;
constexpr robot::TwoLinks links{8.875 * 0.0254, 6.25 * 0.0254};

// Returns the torques that balance a force of the ground on the foot: T = -J^T F.
std::array<double, 2> holding(robot::Point force) {
  const robot::Jacobian j = robot::jacobian(links, hip, knee);
  return {-(j.x1 * force.x + j.y1 * force.y), -(j.x2 * force.x + j.y2 * force.y)};
}

// Returns the log of a leg at rest under `force`, with 200 N in the extensors.
test::Log standing(robot::Point force, int steps = 2) {
  const auto [t1, t2] = holding(force);
  test::Log log = walk(steps, 0, 0.5);
  log.scalar("/joint/hip/angle", constant(hip)).scalar("/joint/knee/angle", constant(knee));
  log.scalar("/muscle/hip_extensor/tension", constant(200));
  log.scalar("/muscle/hip_flexor/tension", constant(200 + t1 / 0.0254));
  log.scalar("/muscle/knee_extensor/tension", constant(200));
  log.scalar("/muscle/knee_flexor/tension", constant(200 - t2 / 0.0254));  // flexion lowers t2
  return log;
}

TEST(Derived, TorquesGiveTheForceThatTheyHold) {
  const signals::Table out = derive(standing({9, 25}).table, walking_leg());
  const auto& x = *out.column("/foot/force", "x");
  const auto& y = *out.column("/foot/force", "y");
  ASSERT_EQ(x.size(), 250u);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(x[i], 9, 1e-10);
    EXPECT_NEAR(y[i], 25, 1e-10);
  }
}

TEST(Derived, FootStandsWhereTheAnglesSay) {
  const signals::Table out = derive(standing({0, 0}).table, walking_leg());
  const robot::Point foot = robot::foot_position(links, hip, knee);
  EXPECT_DOUBLE_EQ(out.column("/foot/position", "x")->front(), foot.x);
  EXPECT_DOUBLE_EQ(out.column("/foot/position", "y")->front(), foot.y);
}

// The foot pushes the trolley for 0.6 s of stance in every second, and not in 0.4 s of swing.
TEST(Derived, TrolleyIsPushedInStanceOnly) {
  Machine m = walking_leg();
  m.robot.trolley.drag = 0;
  const double a = 9 / m.robot.trolley.total_mass;
  const signals::Table out = derive(standing({9, 25}).table, m);
  // The linear ramps at both ends of a stance add and subtract half a sample.
  EXPECT_NEAR(out.column("/trolley/by_plan/velocity")->back(), 1.2 * a, 1e-12);

  // The foot is loaded until the sequence ends.
  EXPECT_NEAR(out.column("/trolley/velocity")->back(), (2.0 - 0.005) * a, 1e-9);
}

TEST(Derived, TrolleyComesToRestUnderDrag) {
  Machine m = walking_leg();
  m.robot.trolley.drag = 8;
  const signals::Table out = derive(standing({9, 25}).table, m);
  EXPECT_EQ(out.column("/trolley/by_plan/velocity")->back(), 0);
  EXPECT_GT(out.column("/trolley/by_plan/position")->back(), 0);
}

TEST(Derived, LiftoffIsWhereTheNormalForceEnds) {
  Machine m = walking_leg();
  m.robot.trolley.drag = 0;
  const double a = 9 / m.robot.trolley.total_mass;
  test::Log log = standing({9, 25}, 1);
  // From 0.2 s of the swing on the tensions are equal, so that the force is 0.
  for (signals::Series& s : log.table.series)
    if (s.topic.name.ends_with("tension"))
      for (std::size_t i = 20; i < 40; ++i) s.columns[0].set(i, 200);
  EXPECT_NEAR(derive(log.table, m).column("/trolley/velocity")->back(), (0.8 - 0.005) * a, 1e-9);
}

TEST(Derived, ErrorGoesTheShorterWayRound) {
  test::Log log = walk(1);
  log.scalar("/joint/hip/angle", constant(0.01));
  log.scalar("/desired/joint/hip/angle", constant(2 * M_PI - 0.01));
  EXPECT_NEAR(derive(log.table, walking_leg()).column("/joint/hip/error")->front(), 0.02, 1e-14);
}

TEST(Derived, SingularPosesAndMissingReadingsGiveNoForce) {
  test::Log log = standing({9, 25});
  for (signals::Series& s : log.table.series) {
    if (s.topic.name == "/joint/knee/angle") s.columns[0].set(10, 0);  // straight
    if (s.topic.name == "/joint/hip/angle") s.columns[0].set(20, std::nan(""));
  }
  const signals::Table out = derive(log.table, walking_leg());
  const auto& y = *out.column("/foot/force", "y");
  EXPECT_TRUE(std::isnan(y[10]));
  EXPECT_TRUE(std::isnan(y[20]));
  EXPECT_NEAR(y[11], 25, 1e-10);
  EXPECT_TRUE(std::isfinite(out.column("/trolley/by_plan/position")->back()));
}

// Two actuators of known braid on one side, a slack tendon on the other.
TEST(Derived, TrueStiffnessIsThatOfTheLawTimesTheSquareOfTheArm) {
  Machine m = walking_leg();
  actuator::Actuator& a = m.actuators.front();
  a.braid = {.thread_length = 0.12, .turns = 1.5};
  a.long_end = {.length = 0.1, .stiffness = 0, .damping = 0};
  const double length = 0.085, gauge = 4e5;
  test::Log log = walk(1);
  for (const char* muscle : {"/true/muscle/hip_flexor", "/true/muscle/hip_extensor"}) {
    const std::string at = muscle;
    log.scalar(at + "/length", constant(length));
    log.scalar(at + "/pressure", constant(m.atmosphere + gauge));
    log.scalar(at + "/tension", constant(at.ends_with("flexor") ? 50 : 0));
  }
  const double k = actuator::stiffness_at_constant_pressure(a, length, gauge, m.atmosphere);
  EXPECT_NEAR(derive(log.table, m).column("/true/joint/hip/stiffness")->front(),
              0.0254 * 0.0254 * 2 * k, 1e-12 * k);
}

TEST(Derived, ATopicWithOtherTimesIsHeld) {
  test::Log log = walk(1);
  signals::Series s{{"/muscle/hip_flexor/inlet_duty", "", {{"value", "1"}}},
                    {250'000'000, 500'000'000},
                    {{0.2, 0.4}}};
  log.table.series.push_back(s);
  log.scalar("/muscle/hip_flexor/exhaust_duty", constant(0.1));
  const signals::Table out = derive(log.table, walking_leg());
  const auto& passive = *out.column("/muscle/hip_flexor/passive");
  EXPECT_TRUE(std::isnan(passive[24]));
  EXPECT_NEAR(passive[25], 0.7, 1e-15);
  EXPECT_NEAR(passive[49], 0.7, 1e-15);
  EXPECT_NEAR(passive[50], 0.5, 1e-15);
}

TEST(Derived, AHardwareLogLacksOnlyTheTruth) {
  const signals::Table out = derive(standing({9, 25}).table, walking_leg());
  std::set<std::string> names;
  for (const signals::Series& s : out.series) {
    names.insert(s.topic.name);
    EXPECT_FALSE(s.topic.name.starts_with("/true")) << s.topic.name;
    for (const auto& column : s.columns) EXPECT_EQ(column.size(), s.time_ns.size());
  }
  for (const char* name :
       {"/foot/position", "/foot/force", "/joint/hip/torque", "/joint/knee/torque",
        "/trolley/by_plan/position", "/trolley/by_plan/velocity"})
    EXPECT_TRUE(names.count(name)) << name;
}

TEST(Derived, NothingComesOfNothing) {
  EXPECT_TRUE(derive({}, walking_leg()).series.empty());
  EXPECT_TRUE(derive({}, Machine{}).series.empty());
}

}  // namespace
}  // namespace sinew::analysis::derived_test
