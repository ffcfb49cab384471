// A test of dimensional analysis: a leg n times as small, whose numbers are scaled by their units
// alone, moves in time t/n as the leg moves in t. Valves are driven open loop at random.
#include "scale.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "runs.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/simulation/run.h"
#include "sinew/world/machine.h"
#include "tests/places.h"

namespace sinew::scale_test {
namespace {

using experiment::Experiment;
using signals::Tick;
using test::scaled;

struct Toggle {
  Tick at = 0;  // of the small machine
  std::uint8_t valve = 0;
};

std::vector<Toggle> random_toggles(unsigned seed, int valves, Tick end) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> gap(1, 30), which(0, valves - 1);
  std::vector<Toggle> out;
  for (Tick t = 0; t < end; t += gap(random))
    out.push_back({t, static_cast<std::uint8_t>(which(random))});
  return out;
}

// Returns the motion of the machine, with ticks that are `stretch` of the small one's.
template <class World>
std::vector<plant::Truth> motion(const Experiment& e, const std::vector<Toggle>& toggles,
                                 Tick stretch, Tick end) {
  World world(run::planar_setup(e));
  world.start({.period = 100, .conversions = {}});
  std::vector<bool> open(32, false);
  std::vector<plant::Truth> out;
  std::size_t next = 0;
  for (Tick t = 0; t <= end; t += 20) {
    for (; next < toggles.size() && toggles[next].at <= t; ++next) {
      const std::size_t v = toggles[next].valve;
      open[v] = !open[v];
      world.drive(
          {.at = stretch * toggles[next].at, .valve = {toggles[next].valve}, .open = open[v]});
    }
    out.push_back(world.truth(static_cast<double>(stretch * t) * signals::tick_seconds));
  }
  return out;
}

// Largest difference of one quantity, the small machine's by `factor`, over its largest value.
template <class Quantity>
double difference(const std::vector<plant::Truth>& large, const std::vector<plant::Truth>& small,
                  double factor, Quantity quantity) {
  double most = 0, scale = 0;
  for (std::size_t i = 0; i < large.size(); ++i) {
    most = std::max(most, std::abs(quantity(large[i]) - factor * quantity(small[i])));
    scale = std::max(scale, std::abs(quantity(large[i])));
  }
  return scale > 0 ? most / scale : most;
}

void expect_alike(const std::vector<plant::Truth>& large, const std::vector<plant::Truth>& small,
                  double n, int joints, int muscles, double tolerance) {
  ASSERT_EQ(large.size(), small.size());
  const auto expect = [&](const char* what, double factor, auto quantity) {
    EXPECT_LE(difference(large, small, factor, quantity), tolerance) << what;
  };
  using plant::Truth;
  for (std::size_t j = 0; j < static_cast<std::size_t>(joints); ++j) {
    expect("angle", 1, [j](const Truth& t) { return t.angle[j]; });
    expect("rate", 1 / n, [j](const Truth& t) { return t.rate[j]; });
    expect("torque", n * n * n, [j](const Truth& t) { return t.torque[j]; });
  }
  for (std::size_t m = 0; m < static_cast<std::size_t>(muscles); ++m) {
    expect("pressure", 1, [m](const Truth& t) { return t.pressure[m]; });
    expect("tension", n * n, [m](const Truth& t) { return t.tension[m]; });
    expect("length", n, [m](const Truth& t) { return t.length[m]; });
    expect("air", n * n * n, [m](const Truth& t) { return t.air_in[m]; });
  }
  expect("distance", n, [](const Truth& t) { return t.x; });
  expect("lift", n, [](const Truth& t) { return t.lift; });
  expect("speed", 1, [](const Truth& t) { return t.x_rate; });
  expect("ground", n * n, [](const Truth& t) { return t.foot[0].force_y; });
  expect("tank", 1, [](const Truth& t) { return t.tank_pressure; });
}

Experiment load(const std::string& name, const std::vector<std::string>& sets = {}) {
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

template <class World>
void compare(const Experiment& e, int n, unsigned seed, double seconds, double tolerance) {
  const int muscles = static_cast<int>(e.robot.muscles.size());
  const auto end = static_cast<Tick>(seconds / signals::tick_seconds / n);
  const auto toggles = random_toggles(seed, 2 * muscles, end);
  const auto large = motion<World>(e, toggles, n, end),
             small = motion<World>(scaled(e, 1.0 / n), toggles, 1, end);
  expect_alike(large, small, n, static_cast<int>(e.robot.joints.size()), muscles, tolerance);
  double moved = 0;
  for (const plant::Truth& t : large) moved = std::max(moved, std::abs(t.rate[0]));
  EXPECT_GT(moved, 0.5);  // rad/s: the machine moved
}

const std::vector<std::string> everything = {
    "air.supply.kind=tank",
    "air.supply.volume=1 L",
    "air.supply.initial_pressure=110 psi gauge",
    "air.wall_time=0.3 s",
    "muscle.hip_flexor.hose={ law = \"iso6358\", sonic_conductance = \"0.4 L/(s bar)\", "
    "critical_pressure_ratio = 0.4 }",
    "muscle.knee_flexor.leak={ area = \"1e-8 m2\" }",
    "muscle.knee_extensor.leak={ conductance = \"1e-12 kg/(s Pa)\" }",
    "joint.hip.damper=1 lbf in s/rad",
    "trolley.payload=2 lb"};

// Joints with friction, or a foot and a trolley with friction: of one kind, see below.
const std::vector<std::string> no_trolley = {"trolley.drag=0 lbf"},
                               smooth_joints = {"joint.hip.dry_friction=0 lbf in",
                                                "joint.knee.dry_friction=0 lbf in",
                                                "actuator.bpa.loss.coulomb_length=0 in"};

const std::vector<std::string> smooth_ankle = {"joint.ankle.dry_friction=0 lbf in"};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A scale that is a power of two only changes exponents: not one bit may differ. A number in the
// code that has a unit and was not scaled would show, however small its effect.
TEST(Scale, AnEighthOfTheLegMovesAlikeToTheBit) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    compare<plant::ChainWorld<2>>(load("leg-in-air", no_trolley), 8, seed, 4, 0);
    compare<plant::ChainWorld<2>>(load("walk-test-1", smooth_joints), 8, seed, 4, 0);
  }
}

