// Conservation laws of a planar world, with and without muscles.
#include "sinew/world/machine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/mechanism/planar/test_setups.h"

namespace sinew::plant::world_test {
namespace {

double swinging_energy(const ChainWorld<2>& world) {
  return world.constants().gravity *
         (world.constants().first_moment[0] + world.constants().first_moment[1]);
}

// Released from (0.6, -0.9) rad the leg swings freely under its trolley.
TEST(World, EnergyIsKeptWithoutMusclesAndFriction) {
  ChainWorld<2> world(leg_without_muscles(0.6, -0.9));
  const double before = energy(world.constants(), world.motion());
  world.advance(10.0);
  const double drift = energy(world.constants(), world.motion()) - before;
  EXPECT_LE(std::abs(drift) / swinging_energy(world), 1e-7);
}

TEST(World, EnergyIsKeptOnAFixedBase) {
  plant::Setup setup = leg_without_muscles(0.6, -0.9);
  setup.robot.trolley.present = false;
  ChainWorld<2> world(setup);
  const double before = energy(world.constants(), world.motion());
  world.advance(10.0);
  EXPECT_LE(std::abs(energy(world.constants(), world.motion()) - before) / swinging_energy(world),
            1e-7);
  EXPECT_EQ(world.motion().x, 0.0);
}

// No force acts along the track, so the centre of mass does not move along it either.
TEST(World, MomentumAlongTheTrackIsKept) {
  ChainWorld<2> world(leg_without_muscles(0.6, -0.9));
  world.advance(5.0);
  const double scale = world.constants().total_mass;  // times 1 m/s
  EXPECT_LE(std::abs(momentum(world.constants(), world.motion())) / scale, 1e-8);
}

// One link, small swing: the physical pendulum's period 2 pi sqrt(I / (m g r)), amplitude included.
TEST(World, OneLinkIsAPhysicalPendulum) {
  plant::Setup setup = leg_without_muscles(0, 0);
  setup.robot.links.resize(1);
  setup.robot.joints.resize(1);
  setup.robot.trolley.present = false;
  setup.robot.foot.present = false;
  const double down = 1.5 * 3.14159265358979312, amplitude = 0.05;
  setup.start.joint_angle = {down + amplitude};
  ChainWorld<1> world(setup);

  const robot::Link& link = setup.robot.links[0];
  const double r = link.center_of_mass;
  const double inertia = link.inertia + link.mass * r * r;
  const double period = 2 * 3.14159265358979312 * std::sqrt(inertia / (link.mass * 9.80665 * r)) *
                        (1 + amplitude * amplitude / 16);
  world.advance(10 * period);
  EXPECT_NEAR(world.motion().angle[0], down + amplitude, 3e-5);
}

// Sealed muscles, no dry friction: halving the step divides the error by sixteen.
TEST(World, SealedMusclesConvergeWithTheFourthOrder) {
  const auto swing = [](double step) {
    plant::Setup setup = leg_with_muscles(4.95, 5.40);
    for (air::Muscle& m : setup.muscles) m.actuator.loss.coulomb_length = 0;
    setup.start.pressure = 3e5;
    setup.steps.body = step;
    ChainWorld<2> world(setup);
    world.advance(0.256);
    return world.motion();
  };
  const GeneralizedState<2> exact = swing(1.25e-4);
  const auto error = [&](double step) {
    const GeneralizedState<2> p = swing(step);
    return std::hypot(p.angle[0] - exact.angle[0], p.angle[1] - exact.angle[1]);
  };
  const double coarse = error(4e-3), fine = error(2e-3);
  EXPECT_GT(coarse, 1e-9);  // above rounding, so that it can converge
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.5);
}

// Air in less air out is the air inside, whatever the valves do.
TEST(World, AirIsAccountedFor) {
  ChainWorld<2> world(leg_with_muscles(4.95, 5.40));
  const Truth before = world.truth(0);
  std::mt19937 random(7);
  signals::Tick t = 0;
  for (int i = 0; i < 400; ++i) {
    t += 1 + random() % 40;
    world.drive({t, {static_cast<std::uint8_t>(random() % 8)}, random() % 2 == 0});
    world.truth(t * 1e-4);
  }
  const Truth after = world.truth(t * 1e-4);
  double moved = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    moved += after.air_in[i];
    EXPECT_NEAR(after.mass[i] - before.mass[i], after.air_in[i] - after.air_out[i],
                1e-12 * (after.air_in[i] + after.mass[i]));
  }
  EXPECT_GT(moved, 1e-4);  // 100 mg: the valves did something
}

