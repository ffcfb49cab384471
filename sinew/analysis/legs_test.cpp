// Figures of each leg of a machine with several legs, from its own topics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/legs.h"
#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/warnings.h"
#include "sinew/robot/legs.h"

namespace sinew::analysis::legs_test {
namespace {

using test::constant;
using test::duties;
using test::walk;
using test::walking_leg;

// Returns the log of a walk with all channels that figures need; `shape` makes logs differ.
test::Log full_walk(double shape) {
  const Machine m = walking_leg();
  test::Log log = walk(3, 0.5, 0.5);
  const auto curve = [=](double t) { return 0.2 + 0.05 * shape * std::sin(3 * t + shape); };
  double rest = 4.8;
  for (const robot::Joint& j : m.robot.joints) {
    for (const char* what : {"/joint/", "/desired/joint/", "/true/joint/"})
      log.scalar(what + j.name + "/angle", [=](double t) { return rest + curve(t); });
    log.scalar("/true/joint/" + j.name + "/velocity", curve);
    rest += 0.5;
  }
  for (const robot::Muscle& muscle : m.robot.muscles) {
    duties(log, muscle.name, 0.1 * shape, 0.1);
    const double strength = muscle.role == robot::Muscle::Role::flexor ? 90 : 150;
    log.scalar("/muscle/" + muscle.name + "/tension",
               [=](double t) { return strength * curve(t); });
    log.scalar("/true/muscle/" + muscle.name + "/air_in",
               [=](double t) { return 1e-4 * shape * t; });
    log.pulses("/valve/" + muscle.name + "/inlet/open", 1e-3 * shape, 2);
    log.pulses("/valve/" + muscle.name + "/exhaust/open", 1e-3, 2);
  }
  log.vector("/true/foot/force", curve,
             [=](double t) { return std::sin(6 * t) > 0.3 * shape ? 40.0 : 0.0; });
  log.scalar("/plan/unreachable", constant(0));
  log.scalar("/true/trolley/position", [](double t) { return 0.1 * t; });
  log.scalar("/true/trolley/velocity", constant(0.1));
  return log;
}

Machine walking_on_two() {
  Machine m = walking_leg();
  m.robot = robot::test::two_legs();
  m.robot.sensors.clear();
  m.robot.trolley.track_length = 10;
  return m;
}

bool of_the_body(const std::string& topic) { return topic.find("/trolley/") != topic.npos; }

signals::Table on_two(const signals::Table& left, const signals::Table& right) {
  signals::Table out = left;
  for (signals::Series& s : out.series)
    if (!of_the_body(s.topic.name)) s.topic.name = robot::topic_of_leg("left", s.topic.name);
  for (signals::Series s : right.series) {
    if (of_the_body(s.topic.name)) continue;
    s.topic.name = robot::topic_of_leg("right", s.topic.name);
    out.series.push_back(std::move(s));
  }
  return out;
}

double value(const Summary& s, const std::string& key) {
  const double* v = s.find(key);
  return v ? *v : std::nan("");
}

// Every figure of a leg equals that of a machine with one leg and the same log.
TEST(Legs, FiguresOfEachAreThoseOfOneAlone) {
  const signals::Table left = full_walk(1).table, right = full_walk(2).table;
  const Summary two = summarize(on_two(left, right), walking_on_two());
  Machine alone = walking_leg();
  alone.robot.sensors.clear();
  alone.robot.trolley.track_length = 10;
  for (const auto& [name, table] : {std::pair{"left", &left}, {"right", &right}}) {
    const Summary one = summarize(*table, alone);
    int compared = 0;
    for (const Entry& e : one.entries()) {
      const std::string head = e.key.substr(0, e.key.find('.'));
      const bool of_leg = head == "joints" || head == "muscles" || head == "foot" ||
                          head == "ground_reaction" || head == "phases" || head == "passiveness" ||
                          head == "air_used_kg";
      if (!of_leg) continue;
      ++compared;
      EXPECT_EQ(value(two, "legs." + std::string(name) + "." + e.key), e.value) << e.key;
    }
    EXPECT_GT(compared, 60);
  }
  EXPECT_EQ(two.find("joints.hip.excursion_rad"), nullptr);
  EXPECT_NEAR(value(two, "air_used_kg"),
              value(two, "legs.left.air_used_kg") + value(two, "legs.right.air_used_kg"), 1e-15);
  EXPECT_EQ(value(two, "passiveness"),
            std::min(value(two, "legs.left.passiveness"), value(two, "legs.right.passiveness")));
  EXPECT_EQ(value(two, "steps"), 3);
  EXPECT_GT(value(two, "valves.switchings"), 0);
}

TEST(Legs, LoadIsTheShareOfTimeOnTheGround) {
  test::Log log = full_walk(1);
  std::erase_if(log.table.series, [](const auto& s) { return s.topic.name == "/true/foot/force"; });
  log.vector("/true/foot/force", constant(0),
             [](double t) { return t < 1.25 - 1e-9 ? 20.0 : 0.0; });
  const Summary s = summarize(on_two(log.table, full_walk(2).table), walking_on_two());
  EXPECT_NEAR(value(s, "legs.left.foot.loaded_share_true"), 0.75 / 3, 1e-9);
  EXPECT_NEAR(value(s, "legs.left.foot.mean_load_true_N"), 20 * 0.75 / 3, 1e-9);
}

// The trolley is pushed by the sum of the legs' forces: two equal legs double the push.
TEST(Legs, ForcesOnTheTrolleyAddUp) {
  const signals::Table one = full_walk(1).table;
  Machine two = walking_on_two(), alone = walking_leg();
  two.robot.trolley.drag = alone.robot.trolley.drag = 0;
  two.robot.trolley.total_mass = 2 * alone.robot.trolley.total_mass;
  const signals::Table a = derive(one, alone), b = derive(on_two(one, one), two);
  const signals::Column *x = a.column("/trolley/position"), *y = b.column("/trolley/position");
  ASSERT_TRUE(x && y);
  for (std::size_t i = 0; i < x->size(); ++i) EXPECT_NEAR((*x)[i], (*y)[i], 1e-12);
  EXPECT_GT(std::abs(x->back()), 1e-3);
  EXPECT_TRUE(b.find("/true/leg/right/foot/slip"));
  EXPECT_TRUE(b.find("/leg/left/joint/knee/torque"));
  EXPECT_TRUE(b.find("/leg/left/muscle/hip_flexor/passive"));
}

TEST(Legs, WarningsNameTheLeg) {
  test::Log log = full_walk(1);
  std::erase_if(log.table.series,
                [](const auto& s) { return s.topic.name == "/plan/unreachable"; });
  log.scalar("/plan/unreachable", [](double t) { return t > 1 && t < 1.1 ? 1.0 : 0.0; });
  const auto all = texts(warnings(on_two(full_walk(2).table, log.table), walking_on_two()));
  const auto with = [&](const std::string& text) {
    return std::ranges::count_if(all, [&](const auto& t) { return t.find(text) != t.npos; });
  };
  EXPECT_EQ(with("right: the foot is out of reach in"), 1);
  EXPECT_EQ(with("left: the foot"), 0);
}

}  // namespace
}  // namespace sinew::analysis::legs_test
