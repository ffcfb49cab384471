#include "sinew/report/page/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/braid.h"
#include "sinew/report/page/test_run.h"
#include "sinew/robot/legs.h"

namespace sinew::report::scene_test {
namespace {

using robot::Point;

struct Drawn {
  analysis::Machine machine;
  signals::Table table, drawn;
  analysis::Record record;
  Channels channels;
  Scene scene;

  Drawn(analysis::Machine m, signals::Table t)
      : machine(std::move(m)), table(std::move(t)), record(table, machine) {
    channels.add(table);
    scene = report::scene(channels, machine, record, drawn);
    channels.add(drawn);
  }
  double at(const Channel& c, std::size_t row) const {
    const Samples samples = channels.find(c);
    return samples ? (*samples.values)[row] : std::nan("");
  }
};

Drawn walking(const analysis::Machine& m = test::machine()) { return {m, test::walking(m)}; }

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

TEST(Scene, PutsTheFootWhereKinematicsDoes) {
  const Drawn d = walking();
  const robot::TwoLinks links = robot::two_links(d.machine.robot);
  for (std::size_t row = 0; row < d.record.rows(); row += 7) {
    const double hip = (*d.table.column("/true/joint/hip/angle"))[row];
    const double knee = (*d.table.column("/true/joint/knee/angle"))[row];
    const double trolley = (*d.table.column("/true/trolley/position"))[row];
    const Point foot = robot::foot_position(links, hip, knee);
    const Frame& tibia = d.scene.frames.back();
    const double heading = d.at(tibia.heading, row), l = d.scene.links.back().length;
    EXPECT_NEAR(d.at(tibia.x, row) + l * std::cos(heading), trolley + foot.x, 1e-12);
    EXPECT_NEAR(d.at(tibia.y, row) + l * std::sin(heading), foot.y, 1e-12);
  }
}

// The moment arm of the tendon in the drawing is that of the muscle.
TEST(Scene, CordsPullWithTheMusclesMomentArm) {
  const Drawn d = walking();
  const robot::Robot& robot = d.machine.robot;
  ASSERT_EQ(d.scene.muscles.size(), robot.muscles.size());
  for (std::size_t i = 0; i < robot.muscles.size(); ++i) {
    const MuscleShape& m = d.scene.muscles[i];
    const auto j = static_cast<std::size_t>(robot::find_joint(robot, robot.muscles[i].joint));
    const Point joint = j == 0 ? Point{} : Point{robot.links[j - 1].length, 0};
    const Point lever = {m.touch.x - joint.x, m.touch.y - joint.y};
    const Point back = {-m.direction.x, -m.direction.y};
    const robot::Joint& at = robot.joints[j];
    EXPECT_NEAR(cross(lever, back), robot::moment_arm_at(robot.muscles[i], at, at.rest_angle),
                1e-12);
    EXPECT_NEAR(std::hypot(back.x, back.y), 1, 1e-12);
  }
}

TEST(Scene, LeavesRoomForTheLongestMuscle) {
  for (const double mount : {0.05, 0.08, 0.3}) {
    analysis::Machine m = test::machine();
    for (robot::Muscle& muscle : m.robot.muscles) muscle.mount_length = mount;
    const Drawn d = walking(m);
    for (const MuscleShape& s : d.scene.muscles) {
      const double room = std::hypot(s.touch.x - s.anchor.x, s.touch.y - s.anchor.y);
      EXPECT_GT(room, s.longest);
      EXPECT_GE(s.longest, mount);
    }
  }
}

TEST(Scene, SwellsMusclesAsTheBraidDoes) {
  const Drawn d = walking();
  const MuscleShape& m = d.scene.muscles[0];
  for (std::size_t row = 0; row < d.record.rows(); row += 11)
    EXPECT_EQ(d.at(m.diameter, row),
              actuator::diameter(d.machine.actuators[0].braid, d.at(m.length, row)));
}

// A muscle over two joints is drawn between them, from cam to cam, on the side on which it pulls.
TEST(Scene, LaysAMuscleOfTwoJointsBetweenThem) {
  analysis::Machine m = test::machine();
  robot::Muscle& both = m.robot.muscles[0];
  both.second = {.joint = "knee", .role = robot::Muscle::Role::extensor, .cam = {}};
  both.second.cam.radius = 0.01;
  const Drawn d = walking(m);
  const MuscleShape& s = d.scene.muscles[0];
  EXPECT_EQ(s.frame, 1);
  const robot::Joint& knee = m.robot.joints[1];
  const double lever = robot::moment_arm_at(both, knee, knee.rest_angle);
  EXPECT_NEAR(s.touch.x, m.robot.links[0].length, 1e-12);
  EXPECT_NEAR(s.touch.y, lever, 1e-12) << "above the link raises the angle";
  EXPECT_EQ(d.scene.tendons.size(), 2u);
}

TEST(Scene, NeedsOneAngleAtLeast) {
  const analysis::Machine m = test::machine();
  analysis::test::Log log = analysis::test::walk(1);
  EXPECT_TRUE(Drawn(m, log.table).scene.empty());

  log.scalar("/joint/knee/angle", analysis::test::constant(5));
  const Drawn d(m, log.table);
  EXPECT_FALSE(d.scene.empty());
  EXPECT_EQ(d.scene.drawn_from, "measured angles");
  EXPECT_EQ(d.at(d.scene.frames[1].heading, 0), m.robot.joints[0].rest_angle);
  EXPECT_TRUE(d.scene.muscles[0].pressure.is_empty());
  EXPECT_TRUE(Drawn(m, {}).scene.empty());
}

TEST(Scene, PutsTheForceBetweenDiscsByTheirLoads) {
  analysis::Machine m = test::machine();
  m.robot.foot.points = {{.name = "heel", .along = 0.1, .across = -0.04, .radius = 0.01},
                         {.name = "toe", .along = 0.1, .across = 0.04, .radius = 0.01}};
  signals::Table table = test::walking(m);
  const signals::Series pattern = *table.find("/true/trolley/position");
  const auto load = [&](const std::string& disc, double newtons) {
    signals::Series s = pattern;
    s.topic.name = "/true/foot/" + disc + "/load";
    s.columns[0].assign(s.columns[0].size(), newtons);
    table.series.push_back(std::move(s));
  };
  load("heel", 30);
  load("toe", 10);
  const Drawn d(m, table);
  const Frame& tibia = d.scene.frames.back();
  for (std::size_t row = 0; row < d.record.rows(); row += 13) {
    const double h = d.at(tibia.heading, row);
    const auto x = [&](double across) {
      return d.at(tibia.x, row) + 0.1 * std::cos(h) - across * std::sin(h);
    };
    EXPECT_NEAR(d.at(d.scene.feet.at(0).contact, row), 0.75 * x(-0.04) + 0.25 * x(0.04), 1e-12);
  }
}

// Two legs on one body, the second one 0.2 m ahead: each is drawn like a single leg.
TEST(Scene, DrawsEveryLeg) {
  analysis::Machine m = test::machine();
  m.robot = robot::test::two_legs();
  m.robot.links[2].at = 0.2;
  signals::Table table;
  for (const std::string leg : {"left", "right"})
    for (signals::Series& s : test::walking(test::machine()).series) {
      const bool of_body = s.topic.name.find("/trolley/") != s.topic.name.npos;
      if (of_body && leg == "right") continue;
      if (!of_body) s.topic.name = robot::topic_of_leg(leg, s.topic.name);
      if (leg == "right" && s.topic.name.ends_with("hip/angle"))
        for (std::size_t i = 0; i < s.columns[0].size(); ++i)
          s.columns[0].set(i, s.columns[0][i] + 0.3);
      table.series.push_back(std::move(s));
    }
  const Drawn d(m, table);
  ASSERT_EQ(d.scene.feet.size(), 2u);
  ASSERT_EQ(d.scene.frames.size(), 5u);
  EXPECT_EQ(d.scene.muscles.size(), 8u);
  EXPECT_EQ(d.scene.discs.size(), 2u);
  EXPECT_EQ(d.scene.feet[0].at, 0);
  EXPECT_EQ(d.scene.feet[1].at, 0.2);
  EXPECT_EQ(d.scene.feet[1].force.topic, "/true/leg/right/foot/force");
  EXPECT_EQ(d.scene.muscles[4].pressure.topic, "/true/leg/right/muscle/hip_flexor/pressure");
  const robot::TwoLinks links = robot::two_links(robot::only_leg(m.robot, 1));
  for (std::size_t row = 0; row < d.record.rows(); row += 11) {
    const double hip = (*d.table.column("/true/leg/right/joint/hip/angle"))[row];
    const double knee = (*d.table.column("/true/leg/right/joint/knee/angle"))[row];
    const double trolley = (*d.table.column("/true/trolley/position"))[row];
    const Point foot = robot::foot_position(links, hip, knee);
    const Frame& tibia = d.scene.frames[4];
    const double heading = d.at(tibia.heading, row);
    EXPECT_NEAR(d.at(tibia.x, row) + links.l2 * std::cos(heading), trolley + 0.2 + foot.x, 1e-12);
    EXPECT_NEAR(d.at(tibia.y, row) + links.l2 * std::sin(heading), foot.y, 1e-12);
    EXPECT_NEAR(d.at(d.scene.feet[1].contact, row), trolley + 0.2 + foot.x, 1e-12);
  }
}

TEST(Pose, LengthOverARoundCamIsTheLaw) {
  const robot::Robot robot = test::machine().robot;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(4, 6);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> angles = {angle(random), angle(random)};
    for (const robot::Muscle& m : robot.muscles) {
      const auto j = static_cast<std::size_t>(robot::find_joint(robot, m.joint));
      EXPECT_NEAR(robot::muscle_length(robot, m, angles),
                  robot::muscle_length(robot.joints[j], m.role, m.mount_length, angles[j]), 1e-12);
    }
  }
}

// dL/dtheta = -pull for a cam of any shape.
TEST(Pose, LengthOverACamOfAnyShapeChangesByItsRadius) {
  robot::Robot robot = test::machine().robot;
  robot.muscles[0].cam = {.radius = robot::not_set, .angle = {4, 5, 6}, .radii = {.02, .03, .015}};
  robot.muscles[0].second = {.joint = "knee", .role = robot::Muscle::Role::flexor, .cam = {}};
  const double h = 1e-3;
  for (const double hip : {4.3, 4.7, 5.4})
    for (std::size_t j = 0; j < 2; ++j) {
      std::vector<double> less = {hip, 5.2}, more = less;
      less[j] -= h, more[j] += h;
      const double slope = (robot::muscle_length(robot, robot.muscles[0], more) -
                            robot::muscle_length(robot, robot.muscles[0], less)) /
                           (2 * h);
      const double pull =
          robot::moment_arm_at(robot.muscles[0], robot.joints[j], j == 0 ? hip : 5.2);
      EXPECT_NEAR(slope, -pull, 0.02 * std::abs(pull)) << hip;  // a corner is between the points
    }
}

}  // namespace
}  // namespace sinew::report::scene_test
