// Tests joints of other kinds than the leg's: sources of stiffness, 3-way valves, regulators, dead
// band.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "sinew/control/joint/laws.h"
#include "sinew/control/joint/test_bench.h"

namespace sinew::control::kinds_test {
namespace {

using signals::Edge;
using signals::Tick;

// --- source of the stiffness --------------------------------------------------------------------

// [26] with F = P f (3 L^2 - b^2) is [27]: both sources agree on consistent data.
TEST(StiffnessSource, PressureAndForceAgree) {
  JointConfig joint = test_leg().joint[hip];
  constexpr double factor = 5.5 * 6;  // lbf in/rad per (count/count), of both
  const double b2 = joint.flexor.thread_length_squared;
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto length = static_cast<std::int32_t>(2200 + random() % 700);
    const auto pressure = static_cast<std::int32_t>(500 + random() % 2500);
    joint.flexor.pressure_factor = joint.extensor.pressure_factor = 1e-6f;
    joint.flexor.effectiveness = {0.95f, 1e-5f, -3e-9f};
    // The tension of that pressure, in counts.
    const double p = pressure, eff = 0.95 + p * (1e-5 - 3e-9 * p);
    const double tension = 1e-6 * p * eff / factor * (3.0 * length * length - b2);
    const double expected = 6 * 5.5 * tension * length / (3.0 * length * length - b2);
    const double ours = static_cast<double>(pressure_stiffness(joint.flexor, length, pressure));
    ASSERT_NEAR(ours, expected, 1e-5 * expected);
  }
}

TEST(StiffnessSource, EffectivenessIsHeldOutsideItsRange) {
  MuscleConfig m;
  m.pressure_factor = 1e-6f;
  m.effectiveness = {1, 1e-3f, 0};
  m.valid_from = 200, m.valid_to = 1000;
  const auto share = [&](int p) {
    return static_cast<double>(pressure_stiffness(m, 2400, p)) / (1e-6 * 2400 * p);
  };
  EXPECT_NEAR(share(100), 1.2, 1e-5);
  EXPECT_NEAR(share(500), 1.5, 1e-5);
  EXPECT_NEAR(share(3000), 2.0, 1e-5);
  EXPECT_EQ(pressure_stiffness(m, 2400, -5), 0);
}

// One transducer is as good as two if both muscles pull equally, and has an error by the load.
TEST(StiffnessSource, OneForceIsExactWithoutLoad) {
  JointConfig joint = test_leg().joint[hip];
  const auto k = [&](StiffnessSource source, int flexor, int extensor) {
    joint.stiffness_source = source;
    return joint_stiffness(joint, Truncation::none, 1950, flexor, extensor).value;
  };
  using enum StiffnessSource;
  EXPECT_EQ(k(flexor_force, 1200, 1200), k(force, 1200, 1200));
  EXPECT_EQ(k(extensor_force, 1200, 1200), k(force, 1200, 1200));
  EXPECT_EQ(k(flexor_force, 1200, 0), k(force, 1200, 1200));
  EXPECT_GT(k(flexor_force, 1200, 900), k(force, 1200, 900));
  EXPECT_LT(k(extensor_force, 1200, 900), k(force, 1200, 900));
}

TEST(StiffnessSource, TransducersOfDifferentScales) {
  JointConfig joint = test_leg().joint[hip];
  const auto k = [&](float ratio, int extensor) {
    joint.extensor.tension_ratio = ratio;
    return joint_stiffness(joint, Truncation::none, 1950, 1200, extensor).value;
  };
  EXPECT_EQ(k(0.5f, 1600), k(1, 800));
}

// Without scanned tension sensors the laws run with the angle only.
TEST(StiffnessSource, NoneNeedsNoTension) {
  JointControllerConfig config = leg_with([](JointControllerConfig& c) {
    c.conversions = 3;
    c.joints = 2;
    for (std::size_t j = 0; j < 2; ++j) {
      c.joint[j].stiffness_source = StiffnessSource::none;
      c.joint[j].law_tick = static_cast<std::uint16_t>(3 + 2 * j);
    }
  });
  Bench bench(config);
  for (JointCommand& c : bench.command.joint) c.stiffness = 40;
  bench.reading[1] = 1895 - 400;
  bench.run(20);
  const JointState& seen = bench.controller.state().joint[hip];
  EXPECT_EQ(seen.stiffness_output, 0);
  EXPECT_EQ(seen.duties, (Duties{14, 0, 0, 14}));  // 0.035 x 400, cut
  EXPECT_NEAR(bench.open_share(0, 10), 0.14, 1e-9);
  config.joint[hip].stiffness_source = StiffnessSource::force;
  EXPECT_NE(problem(config), nullptr);
}

// --- velocity -----------------------------------------------------------------------------------

TEST(Velocity, IsSeenAndCountsInTheLaw) {
  for (const bool sensor : {false, true}) {
    Bench bench(leg_with([&](JointControllerConfig& c) {
      c.joint[hip].gains = {.velocity = 0.02f};
      c.joint[hip].stiffness_source = StiffnessSource::none;
      c.joint[hip].velocity = {
          .estimator = Estimator::weighted_average, .samples = 4, .weight = line_weights(4, 100)};
      if (sensor)
        c.joint[hip].velocity = {
            .estimator = Estimator::sensor, .channel = {6}, .at_rest = 2000, .scale = 2};
    }));
    bench.reading[6] = 2150;
    bench.command.joint[hip].gains.velocity = 0.02f;
    for (int i = 0; i < 20; ++i)
      bench.reading[1] = static_cast<std::uint16_t>(1895 + 3 * i), bench.run(1);
    EXPECT_NEAR(bench.controller.state().joint[hip].velocity, 300, 1e-3);
    const Duties& d = bench.controller.state().joint[hip].duties;
    EXPECT_NEAR(d.flexor_exhaust, 6, 1);
    EXPECT_NEAR(d.extensor_inlet, 6, 1);
  }
}

// --- dead band, overruns, inverted exhaust ------------------------------------------------------

TEST(DeadBand, ShutsWhatIsBelowIt) {
  for (int duty = -30; duty <= 30; ++duty) {
    const Duties d = to_duties({duty, -duty}, 10);
    EXPECT_EQ(d.flexor_inlet, duty >= 10 ? duty : 0);
    EXPECT_EQ(d.flexor_exhaust, -duty >= 10 ? -duty : 0);
    EXPECT_EQ(to_duties({duty, 0}, 0), to_duties({duty, 0}, 1));  // as in B.1
  }
  Bench bench(leg_with([](JointControllerConfig& c) {
    c.dead_band = 15;
    c.joint[hip].stiffness_source = StiffnessSource::none;
  }));
  bench.reading[1] = 1895 - 400;  // 14 %
  bench.run(20);
  EXPECT_EQ(bench.controller.state().joint[hip].duties, Duties{});
}

TEST(Overruns, AreTheLawsThatTakeTooLong) {
  Bench bench(leg_with([](JointControllerConfig& c) { c.laws_overrun = true; }));
  bench.run(10);
  EXPECT_EQ(bench.controller.state().overruns, 30u);  // three joints
  Bench quick(test_leg());
  quick.run(10);
  EXPECT_EQ(quick.controller.state().overruns, 0u);
}

// The edges are the same, except for the levels of the exhausts.
TEST(Exhaust, InvertedIsTheSameWithTheOtherLevel) {
  const auto edges = [](bool inverted) {
    Bench bench(leg_with([&](JointControllerConfig& c) {
      c.startup_vent = 200;
      for (JointConfig& joint : c.joint)
        joint.flexor.exhaust_inverted = joint.extensor.exhaust_inverted = inverted;
    }));
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
      for (std::uint16_t& r : bench.reading) r = static_cast<std::uint16_t>(random() % 4096);
      bench.run(1);
    }
    return bench.edges;
  };
  const std::vector<Edge> plain = edges(false), inverted = edges(true);
  ASSERT_EQ(plain.size(), inverted.size());
  ASSERT_GT(plain.size(), 400u);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    ASSERT_EQ(plain[i].at, inverted[i].at);
    ASSERT_EQ(plain[i].open, inverted[i].open != (plain[i].valve.index % 2 == 1));
  }
  JointControllerConfig config = test_leg();
  config.joint[hip].flexor.exhaust_inverted = true;
  EXPECT_NE(problem(config), nullptr);  // it would not be shut at the start
}