TEST(Scale, AnEighthOfAWholeMachineToo) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    compare<plant::BodyWorld>(load("leg-in-air", no_trolley + everything), 8, seed, 2, 0);
    compare<plant::BodyWorld>(load("walk-test-1", smooth_joints + everything), 8, seed, 2, 0);
    compare<plant::BodyWorld>(load("walk-with-ankle", smooth_joints + smooth_ankle + everything), 8,
                              seed, 2, 0);
    compare<plant::BodyWorld>(load("known-load", smooth_joints), 8, seed, 2, 0);
  }
}

// Any other one to rounding.
TEST(Scale, AFifthOfTheLegMovesAlikeToRounding) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    compare<plant::ChainWorld<2>>(load("leg-in-air", no_trolley), 5, seed, 2, 1e-9);
    compare<plant::ChainWorld<2>>(load("walk-test-1", smooth_joints), 5, seed, 2, 1e-9);
    compare<plant::BodyWorld>(load("leg-in-air", no_trolley + everything), 5, seed, 2, 1e-9);
  }
}

// The small damping in mechanism/friction/friction.h is 1e-9 of the largest response, be it of an
// angle or of a distance: with both kinds of friction it has a size of its own, and causes a
// difference of that order.
TEST(Scale, BothKindsOfFrictionAgreeButForAHair) {
  constexpr int n = 8;
  constexpr Tick end = 1200;  // 0.96 s of the leg
  const Experiment leg = load("walk-test-1");
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto toggles = random_toggles(seed, 8, end);
    const auto large = motion<plant::ChainWorld<2>>(leg, toggles, n, end),
               small = motion<plant::ChainWorld<2>>(scaled(leg, 1.0 / n), toggles, 1, end);
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_LE(difference(large, small, 1, [j](const plant::Truth& t) { return t.angle[j]; }),
                1e-5);
    EXPECT_LE(difference(large, small, n, [](const plant::Truth& t) { return t.x; }), 1e-5);
  }
}

// --- robots/cricket -----------------------------------------------------------------------------

// Its file is the leg scaled to an eighth, in numbers of four digits: in the air, with the leg's
// delays and gravity scaled as well, it moves alike.
TEST(Cricket, IsTheLegAnEighthAsLarge) {
  const auto end = static_cast<Tick>(0.2 / signals::tick_seconds);  // 1.6 s of the leg
  Experiment leg = scaled(load("walk-test-1"), 1.0 / 8), cricket = load("cricket");
  cricket.robot.gravity = leg.robot.gravity;
  for (gas::Valve& v : cricket.valves)
    for (const gas::Valve& of_leg : leg.valves)
      if (v.name == of_leg.name)
        v.opening_delay = of_leg.opening_delay, v.closing_delay = of_leg.closing_delay;
  for (Experiment* e : {&leg, &cricket})
    e->robot.foot.present = e->robot.ground.present = e->robot.trolley.present = false;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto toggles = random_toggles(seed, 8, end);
    const auto a = motion<plant::ChainWorld<2>>(leg, toggles, 1, end),
               b = motion<plant::ChainWorld<2>>(cricket, toggles, 1, end);
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_LE(difference(a, b, 1, [j](const plant::Truth& t) { return t.angle[j]; }), 2e-3);
    for (std::size_t m = 0; m < 4; ++m)
      EXPECT_LE(difference(a, b, 1, [m](const plant::Truth& t) { return t.pressure[m]; }), 5e-3);
  }
}

TEST(Cricket, StandsInACubeOfTwoInches) {
  constexpr double cube = 2 * 0.0254;
  const robot::Robot r = load("cricket").robot;
  EXPECT_LE(r.rollers.height - r.ground.height + r.foot.radius, cube);
  EXPECT_LE(r.rollers.front - r.rollers.rear, cube);
  for (const robot::Link& l : r.links) EXPECT_LE(l.length, cube);
}

// 7.1: the size is not the limit. Its valves are: the effect of a delay grows as the legs shrink.
TEST(Cricket, WalksAndFeelsDelaysMoreThanWeight) {
  const auto distance = [](std::vector<std::string> sets) {
    return test::figure(test::summary_of("cricket", std::move(sets)), "trolley.distance_m") /
           0.0254;
  };
  const double own = distance({});
  EXPECT_GT(own, 9);
  EXPECT_NEAR(distance({"gravity=0 m/s2"}), own, 0.1 * own);
  std::vector<std::string> slow;
  for (const char* valve : {"inlet", "exhaust"})
    for (const char* way : {"opening", "closing"})
      slow.push_back(std::string("valve.") + valve + "." + way + "_delay=2 ms");
  EXPECT_LT(distance(slow), 0.85 * own);
}

}  // namespace
}  // namespace sinew::scale_test
