// Each fault of the air has its effect, conserves air, and changes nothing before it begins.
#include "sinew/air/fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "sinew/actuator/braid.h"
#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::fault_test {
namespace {

using What = AirFault::What;

Motion at_rest(double) { return still_at(3.15 * inch); }

TEST(FaultSchedule, WhatEndsEndsBeforeWhatBegins) {
  const std::vector<AirFault> faults{{.of = 1, .begin = 0.2, .end = 0.3},
                                     {.of = 2, .begin = 0.1, .end = 0.2},
                                     {.of = 3, .begin = 0.2}};
  const FaultSchedule schedule(faults);
  ActingFaults now;
  std::vector<int> told;
  EXPECT_EQ(schedule.next(now), 0.1);
  schedule.advance(0.25, now,
                   [&](const AirFault& f, bool begins) { told.push_back(begins ? f.of : -f.of); });
  EXPECT_EQ(told, (std::vector{2, -2, 1, 3}));
  EXPECT_EQ(schedule.next(now), 0.3);
  EXPECT_EQ(now.acting, 0b101u);
  schedule.advance(10, now, [](const AirFault&, bool) {});
  EXPECT_EQ(schedule.next(now), std::numeric_limits<double>::infinity());
  EXPECT_EQ(now.acting, 0b100u);  // to the end
}

TEST(FaultSchedule, RefusesWhatItCannotHold) {
  EXPECT_THROW(FaultSchedule(std::vector<AirFault>(65)), std::invalid_argument);
  EXPECT_THROW(FaultSchedule(std::vector<AirFault>{{.begin = 1, .end = 1}}), std::invalid_argument);
}

// Returns faults of each kind on any part, at any time, temporary or permanent, for the network of
// everything(). Faults of one part may follow each other or coincide.
std::vector<AirFault> any_faults(std::mt19937& random) {
  std::uniform_real_distribution<double> begins(0, 0.5), lasts(1e-3, 0.2);
  const auto pick = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  const int sealing[] = {0, 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15};  // 8 is a regulator
  std::vector<AirFault> out;
  for (int k = 0; k < 24; ++k) {
    AirFault f{.what = static_cast<What>(k % 6), .begin = begins(random)};
    f.end = k % 5 == 4 ? f.end : f.begin + lasts(random);
    f.of = f.of_valve() ? sealing[pick(13)] : f.what == What::supply ? 0 : pick(6);
    f.share = f.what == What::seat_leak && pick(2) == 0 ? 0.2 : 0.0;
    f.leak = {.area = 1e-8 * (1 + pick(30)), .conductance = 1e-12 * pick(20)};
    f.pressure = (1 + 0.5 * pick(12)) * bar;
    out.push_back(f);
  }
  return out;
}

TEST(Faults, AirIsConservedWhateverBreaks) {
  const gas::Supply tank{.kind = gas::Supply::Kind::tank,
                         .pressure = 6 * bar,
                         .volume = 2e-4,
                         .initial_pressure = 7 * bar};
  const auto motion = [](double t) { return swaying(3.15 * inch, t); };
  std::mt19937 random(3);
  for (const double wall_time : {0.0, 0.2})
    for (const gas::Supply& supply : {tank, gas::Supply{.pressure = 6 * bar}}) {
      const gas::Air air{.polytropic_exponent = 1.1, .wall_time = wall_time};
      const bool has_tank = supply.kind == gas::Supply::Kind::tank;
      Air network(everything(), air, supply, thesis_cylinder(), any_faults(random));
      TestIntegrator test(network, motion, 1.5 * bar);
      const double before = network.total_mass(test.state, motion(0).travel);
      for (int k = 0; k < 300; ++k) {
        test.electrical(static_cast<int>(random() % 16u), random() % 2 == 0);
        test.level(8, test.t, 0.1 * (k % 10));
        const Motion m = motion(test.t);
        test.run_until(test.t + 2e-3,
                       std::min(network.longest_step(), network.longest_step(m, test.valves)));
      }
      const double given = network.supply_state(test.state, test.now).past_tank;
      const double entered = has_tank ? given : test.entered();
      const double after = network.total_mass(test.state, motion(test.t).travel);
      EXPECT_NE(has_tank, given == 0);
      EXPECT_GT(test.left(), 0.1 * before);
      EXPECT_NEAR((after + test.left()) / (before + entered), 1, 1e-12) << wall_time;
    }
}

struct Broken {
  std::vector<Muscle> muscles{bundle(0)};
  gas::Supply supply{.pressure = 6 * bar};
  gas::Air air{.polytropic_exponent = 1};