// --- 3-way valves -------------------------------------------------------------------------------

JointControllerConfig three_way_leg() {
  return leg_with([](JointControllerConfig& c) {
    c.joints = 1;
    c.joint[hip].kind = JointKind::three_way;
    c.joint[hip].bias = 40;
    c.joint[hip].stiffness_source = StiffnessSource::none;
  });
}

TEST(ThreeWay, DutySetsTheMeanAndTheDifference) {
  Bench bench(three_way_leg());
  bench.reading[1] = 1895 - 400;  // U_theta = 14 %
  bench.run(20);
  EXPECT_EQ(bench.controller.state().joint[hip].duties, (Duties{54, 0, 26, 0}));
  EXPECT_NEAR(bench.open_share(0, 10), 0.54, 1e-9);
  EXPECT_NEAR(bench.open_share(2, 10), 0.26, 1e-9);
}

TEST(ThreeWay, NeverDrivesAnExhaustAndVentsByShutting) {
  Bench bench(three_way_leg());
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    for (std::uint16_t& r : bench.reading) r = static_cast<std::uint16_t>(random() % 4096);
    bench.run(1);
  }
  bench.controller.shut_down(bench.now - 1);
  bench.run(150);
  EXPECT_EQ(bench.controller.state().phase, Phase::off);
  std::array<bool, 4> open{};
  for (const Edge& e : bench.edges) {
    ASSERT_EQ(e.valve.index % 2, 0);
    open[e.valve.index] = e.open;
  }
  EXPECT_EQ(open, (std::array<bool, 4>{}));
  EXPECT_GT(bench.edges.size(), 300u);
}

