// The air cylinder: a gas spring when it is sealed, a constant force behind a regulator.
#include "sinew/air/cylinder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::cylinder_test {
namespace {

Cylinder thesis_cylinder() {
  Cylinder c{.bore = 0.627 * inch, .rod_diameter = 0.1875 * inch, .stroke = 2 * inch};
  c.dead_volume = {1e-6, 1.5e-6};
  c.initial_pressure = {3e5, 2.5e5};
  for (const Side side : {up, down}) {
    c.inlet[side] = valve(4e-7);
    c.exhaust[side] = valve(5e-7);
  }
  return c;
}

Motion at(double travel, double rate = 0) {
  Motion m{};
  m.travel = travel;
  m.travel_rate = rate;
  return m;
}

TEST(Cylinder, GeometryIsThatOfAPistonWithARod) {
  const Cylinder c = thesis_cylinder();
  EXPECT_NEAR(area(c, down), 0.30876 * inch * inch, 1e-4 * inch * inch);  // 4.2: 0.627 in bore
  EXPECT_NEAR(area(c, down) - area(c, up), std::numbers::pi / 4 * c.rod_diameter * c.rod_diameter,
              1e-18);
  for (const Side side : {up, down}) {
    const double h = 1e-4, s = 0.02;
    EXPECT_NEAR((volume(c, side, s + h) - volume(c, side, s - h)) / (2 * h), volume_slope(c, side),
                1e-12);
  }
  EXPECT_EQ(volume(c, up, 0), c.dead_volume[up]);
  EXPECT_EQ(volume(c, down, c.stroke), c.dead_volume[down]);
  // Both chambers open: no force, whatever the area of the rod.
  EXPECT_EQ(force(c, 1e5, 1e5, 1e5), 0);
}

// P V^n of both chambers.
TEST(Cylinder, SealedItIsAGasSpring) {
  const Cylinder c = thesis_cylinder();
  const gas::Air air{.polytropic_exponent = 1.2};
  Air network({}, air, {}, c);
  TestIntegrator test(
      network, [](double) { return at(0.02); }, 1e5);
  for (double s : {0.0, 0.01, 0.03, 0.05}) {
    test.motion = [s](double) { return at(s); };
    test.evaluate(0, test.state, test.now);
    double f = 0;
    for (const Side side : {up, down}) {
      const double p =
          c.initial_pressure[side] * std::pow(volume(c, side, 0.02) / volume(c, side, s), 1.2);
      EXPECT_NEAR(test.now.cylinder_pressure[side] / p, 1, 1e-12);
      f += (side == up ? 1 : -1) * (p - air.atmosphere) * area(c, side);
    }
    EXPECT_NEAR(test.now.cylinder_force, f, 1e-10);
  }
}

// Without heat transfer the air is on the adiabat, whatever exponent it is given.
TEST(Cylinder, MovedWithoutHeatItDoesItsWork) {
  const Cylinder c = thesis_cylinder();
  Air network({}, {.polytropic_exponent = 1, .wall_time = 1e7}, {}, c);
  EXPECT_EQ(network.others(), 4);
  TestIntegrator test(
      network, [](double t) { return at(0.01 + 0.2 * t, 0.2); }, 1e5);
  test.run_until(0.15, 1e-4);
  for (const Side side : {up, down}) {
    const double ratio = volume(c, side, 0.01) / volume(c, side, 0.04);
    EXPECT_NEAR(test.now.cylinder_pressure[side] / c.initial_pressure[side], std::pow(ratio, 1.4),
                1e-6);
  }
}

// A weight on it oscillates at sqrt(k/m), k = n sum P A^2/V.
TEST(Cylinder, AWeightSwingsOnItAtItsFrequency) {
  const Cylinder c = thesis_cylinder();
  const gas::Air air{.polytropic_exponent = 1.4};
  Air network({}, air, {}, c);
  const double rest = 0.02, mass = 2.0;
  TestIntegrator test(
      network, [&](double) { return at(rest); }, 1e5);
  const double weight = test.now.cylinder_force;
  double k = 0;
  for (const Side side : {up, down})
    k += 1.4 * c.initial_pressure[side] * area(c, side) * area(c, side) / volume(c, side, rest);
  const double period = 2 * std::numbers::pi * std::sqrt(mass / k);

  // Leapfrog over one period comes back to where it started.
  const int steps = 20000;
  const double h = period / steps;
  double s = rest + 1e-6, v = 0;
  const auto acceleration = [&](double x) {
    test.motion = [x](double) { return at(x); };
    test.evaluate(0, test.state, test.now);
    return (test.now.cylinder_force - weight) / mass;
  };
  double a = acceleration(s);
  for (int i = 0; i < steps; ++i) {
    v += 0.5 * h * a;
    s += h * v;
    a = acceleration(s);
    v += 0.5 * h * a;
    if (i == steps / 2) {
      EXPECT_NEAR((s - rest) / 1e-6, -1, 1e-4);
    }
  }
  EXPECT_NEAR((s - rest) / 1e-6, 1, 1e-4);
}

// 4.2: a known pressure lifts a known force, and the mass of its air is counted.
TEST(Cylinder, ARegulatorPushesWithPressureTimesArea) {
  Cylinder c = thesis_cylinder();
  c.mode = Cylinder::Mode::regulator;
  c.pressure = 5e5;
  const gas::Air air;
  Air network({}, air, {}, c);
  EXPECT_EQ(network.others(), 0);
  const double lift = 0.04, speed = 0.1;
  TestIntegrator test(
      network, [&](double t) { return at(lift - speed * t, -speed); }, 1e5);
  EXPECT_NEAR(test.now.cylinder_force, -(5e5 - air.atmosphere) * area(c, down), 1e-10);
  const double before = network.total_mass(test.state, lift);
  test.run_until(0.3, 1e-3);
  EXPECT_NEAR(test.entered(), network.total_mass(test.state, lift - 0.03) - before, 1e-15);
  EXPECT_EQ(test.left(), 0);
  EXPECT_NEAR(test.entered(), gas::density(air, 5e5) * area(c, down) * 0.03, 1e-15);
}

// Inlet and exhaust of one chamber open together, B.1: a pressure in between, and air passes
// through.
TEST(Cylinder, BothValvesOpenSettleWhereTheirFlowsAgree) {
  const gas::Air air{.polytropic_exponent = 1};
  Air network({}, air, {}, thesis_cylinder());
  TestIntegrator test(
      network, [](double) { return at(0.02); }, 1e5);
  test.electrical(2, true);
  test.electrical(3, true);
  test.run_until(2.0, network.longest_step());
  EXPECT_NEAR(test.now.cylinder_inflow[down], test.now.cylinder_outflow[down],
              1e-9 * test.now.cylinder_inflow[down]);
  EXPECT_GT(test.now.cylinder_inflow[down], 1e-4);
  EXPECT_EQ(test.now.cylinder_inflow[up], 0);
  // Exhaust choked and larger: K_in P_s f(r) = K_out P.
  const double in = gas::mass_flow(4e-7, gas::Supply{}.pressure, air.temperature,
                                   test.now.cylinder_pressure[down], air);
  const double out =
      gas::mass_flow(5e-7, test.now.cylinder_pressure[down], air.temperature, 0, air);
  EXPECT_NEAR(in / out, 1, 1e-9);
}

TEST(Cylinder, ChambersThatVanishAreRefused) {
  Cylinder c = thesis_cylinder();
  c.dead_volume[up] = 0;
  EXPECT_THROW(Air({}, {}, {}, c), std::invalid_argument);
}

}  // namespace
}  // namespace sinew::air::cylinder_test
