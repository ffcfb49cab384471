// Each option of the network against its law: what is conserved, a closed form, a limit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/braid.h"
#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"
#include "sinew/gas/heat.h"

namespace sinew::air::options_test {
namespace {

Motion still(double length = 3.15 * inch) { return still_at(length); }
Motion at_rest(double) { return still(); }

Muscle ideal_bundle() {
  Muscle m = bundle(0);
  m.inlet.profile = m.exhaust.profile = gas::Valve::Profile::ideal;
  return m;
}

double volume_of(const Muscle& m, double length) {
  return m.count * actuator::volume(m.actuator.braid, length) + m.external_volume;
}

gas::Air isothermal() { return {.polytropic_exponent = 1}; }

// In every case air is in the machine or has left it.
TEST(AirNetwork, AirIsConserved) {
  for (const double wall_time : {0.0, 0.2}) {
    const gas::Air air{.polytropic_exponent = 1.1, .wall_time = wall_time};
    const gas::Supply supply{.kind = gas::Supply::Kind::tank,
                             .pressure = 6 * bar,
                             .volume = 2e-4,
                             .initial_pressure = 7 * bar};
    Air network(everything(), air, supply, thesis_cylinder());
    const auto motion = [](double t) { return swaying(3.15 * inch, t); };
    TestIntegrator test(network, motion, 1.5 * bar);
    const double before = network.total_mass(test.state, motion(0).travel);
    std::mt19937 random(1);
    for (int k = 0; k < 300; ++k) {
      test.electrical(static_cast<int>(random() % 16u), random() % 2 == 0);
      test.level(8, test.t, 0.1 * (k % 10));
      test.run_until(test.t + 2e-3, network.longest_step());
    }
    EXPECT_GT(test.left(), 0.1 * before);
    const double after = network.total_mass(test.state, motion(test.t).travel);
    EXPECT_NEAR((after + test.left()) / before, 1, 1e-12) << wall_time;
    EXPECT_LT(test.now.tank_pressure, 5 * bar);
  }
}

TEST(AirNetwork, AnInfiniteTankIsAConstantSupply) {
  const std::vector<Muscle> one{ideal_bundle()};
  const gas::Supply constant{.pressure = 6 * bar};
  const gas::Supply tank{.kind = gas::Supply::Kind::tank,
                         .pressure = 6 * bar,
                         .volume = 1e6,
                         .initial_pressure = 6 * bar};
  Air a(one, {}, constant), b(one, {}, tank);
  TestIntegrator with(a, at_rest, 1.2 * bar), without(b, at_rest, 1.2 * bar);
  for (TestIntegrator* test : {&with, &without}) {
    test->electrical(0, true);
    test->run_until(0.05, 1e-4);
  }
  EXPECT_GT(with.now.pressure[0], 4 * bar);
  EXPECT_NEAR(without.now.pressure[0] / with.now.pressure[0], 1, 1e-9);
}

// Isothermal: finally one pressure, and all air is (V_tank + V) at that pressure.
TEST(AirNetwork, ATankSharesItsAirWithTheMuscles) {
  const std::vector<Muscle> one{ideal_bundle()};
  const gas::Supply tank{.kind = gas::Supply::Kind::tank,
                         .pressure = 9 * bar,
                         .volume = 5e-5,
                         .initial_pressure = 6 * bar};
  Air network(one, isothermal(), tank);
  TestIntegrator test(network, at_rest, 1.5 * bar);
  test.electrical(0, true);
  test.run_until(1.0, 2e-4);
  const double v = volume_of(one[0], 3.15 * inch);
  const double shared = (6 * bar * tank.volume + 1.5 * bar * v) / (tank.volume + v);
  EXPECT_NEAR(test.now.pressure[0] / shared, 1, 1e-9);
  EXPECT_NEAR(test.now.tank_pressure / shared, 1, 1e-9);

  // The regulator holds the line down while the tank is above it.
  gas::Supply regulated = tank;
  regulated.pressure = 3 * bar;
  Air behind(one, isothermal(), regulated);
  TestIntegrator held(behind, at_rest, 1.5 * bar);
  held.electrical(0, true);
  held.run_until(0.5, 2e-4);
  EXPECT_NEAR(held.now.pressure[0], 3 * bar, 1e-4 * bar);
  EXPECT_NEAR(held.now.tank_pressure, 6 * bar - 1.5 * bar * v / tank.volume, 1e-4 * bar);
}

TEST(AirNetwork, ValveAndHoseInSeriesCarryTheSameFlow) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> pressures(0.8 * bar, 7.5 * bar), size(0.2, 5);
  for (int trial = 0; trial < 500; ++trial) {
    Muscle m = ideal_bundle();
    m.hose = trial % 2 ? iso_hose(3e-9 * size(random))
                       : gas::Hose{.law = gas::Hose::Law::pipe,
                                   .length = 0.3 * size(random),
                                   .inner_diameter = 2e-3 * size(random)};
    const gas::Air air;
    Air network(std::vector{m}, air, {});
    TestIntegrator test(network, at_rest, pressures(random));
    const int which = trial % 3;
    if (which != 1) test.electrical(0, true);
    if (which != 0) test.electrical(1, true);
    const double node = gas::y_of(air, test.now.manifold[0]);
    const double y = gas::y_of(air, test.now.pressure[0]);
    const gas::HoseConstants constants = gas::hose_constants(m.hose, air);
    const double hose = gas::hose_flow_y(constants, node, y);
    const double net = test.now.inflow[0] - test.now.outflow[0];
    // A wide hose turns roundings of y into flow.
    const double rounding = std::abs(gas::hose_flow_y(constants, node * (1 + 3e-15), y) -
                                     gas::hose_flow_y(constants, node * (1 - 3e-15), y));
    EXPECT_NEAR(net, hose, rounding + 1e-11 * std::abs(hose)) << trial;
    EXPECT_LT(rounding, 1e-8 * std::abs(hose) + 1e-9) << trial;
    if (which == 0) {  // slower than either alone
      const double alone = gas::flow_y(gas::flow_constants(m.inlet.flow, air),
                                       gas::y_of(air, gas::Supply{}.pressure), y);
      EXPECT_LE(std::abs(net), std::abs(alone) * (1 + 1e-12));
    }
  }
}

// Nearly equal pressures: both restrictions are linear, and conductances add as 1/G.
TEST(AirNetwork, LinearRestrictionsInSeriesAddTheirResistances) {
  Muscle m = ideal_bundle();
  m.hose = iso_hose(3e-9);
  const gas::Air air;
  const gas::Supply supply;
  Air network(std::vector{m}, air, supply);
  const double dp = 50;
  TestIntegrator test(network, at_rest, supply.pressure - dp);
  test.electrical(0, true);
  const double g1 = gas::flow_constants(m.inlet.flow, air).linear_gain / air.atmosphere;
  const double g2 = gas::hose_constants(m.hose, air).iso.linear_gain / air.atmosphere;
  EXPECT_NEAR(test.now.inflow[0] / (dp * g1 * g2 / (g1 + g2)), 1, 1e-9);
}

// Starts where the inlet is no longer choked, so that the downstream pressure matters.
double pressure_after_filling(const Muscle& m, double step) {
  Air network(std::vector{m}, isothermal(), {});
  TestIntegrator test(network, at_rest, 5 * bar);
  test.electrical(0, true);
  test.run_until(0.01, step);
  return test.now.pressure[0];
}

TEST(AirNetwork, AHoseWithoutResistanceIsNone) {
  const Muscle plain = ideal_bundle();
  const double without = pressure_after_filling(plain, 1e-4);
  double last = without;
  for (const double conductance : {1e-8, 1e-7, 1e-6, 1e-5}) {
    Muscle m = plain;
    m.hose = iso_hose(conductance);
    const double off = std::abs(pressure_after_filling(m, 1e-4) - without);
    EXPECT_LT(off, 0.2 * last);  // quadratic: a tenth of the drop is a hundredth of the error
    last = off;
  }
  EXPECT_LT(last, 1e-5 * without);
}

TEST(AirNetwork, ASmallerHoseChamberConvergesToNone) {
  Muscle m = ideal_bundle();
  m.hose = iso_hose(2e-9);
  const double none = pressure_after_filling(m, 1e-5);
  double last = 0;
  for (const double volume : {1e-6, 0.5e-6, 0.25e-6, 0.125e-6}) {
    // All have the same air: the chamber's volume is subtracted from the muscle's.
    m.hose.volume = volume;
    m.external_volume = 4e-6 - volume;
    const double off = std::abs(pressure_after_filling(m, 1e-6) - none);
    if (last > 0) {
      EXPECT_NEAR(off / last, 0.5, 0.1);
    }
    last = off;
  }
}

// Rigid, isothermal: through a hole choked, P = P_0 exp(-t K R T/V); through a porous wall
// P - P_atm falls by exp(-t G R T/V).
TEST(AirNetwork, LeaksDecayInClosedForm) {
  const gas::Air air = isothermal();
  const double rt = air.gas_constant * air.temperature, v = volume_of(bundle(0), 3.15 * inch);

  Muscle hole = bundle(0);
  hole.leak.area = 2e-8;
  Air a(std::vector{hole}, air, {});
  EXPECT_TRUE(a.flowing(a.valves_at_rest()));
  TestIntegrator choked(a, at_rest, 7 * bar);
  choked.run_until(0.5, 1e-3);
  ASSERT_GT(choked.now.pressure[0], 2 * bar);
  const double k =
      hole.leak.area * gas::choked_parameter(air.gas_constant) / std::sqrt(air.temperature);
  EXPECT_NEAR(choked.now.pressure[0] / (7 * bar * std::exp(-0.5 * k * rt / v)), 1, 1e-9);

  Muscle porous = bundle(0);
  porous.leak.conductance = 1e-10;
  Air b(std::vector{porous}, air, {});
  TestIntegrator linear(b, at_rest, 7 * bar);
  linear.run_until(1.0, 1e-3);
  const double start = 7 * bar - air.atmosphere;
  EXPECT_NEAR((linear.now.pressure[0] - air.atmosphere) / (start * std::exp(-1e-10 * rt / v)), 1,
              1e-9);
  EXPECT_NEAR(linear.left(),
              linear.network.initial(7 * bar, still().length, 0).mass[0] - linear.state.mass[0],
              1e-15);
}

// Sealed and squeezed: P V^1.4 with a slow wall, P V with a fast one.
TEST(AirNetwork, WallsBracketThePolytrope) {
  const Muscle m = bundle(0);
  const auto motion = [](double t) {
    Motion s = still((3.0 + 4 * t) * inch);
    for (int i = 0; i < 8; ++i) s.rate[i] = 4 * inch;
    return s;
  };
  const double ratio = volume_of(m, 3.0 * inch) / volume_of(m, 3.6 * inch);
  for (const auto& [wall_time, exponent, tolerance] :
       {std::tuple{1e6, 1.4, 1e-6}, std::tuple{2e-3, 1.0, 2e-2}, std::tuple{2e-4, 1.0, 2e-3}}) {
    Air network(std::vector{m}, gas::Air{.wall_time = wall_time}, {});
    TestIntegrator test(network, motion, 3 * bar);
    test.run_until(0.15, std::min(1e-3, network.longest_step()));
    EXPECT_NEAR(test.now.pressure[0] / (3 * bar * std::pow(ratio, exponent)), 1, tolerance);
  }
}

// First law for a rigid chamber without a wall: what filling adds is c_p T_supply per mass, so
// P = P_0 + gamma R T m_in/V; and it cools to the isothermal pressure with tau.
TEST(AirNetwork, FillingWarmsAndStandingCools) {
  const Muscle m = ideal_bundle();
  const double v = volume_of(m, 3.15 * inch);
  gas::Air air{.wall_time = 1e7};
  const double rt = air.gas_constant * air.temperature;
  Air quick(std::vector{m}, air, {});
  TestIntegrator fill(quick, at_rest, 1.5 * bar);
  fill.electrical(0, true);
  fill.run_until(0.03, 1e-4);
  EXPECT_NEAR(fill.now.pressure[0] / (1.5 * bar + 1.4 * rt * fill.entered() / v), 1, 1e-8);

  // Letting out leaves the rest on the adiabat: P ~ m^1.4.
  const double mass = fill.state.mass[0], p = fill.now.pressure[0];
  fill.electrical(0, false);
  fill.electrical(1, true);
  fill.run_until(0.04, 1e-5);
  ASSERT_LT(fill.state.mass[0], 0.8 * mass);
  EXPECT_NEAR(fill.now.pressure[0] / (p * std::pow(fill.state.mass[0] / mass, 1.4)), 1, 1e-8);

  air.wall_time = 0.1;
  Air slow(std::vector{m}, air, {});
  TestIntegrator stand(slow, at_rest, 1.5 * bar);
  stand.electrical(0, true);
  stand.run_until(0.03, 1e-4);
  stand.electrical(0, false);
  const double warm = stand.now.pressure[0], cold = stand.state.mass[0] * rt / v;
  ASSERT_GT(warm, 1.1 * cold);
  stand.run_until(0.13, 1e-3);
  EXPECT_NEAR((stand.now.pressure[0] - cold) / (warm - cold), std::exp(-1.0), 1e-6);
}

// A muscle behind a regulator of ample flow follows its outlet: P_atm + range (1 - exp(-t/tau)).
TEST(AirNetwork, ARegulatorLagsAndItsFlowIsLimited) {
  Muscle m = bundle(0);
  m.inlet.kind = gas::Valve::Kind::regulator;
  m.inlet.regulator = {.range = 5 * bar, .time_constant = 0.05};
  m.inlet.flow.area = 1e-4;
  const gas::Air air;
  Air ample(std::vector{m}, air, {});
  TestIntegrator test(ample, at_rest, air.atmosphere);
  test.level(0, 0.01, 0.8);
  EXPECT_EQ(test.valves.next_change, 0.01);
  test.run_until(0.06, 1e-5);
  const double expected = air.atmosphere + 4 * bar * (1 - std::exp(-1.0));
  EXPECT_NEAR(test.state.other[0], expected, 1e-6 * bar);
  EXPECT_NEAR(test.now.pressure[0], expected, 5e-3 * bar);

  m.inlet.flow.area = 1e-7;  // small: choked from the outlet all the way
  m.inlet.regulator.time_constant = 0;
  Air small(std::vector{m}, air, {});
  EXPECT_EQ(small.others(), 0);
  TestIntegrator fill(small, at_rest, air.atmosphere);
  fill.level(0, 0, 1.0);
  fill.node(0);
  fill.run_until(0.05, 1e-3);
  const double outlet = air.atmosphere + 5 * bar;
  EXPECT_NEAR(fill.entered() / (0.05 * gas::mass_flow(1e-7, outlet, air.temperature, 0, air)), 1,
              1e-9);
  // Air that flows back is relieved into the room.
  fill.level(0, 0.05, 0.0);
  fill.node(0.05);
  fill.run_until(0.06, 1e-3);
  EXPECT_GT(fill.left(), 0);
  EXPECT_EQ(fill.now.inflow[0], 0);
}

TEST(AirNetwork, ARegulatorCannotGiveMoreThanTheLine) {
  Muscle m = bundle(0);
  m.inlet.kind = gas::Valve::Kind::regulator;
  m.inlet.regulator = {.range = 9 * bar};
  Air network(std::vector{m}, isothermal(), {.pressure = 4 * bar});
  TestIntegrator test(network, at_rest, 1.5 * bar);
  test.level(0, 0, 1.0);
  test.node(0);
  test.run_until(0.5, 5e-4);
  EXPECT_NEAR(test.now.pressure[0], 4 * bar, 10);
}

// 4.3: the delay depends on the pressure difference at the edge, and the coil has its limit.
TEST(AirNetwork, EdgesFeelThePressureOverTheirValve) {
  Muscle m = bundle(0);
  m.inlet.opening_delay_slope = 1e-9;
  m.exhaust.opening_delay_slope = 2e-9;
  m.exhaust.fails_above = 4 * bar;
  const gas::Air air;
  const gas::Supply supply;
  for (const double p : {2 * bar, 4.9 * bar, 5.2 * bar}) {
    Air network(std::vector{m}, air, supply);
    TestIntegrator test(network, at_rest, p);
    const double over = test.now.pressure[0] - air.atmosphere;
    test.edge(1, 0.1, true);
    if (over > 4 * bar) {
      EXPECT_EQ(test.valves.next_change, std::numeric_limits<double>::infinity());
      test.edge(1, 0.2, false);  // has no effect either
      EXPECT_EQ(test.valves.next_change, std::numeric_limits<double>::infinity());
    } else {
      EXPECT_NEAR(test.valves.next_change, 0.1 + 0.3e-3 + 2e-9 * over, 1e-15);
    }
    test.edge(0, 0.05, true);
    const double below = supply.pressure - test.now.pressure[0];
    EXPECT_NEAR(test.valves.next_change, 0.05 + 0.3e-3 + 1e-9 * below, 1e-15);
  }
}

TEST(AirNetwork, QuietMeansThatNothingMoves) {
  Air network(std::vector{bundle(0), bundle(0.2)}, {}, {}, thesis_cylinder());
  TestIntegrator test(network, at_rest, 3 * bar);
  EXPECT_FALSE(network.flowing(test.valves));
  const Air::State before = test.state;
  test.run_until(0.01, 1e-3);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(test.state.mass[i], before.mass[i]);
  for (int i = 0; i < network.others(); ++i)
    EXPECT_EQ(test.state.other[static_cast<std::size_t>(i)],
              before.other[static_cast<std::size_t>(i)]);
  test.electrical(5, true);
  test.run_until(0.011, 1e-3);
  EXPECT_TRUE(network.flowing(test.valves));
}

}  // namespace
}  // namespace sinew::air::options_test
