// Tests that both sides of each comparison compute the same laws, and that records are compared by
// more than their spread.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/appendix_a.h"
#include "bench/peers/drill.h"
#include "bench/peers/experiments.h"
#include "bench/peers/mujoco_leg.h"
#include "bench/peers/record.h"
#include "bench/peers/stand_peers.h"
#include "sinew/run/setup/planar_setup.h"
#include "sinew/world/machine.h"

namespace sinew::bench {
namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] / b[i] - 1.0));
  return most;
}

TEST(Drill, AllWaysFillTheMusclesAlike) {
  const Drill d = drill(1);
  Pressures by(drill_machines * drill_muscles * drill_samples), other = by;
  by_network(d, &by);
  by_pow(d, &other);
  EXPECT_LT(largest_difference(other, by), 1e-6);
  for (const Wide& wide : widths()) {
    wide.run(d, &other);
    EXPECT_LT(largest_difference(other, by), 1e-9) << wide.width;
    wide.run(drill(1, 10), &other);
    EXPECT_LT(largest_difference(other, by), 1e-6) << wide.width << " by nodes";
  }
}

// Airborne, without friction, both by RK4 on the same nodes.
TEST(MujocoLeg, FallsAsOursDoes) {
  if (!has_mujoco()) GTEST_SKIP() << "MuJoCo is not installed";
  plant::Setup s = run::planar_setup(walk());
  s.muscles.clear();
  s.robot.muscles.clear();
  s.robot.sensors.clear();
  s.robot.ground.height = -10;
  s.robot.trolley.drag = s.robot.trolley.breakaway = 0;
  s.robot.trolley.track_length = 9;
  for (robot::Joint& j : s.robot.joints) j.dry_friction = 0;
  plant::ChainWorld<2> ours(s);
  MujocoLeg theirs(s, {}, Integrator::rk4);
  for (int ms = 0; ms < 1000; ++ms) theirs.step_body();
  const plant::Truth t = ours.truth(1.0);
  EXPECT_NEAR(theirs.motion().hip, t.angle[0], 1e-9);
  EXPECT_NEAR(theirs.motion().knee, t.angle[1], 1e-9);
  EXPECT_NEAR(theirs.motion().x, t.x, 1e-9);
}

// Appendix A with small steps agrees with the adaptive integrators.
TEST(Stand, AdaptiveIntegratorsAgreeWithTheThesis) {
  Lengths exact(appendix_a_milliseconds);
  appendix_a(1000, exact.data());
  const auto worst = [&](void (*run)(double, int, Lengths&)) {
    Lengths l(appendix_a_milliseconds);
    run(1e-10, 1, l);
    return largest_difference(l, exact);
  };
  if (cvode_version() != "none") {
    EXPECT_LT(worst(by_cvode), 2e-6);
  }
  if (odeint_version() != "none") {
    EXPECT_LT(worst(by_odeint), 2e-6);
  }
}

TEST(Spread, KnowsItsQuantiles) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const Spread s = spread(values);
  EXPECT_DOUBLE_EQ(s.low, 5);
  EXPECT_DOUBLE_EQ(s.quarter, 25);
  EXPECT_DOUBLE_EQ(s.median, 50);
  EXPECT_DOUBLE_EQ(s.high, 95);
}

Row row(const std::string& name, double median, double width) {
  Row r{.name = name, .goal = 2.0, .unit = "times as fast"};
  for (int i = -10; i <= 10; ++i) r.figures.push_back(median + width * i / 9.0);
  return r;
}

TEST(Compare, TellsWhatHasChangedByMoreThanBothSpreads) {
  const auto before = record({row("a", 10, 1), row("b", 10, 1), row("c", 10, 1), row("c/d", 1, 0),
                              row("other/part", 1, 0)},
                             "");
  const auto after = record({row("a", 7, 1), row("b", 9, 1), row("c", 13, 1)}, "");
  const std::vector<Change> found = compare(before, after);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_EQ(found[0].kind, Change::Kind::slower);
  EXPECT_EQ(found[1].name, "c");
  EXPECT_EQ(found[1].kind, Change::Kind::faster);
  EXPECT_EQ(found[2].kind, Change::Kind::gone);
  EXPECT_TRUE(compare(before, before).empty());
}

// More rounds of the same rows are one row of all rounds.
TEST(Row, PassesAddUp) {
  std::vector<Row> rows = {row("a", 10, 1)};
  add(rows, {row("a", 20, 1)});
  EXPECT_EQ(rows[0].figures.size(), 42u);
  EXPECT_NEAR(rows[0].figure().median, 15, 4);
  EXPECT_TRUE(rows[0].met());
}

TEST(Compare, RefusesWhatIsNoRecord) {
  EXPECT_THROW(compare(nlohmann::ordered_json::object(), record({}, "")), std::runtime_error);
}

}  // namespace
}  // namespace sinew::bench
