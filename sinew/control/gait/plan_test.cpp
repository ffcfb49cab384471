#include "sinew/control/gait/plan.h"

#include <gtest/gtest.h>

#include <functional>

#include "sinew/control/gait/plan.fields.h"
#include "sinew/control/gait/test_walk.h"

namespace sinew::gait::plan_test {
namespace {

using test::inch;

using Keys = std::vector<std::string>;

Keys keys_after(const std::function<void(Plan&)>& damage) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  damage(plan);
  Keys keys;
  for (const auto& c : contradictions(robot, plan)) keys.push_back(c.key);
  return keys;
}

// Table 6-2: 1.5 s, 30 ms, 1.5 s; the code's loops run once more and its plant takes 10 ms.
TEST(Timing, PeriodsOfTheTextAndOfTheCode) {
  Plan plan = test::walk(robot::test::leg());
  EXPECT_EQ(periods(plan, plan.phases[0]), 150);
  EXPECT_EQ(periods(plan, plan.phases[1]), 3);
  EXPECT_EQ(periods_per_step(plan), 303);
  EXPECT_EQ(periods(plan), 4 * 303);

  plan.thesis_timing = true;
  EXPECT_EQ(periods(plan, plan.phases[0]), 151);
  EXPECT_EQ(periods(plan, plan.phases[1]), 2);
  EXPECT_EQ(periods_per_step(plan), 151 + 2 + 151);
  plan.settle = 0.6;
  EXPECT_EQ(periods(plan), 60 + 4 * 304);
}

TEST(Measures, AreFoundByName) {
  const robot::Robot robot = robot::test::leg();
  using Kind = Measure::Kind;
  EXPECT_EQ(find_measure(robot, "").kind, Kind::none);
  EXPECT_EQ(find_measure(robot, "foot.normal_force").kind, Kind::normal_force);
  EXPECT_EQ(find_measure(robot, "joint.knee.angle").index, 1);
  EXPECT_EQ(find_measure(robot, "joint.hip.stiffness").kind, Kind::stiffness);
  EXPECT_EQ(find_measure(robot, "muscle.knee_extensor.tension").index, 3);
  for (const char* nowhere : {"foot", "joint.ankle.angle", "joint..angle", "muscle.tension", "x"})
    EXPECT_EQ(find_measure(robot, nowhere).kind, Kind::unknown) << nowhere;

  EXPECT_EQ(unit_of("foot.normal_force"), "N");
  EXPECT_EQ(unit_of("joint.hip.angle"), "rad");
  EXPECT_EQ(unit_of("joint.hip.stiffness"), "N m/rad");
}

TEST(Contradictions, NoneInTheWalk) {
  EXPECT_EQ(keys_after([](Plan&) {}), Keys{});
}

TEST(Contradictions, NamesThatLeadNowhere) {
  EXPECT_EQ(keys_after([](Plan& p) { p.sequence[1] = "hop"; }), (Keys{"sequence.phases"}));
  EXPECT_EQ(keys_after([](Plan& p) { p.sequence.clear(); }), (Keys{"sequence.phases"}));
  EXPECT_EQ(keys_after([](Plan& p) { p.phases[0].disabled = {"ankle"}; }),
            (Keys{"phase.swing.disabled"}));
  EXPECT_EQ(keys_after([](Plan& p) { p.phases[0].until.measure = "joint.ankle.angle"; }),
            (Keys{"phase.swing.until.measure"}));
}

TEST(Contradictions, HalfAPathOrTwo) {
  EXPECT_EQ(keys_after([](Plan& p) { p.phases[0].y = {}; }), (Keys{"phase.swing"}));
  EXPECT_EQ(keys_after([](Plan& p) {
              p.phases[0].points = {{0, 1}, {0, 1}};
            }),
            (Keys{"phase.swing"}));
  EXPECT_EQ(keys_after([](Plan& p) { p.phases[0].x.polynomial = {1}; }), (Keys{"phase.swing.x"}));
  EXPECT_EQ(keys_after([](Plan& p) {
              p.phases[0].x = p.phases[0].y = {};
              p.phases[0].points = {{0, 1}, {0}};
            }),
            (Keys{"phase.swing.points"}));
  EXPECT_EQ(keys_after([](Plan& p) { p.phases[2].duration = 0; }),
            (Keys{"phase.propulsion.duration"}));
}

TEST(Contradictions, DutiesAndAnglesOfOneJoint) {
  EXPECT_EQ(keys_after([](Plan& p) {
              p.phases[0].joints[1].angle = {1};
              p.phases[0].joints[1].feedforward.flexor_inlet = {1};
            }),
            (Keys{"phase.swing.feedforward.knee"}));
}

TEST(Unreachable, TheWalkIsInReach) {
  const robot::Robot robot = robot::test::leg();
  EXPECT_TRUE(unreachable(robot, test::walk(robot)).empty());
}

TEST(Unreachable, EveryRangeIsReportedWithItsWorstPoint) {
  const robot::Robot robot = robot::test::leg();
  Plan plan = test::walk(robot);
  // 15.125 in is the reach: the propulsion is outside at both ends and inside between them.
  plan.phases[2].x.from = 8 * inch;
  plan.phases[2].x.to = -8 * inch;
  const auto told = unreachable(robot, plan);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].key, "phase.propulsion");
  EXPECT_NE(told[0].found.find("s = 0.000 to"), std::string::npos) << told[0].found;
  EXPECT_NE(told[1].found.find("to 1.000"), std::string::npos) << told[1].found;
  EXPECT_NE(told[0].expected.find("384.2 mm"), std::string::npos) << told[0].expected;
}

// Visitor that counts keys and finds missing documentation.
struct Census {
  int count = 0;

  void note(const units::Field& field) {
    ++count;
    EXPECT_FALSE(field.name.empty());
    EXPECT_LT(field.min, field.max) << field.name;
  }
  void number(const units::Field& f, double&) { quantity(f); }
  void numbers(const units::Field& f, std::vector<double>&) { quantity(f); }
  void polynomial(const units::Field& f, std::vector<double>&, std::string_view) { quantity(f); }
  void quantity(const units::Field& f) {
    note(f);
    EXPECT_FALSE(f.unit.empty()) << f.name;
    EXPECT_FALSE(f.doc.empty()) << f.name;
  }
  void integer(const units::Field& f, int&) { note(f); }
  void flag(const units::Field& f, bool&) { note(f); }
  void text(const units::Field& f, std::string&) { note(f); }
  void texts(const units::Field& f, std::vector<std::string>&) { note(f); }
  template <class Enum>
  void choice(const units::Field& f, Enum&,
              std::initializer_list<units::Choice<std::type_identity_t<Enum>>>) {
    note(f);
  }
  void group(const units::Field& f, const auto& visit) {
    note(f);
    visit(*this);
  }
  template <class T>
  void each(const units::Field& f, std::vector<T>& items, const auto& visit) {
    note(f);
    for (T& item : items) visit(*this, item);
  }
  template <class T>
  void list(const units::Field& f, std::vector<T>& items, const auto& visit) {
    each(f, items, visit);
  }
};

TEST(PlanFields, EveryKeyHasANameAndEveryQuantityAUnit) {
  Plan plan = test::walk(robot::test::leg());
  plan.changes = {{.time = 1, .key = "control.gains.hip.angle", .value = 1}};
  Census census;
  fields(census, plan);
  EXPECT_GT(census.count, 100);
}

}  // namespace
}  // namespace sinew::gait::plan_test