// --- timed joints -------------------------------------------------------------------------------

JointControllerConfig timed_actuator() {
  return leg_with([](JointControllerConfig& c) {
    c.joints = 1;
    c.joint[hip].kind = JointKind::timed;
    c.joint[hip].extensor.present = false;
  });
}

// Returns the edges in two periods of a controller that receives a command in the first one.
std::vector<Edge> edges_of(JointController& controller, Tick first_visited) {
  Command command = rest_command(controller.config());
  command.joint[hip].enabled = command.joint[hip].timed = true;
  command.joint[hip].openings = {.inlet = {20, 100}, .exhaust = {0, 10}};
  controller.command(command);
  std::vector<Edge> out;
  for (Tick t = first_visited; t < 200; t = controller.next_event(t))
    for (const Edge& e : controller.edges(t)) out.push_back(e);
  return out;
}

TEST(Timed, ValvesOpenWhenTheHostHasItAndOnce) {
  JointController controller(timed_actuator());
  const std::vector<Edge> edges = edges_of(controller, 0);
  ASSERT_EQ(edges.size(), 4u) << "nothing opens in the second period, which has no command";
  const Edge expected[] = {{0, {1}, true}, {10, {1}, false}, {20, {0}, true}, {100, {0}, false}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(edges[i].at, expected[i].at);
    EXPECT_EQ(edges[i].valve.index, expected[i].valve.index);
    EXPECT_EQ(edges[i].open, expected[i].open);
  }
  controller.shut_down(199);
  const auto vents = controller.edges(200);
  ASSERT_EQ(vents.size(), 1u);
  EXPECT_TRUE(vents[0].open && vents[0].valve.index == 1) << "the exhaust alone";
}

TEST(Timed, APeriodWhoseStartIsSkippedOpensNothing) {
  JointController controller(timed_actuator());
  EXPECT_TRUE(edges_of(controller, 3).empty());
}

// --- regulators ---------------------------------------------------------------------------------

JointControllerConfig regulated_leg(float angle_integral) {
  return leg_with([&](JointControllerConfig& c) {
    c.joints = 1;
    c.joint[hip].kind = JointKind::regulated;
    c.joint[hip].stiffness_source = StiffnessSource::none;
    c.joint[hip].regulator.angle_integral = angle_integral;
  });
}

TEST(Regulated, SendsBothLevelsOncePerPeriod) {
  Bench bench(regulated_leg(0));
  bench.reading[1] = 1895 - 400;
  bench.run(20);
  ASSERT_EQ(bench.edges.size(), 40u);
  for (std::size_t i = 0; i < 40; i += 2) {
    EXPECT_EQ(bench.edges[i].at, static_cast<Tick>(100 * (i / 2) + 10));
    EXPECT_EQ(bench.edges[i].level, level_of(64));
    EXPECT_EQ(bench.edges[i + 1].level, level_of(36));
    EXPECT_TRUE(bench.edges[i].open);
  }
}

// A constant error ends with one muscle full and the other empty, as for the sealed muscles of 5.1.
TEST(Regulated, IntegratesToTheEnd) {
  Bench bench(regulated_leg(0.002f));
  bench.reading[1] = 1895 - 400;
  bench.run(200);
  EXPECT_EQ(bench.controller.state().joint[hip].levels, (Levels{signals::max_level, 0}));
  bench.reading[1] = 1895 + 30;
  bench.run(60);
  EXPECT_LT(bench.controller.state().joint[hip].levels.flexor, signals::max_level);
}

TEST(Regulated, DisabledOrShutDownIsNoPressure) {
  Bench bench(regulated_leg(0.1f));
  bench.reading[1] = 1000;
  bench.run(5);
  bench.command.joint[hip].enabled = false;
  bench.run(2);
  EXPECT_EQ(bench.edges.back().level, 0);
  bench.command.joint[hip].enabled = true;
  bench.command.joint[hip].open_loop = true;
  bench.command.joint[hip].duties = {.flexor_inlet = 25, .extensor_inlet = 75};
  bench.run(2);
  EXPECT_EQ(bench.controller.state().joint[hip].levels, (Levels{level_of(25), level_of(75)}));
  bench.controller.shut_down(bench.now - 1);
  bench.run(1);
  EXPECT_EQ(bench.edges.back().level, 0);
  EXPECT_FALSE(bench.edges.back().open);
}

}  // namespace
}  // namespace sinew::control::kinds_test