// On P_atm (rho/rho_atm)^n a sealed muscle stays sealed: P V^n is constant through a swing.
TEST(World, SealedAirStaysOnItsPolytrope) {
  plant::Setup setup = leg_with_muscles(4.95, 5.40);
  setup.start.pressure = 4e5;
  ChainWorld<2> world(setup);
  const Truth start = world.truth(0);
  const air::AirNetwork<chain_muscles> network(setup.muscles, setup.air, setup.supply);
  for (int k = 1; k <= 300; ++k) {
    const Truth now = world.truth(k * 2.7e-3);
    for (int i = 0; i < 4; ++i) {
      const auto m = static_cast<std::size_t>(i);
      EXPECT_EQ(now.mass[m], start.mass[m]);
      const double ratio = network.volume(i, start.length[m]) / network.volume(i, now.length[m]);
      EXPECT_NEAR(now.pressure[m] / (start.pressure[m] * std::pow(ratio, 1.2)), 1.0, 1e-9);
    }
  }
}

// design.md: a preview is within 0.01 count of angle and 0.2 count of tension of a node there.
TEST(World, PreviewsAgreeWithNodes) {
  constexpr double counts_per_rad = 714, counts_per_newton = 0.17 * 819.2 / 4.4482216152605;
  plant::Setup setup = leg_with_muscles(4.87, 5.46);
  setup.start.pressure = 2.5e5;
  for (air::Muscle& m : setup.muscles) m.actuator.loss.coulomb_length = 0;
  ChainWorld<2> coarse(setup);
  setup.steps.body = 2e-5;
  ChainWorld<2> fine(setup);
  std::mt19937 random(11);
  for (int k = 1; k <= 60; ++k) {
    const signals::Tick t = 10 * k + static_cast<signals::Tick>(random() % 10);
    // A valve moves occasionally; both worlds have the same edge.
    if (k % 20 == 5)
      for (ChainWorld<2>* w : {&coarse, &fine}) w->drive({10 * k, {0}, k % 40 == 5});
    const Truth a = coarse.truth(t * 1e-4), b = fine.truth(t * 1e-4);
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(a.angle[j] * counts_per_rad, b.angle[j] * counts_per_rad, 0.01);
    for (std::size_t m = 0; m < 4; ++m)
      EXPECT_NEAR(a.tension[m] * counts_per_newton, b.tension[m] * counts_per_newton, 0.2);
  }
}

// A preview changes nothing: any number of previews, at any time, leaves the same bits.
TEST(World, PeeksLeaveNoTrace) {
  plant::Setup setup = leg_with_muscles(4.95, 5.40);
  setup.robot.joints[0].dry_friction = 0.1;
  ChainWorld<2> watched(setup), alone(setup);
  std::mt19937 random(5);
  for (signals::Tick t = 0; t < 5000; ++t) {
    if (t % 37 == 0) {
      const signals::Edge e{t, {static_cast<std::uint8_t>(random() % 8)}, random() % 3 == 0};
      watched.drive(e);
      alone.drive(e);
    }
    for (unsigned reads = random() % 3; reads > 0; --reads) watched.truth(t * 1e-4);
  }
  watched.advance(0.5);
  alone.advance(0.5);
  EXPECT_EQ(watched.nodes(), alone.nodes());
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(watched.motion().angle[j], alone.motion().angle[j]);
    EXPECT_EQ(watched.motion().rate[j], alone.motion().rate[j]);
  }
  EXPECT_EQ(watched.motion().x, alone.motion().x);
}

}  // namespace
}  // namespace sinew::plant::world_test