  Air network(const AirFault& f) const { return {muscles, air, supply, {}, std::vector{f}}; }
};

TEST(Faults, ARupturedMuscleGoesToTheRoomsPressure) {
  const Broken machine;
  const Air network = machine.network({.what = What::hole, .begin = 0.01, .leak = {.area = 1e-4}});
  TestIntegrator test(network, at_rest, 5 * bar);
  test.run_until(0.01 - 1e-9, 1e-3);
  EXPECT_EQ(test.now.leak[0], 0);
  EXPECT_NEAR(test.now.pressure[0], 5 * bar, 1e-6 * bar);
  test.run_until(0.2, 2e-5);
  EXPECT_NEAR(test.now.pressure[0], machine.air.atmosphere, 1);
}

// A rigid chamber, isothermal and choked, empties by gas/leak.h: P = P_0 exp(-t K R T/V), m' = K P.
TEST(Faults, AHoleEmptiesAsItsLawPredicts) {
  const Broken machine;
  const double area = 3e-8, begin = 0.0123456789;
  Air network = machine.network({.what = What::hole, .begin = begin, .leak = {.area = area}});
  TestIntegrator test(network, at_rest, 6 * bar);
  test.run_until(0.1, 1e-3);
  const gas::Air& air = machine.air;
  const double volume = 2 * actuator::volume(machine.muscles[0].actuator.braid, 3.15 * inch) + 4e-6;
  const double k = area * gas::choked_parameter(air.gas_constant) / std::sqrt(air.temperature);
  const double rate = k * air.gas_constant * air.temperature / volume;
  EXPECT_NEAR(test.now.pressure[0] / (6 * bar * std::exp(-rate * (0.1 - begin))), 1, 1e-9);
  EXPECT_LT(test.now.pressure[0], 5.9 * bar);
}

// Commands continue meanwhile, and at its end the valve opens after the delay of an edge there.
TEST(Faults, AnInletThatIsStuckShutLetsNoAirIn) {
  const Broken machine;
  const Air network = machine.network({.what = What::stuck_shut, .begin = 0.01, .end = 0.05});
  TestIntegrator test(network, at_rest, 1.2 * bar);
  test.electrical(0, true);
  test.run_until(0.0099, 1e-4);
  EXPECT_GT(test.now.inflow[0], 0);
  test.run_until(0.0101, 1e-4);
  const double held = test.state.mass[0];
  test.electrical(0, false);
  test.run_until(0.02, 1e-4);
  test.electrical(0, true);
  test.run_until(0.05 + 0.29e-3, 1e-4);
  EXPECT_EQ(test.state.mass[0], held);
  EXPECT_EQ(test.now.inflow[0], 0);
  test.run_until(0.05 + 0.31e-3, 1e-4);
  EXPECT_GT(test.now.inflow[0], 0);
}

TEST(Faults, AValveThatIsStuckOpenShutsAfterItsDelay) {
  const Broken machine;
  const Air network = machine.network({.of = 1, .begin = 0.01, .end = 0.03});
  TestIntegrator test(network, at_rest, 5 * bar);
  test.run_until(0.03 + 0.49e-3, 1e-4);
  EXPECT_GT(test.now.outflow[0], 0);
  test.run_until(0.03 + 0.51e-3, 1e-4);
  EXPECT_EQ(test.now.outflow[0], 0);
}

TEST(Faults, ABlockedHoseKeepsTheMusclesAir) {
  const gas::Hose pipe{.law = gas::Hose::Law::pipe, .length = 0.5, .inner_diameter = 2.5e-3};
  for (const gas::Hose& hose : {gas::Hose{}, pipe, iso_hose(3e-9, 3e-6)}) {
    Broken machine;
    machine.muscles[0].hose = hose;
    const Air network = machine.network({.what = What::blocked, .begin = 0.01, .end = 0.3});
    TestIntegrator test(network, at_rest, 3 * bar);
    test.run_until(0.01, 5e-5);
    const double held = test.state.mass[0];
    for (const int valve : {0, 1}) {
      test.electrical(valve, true);
      test.run_until(test.t + 0.14, 5e-5);
      EXPECT_EQ(test.state.mass[0], held);
    }
    EXPECT_NEAR(test.now.inflow[0], test.now.outflow[0], 1e-9);  // both open: straight through
    EXPECT_GT(test.now.inflow[0], 1e-5);
    test.electrical(1, false);
    test.run_until(0.4, 5e-5);
    EXPECT_GT(test.state.mass[0], 1.5 * held);
  }
}

// The law of a valve holds in both directions: air above the line's pressure flows back into it.
TEST(Faults, AFailedSupplyFillsNoFurtherAndTakesBackWhatIsAbove) {
  const gas::Supply tank{.kind = gas::Supply::Kind::tank,
                         .pressure = 6 * bar,
                         .volume = 1e-3,
                         .initial_pressure = 8 * bar};
  for (const gas::Supply& supply : {gas::Supply{.pressure = 6 * bar}, tank})
    for (const double start : {1.2 * bar, 5 * bar}) {
      Broken machine;
      machine.supply = supply;
      const Air network = machine.network({.what = What::supply, .pressure = 3 * bar});
      TestIntegrator test(network, at_rest, start);
      test.node(0);
      test.electrical(0, true);
      double most = 0;
      for (int k = 1; k <= 100; ++k) {
        test.run_until(0.01 * k, 1e-4);
        most = std::max(most, test.now.pressure[0]);
      }
      EXPECT_EQ(test.now.supply_pressure, 3 * bar);
      EXPECT_NEAR(test.now.pressure[0], 3 * bar, 1e-5 * bar);
      EXPECT_EQ(test.entered() < 0, start > 3 * bar);
      if (start < 3 * bar) {
        EXPECT_LE(most, 3 * bar * (1 + 1e-9));
      }
      if (supply.kind == gas::Supply::Kind::tank) {
        EXPECT_NEAR(test.now.tank_pressure, 8 * bar, 1e-6);
      }
    }
}

TEST(Faults, ASeatLeaksByItsShareOrByALawOfItsOwn) {
  const Broken machine;
  const gas::Air& air = machine.air;
  const auto inflow = [&](const AirFault& f, bool open) {
    const Air network = machine.network(f);
    TestIntegrator test(network, at_rest, 2 * bar);
    test.node(0);
    if (open) test.electrical(0, true);
    test.node(1);
    Air::Evaluation out{};
    test.evaluate(1, test.state, out);
    return out.inflow[0];
  };
  const double whole = gas::mass_flow(machine.muscles[0].inlet.flow, air, 6 * bar, 2 * bar);
  const auto shut = [&](double share, gas::Leak leak) {
    return inflow({.what = What::seat_leak, .share = share, .leak = leak}, false);
  };
  EXPECT_NEAR(shut(0.25, {}) / whole, 0.25, 1e-12);
  EXPECT_NEAR(shut(0, {.area = 2e-8}) / gas::mass_flow({.area = 2e-8}, air, 6 * bar, 2 * bar), 1,
              1e-12);
  EXPECT_NEAR(shut(0, {.conductance = 1e-11}) / (1e-11 * 4 * bar), 1, 1e-12);
  EXPECT_NEAR(inflow({.what = What::seat_leak, .share = 0.25}, true) / whole, 1, 1e-12);
}

// A list in the model changes no bit before its first instant.
TEST(Faults, BeforeItsTimeAFaultIsNone) {
  std::mt19937 random(9);
  std::vector<AirFault> faults = any_faults(random);
  for (AirFault& f : faults) f.begin += 10, f.end += 10;
  Air with(everything(), {}, {.pressure = 6 * bar}, thesis_cylinder(), faults);
  Air without(everything(), {}, {.pressure = 6 * bar}, thesis_cylinder());
  TestIntegrator a(with, at_rest, 1.5 * bar), b(without, at_rest, 1.5 * bar);
  for (int k = 0; k < 40; ++k) {
    const int valve = static_cast<int>(random() % 16u);
    const bool open = random() % 2 == 0;
    for (TestIntegrator* test : {&a, &b}) {
      test->electrical(valve, open);
      test->run_until(test->t + 2e-3, 1e-4);
    }
    for (int i = 0; i < 6; ++i) ASSERT_EQ(a.state.mass[i], b.state.mass[i]) << i;
    for (std::size_t i = 0; i < static_cast<std::size_t>(without.others()); ++i)
      ASSERT_EQ(a.state.other[i], b.state.other[i]) << i;
  }
}

}  // namespace
}  // namespace sinew::air::fault_test
