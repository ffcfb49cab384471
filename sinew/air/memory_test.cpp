// Hysteresis and creep of muscles in a network against their laws.
#include <gtest/gtest.h>

#include <cmath>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::memory_test {
namespace {

Motion still(double length) { return still_at(length); }
Motion at_rest(double) { return still(3.2 * inch); }

Muscle plain_bundle() {
  Muscle m = bundle(0);
  m.inlet.profile = m.exhaust.profile = gas::Valve::Profile::ideal;
  m.inlet.opening_delay = m.inlet.closing_delay = 0;
  m.exhaust.opening_delay = m.exhaust.closing_delay = 0;
  return m;
}

double static_tension(const Muscle& m, double length, double gauge) {
  return m.count * actuator::clamped_tension(m.actuator, length, 0, gauge, gas::Air{}.atmosphere);
}

TEST(Memory, IsNothingThatLanesHold) {
  Muscle m = plain_bundle();
  m.actuator.hysteresis.volume_pressure = 5 * bar;  // without a width it has no effect
  EXPECT_TRUE(lanes_support(m));
  m.actuator.hysteresis.half_width = 1;
  EXPECT_FALSE(lanes_support(m));
  m = plain_bundle();
  m.actuator.creep = {.share = {0, 0.01}, .time = {0, 3}};
  EXPECT_FALSE(lanes_support(m));
}

// After a long rest a muscle starts without friction and with its creep complete.
TEST(Memory, StartsAtRest) {
  Muscle m = plain_bundle();
  m.actuator.hysteresis = {.half_width = 0.05 * bar, .volume_pressure = 10 * bar};
  m.actuator.creep = {.share = {0.02, 0.03}, .time = {0.5, 5}};
  Air network(std::vector{m}, {}, {});
  EXPECT_EQ(network.others(), 2);
  const TestIntegrator test(network, at_rest, 4 * bar);
  const double gauge = 4 * bar - network.atmosphere();
  EXPECT_NEAR(test.now.tension[0] / (1.05 * static_tension(m, 3.2 * inch, gauge)), 1, 1e-9);
}

// Fill and vent at one length: each tension is the static one at the pressure w below and above.
TEST(Memory, FillAndVentLoop) {
  Muscle m = plain_bundle();
  const double w = 0.06 * bar;
  m.actuator.hysteresis.half_width = w;
  Air network(std::vector{m}, {}, {});
  TestIntegrator test(network, at_rest, network.atmosphere());
  const auto expect_off = [&](double off) {
    const double gauge = test.now.pressure[0] - network.atmosphere();
    EXPECT_NEAR(test.now.tension[0], static_tension(m, 3.2 * inch, gauge + off), 1e-6);
  };
  test.electrical(0, true);
  test.run_until(0.03, 1e-3);
  ASSERT_GT(test.now.pressure[0], 3 * bar);
  expect_off(-w);
  test.electrical(0, false);
  test.electrical(1, true);
  test.run_until(0.035, 1e-4);
  ASSERT_GT(test.now.pressure[0], 1.5 * bar);
  expect_off(w);
}

// Every state's rate is set, whatever value was there before.
TEST(Memory, RatesAreAllSet) {
  Muscle m = plain_bundle();
  m.actuator.hysteresis = {.half_width = 0.05 * bar};
  m.actuator.creep = {.share = {0.02, 0.03}, .time = {0.5, 5}};
  Air network(std::vector{m}, {}, {});
  const Motion at = still(3.2 * inch);
  const Air::State state = network.initial(4 * bar, at.length, 0);
  Air::Evaluation out{};
  out.rate.fill(1e9);
  network.evaluate(0, at, state, network.valves_at_rest(),
                   network.memory_at_rest(4 * bar, at.length), out);
  for (int i = 0; i < network.others(); ++i)
    EXPECT_EQ(out.rate[static_cast<std::size_t>(i)], 0) << i;
}

// Nodes do not matter: the memory depends only on the reversals of the pressure.
TEST(Memory, TheStepDoesNotMatterToThePlay) {
  Muscle m = plain_bundle();
  m.actuator.hysteresis = {.half_width = 0.05 * bar, .width_per_pressure = 0.01};
  double last[2] = {};
  for (int fine = 0; fine < 2; ++fine) {
    Air network(std::vector{m}, {}, {});
    TestIntegrator test(network, at_rest, 1.5 * bar);
    for (int k = 0; k < 6; ++k) {
      const int valve = k % 2;
      test.electrical(valve, true);
      test.run_until(test.t + (valve == 0 ? 0.008 : 0.0015), fine ? 1e-5 : 5e-4);
      test.electrical(valve, false);
      test.run_until(test.t + 0.01, fine ? 1e-4 : 2e-3);
    }
    last[fine] = test.now.tension[0];
  }
  EXPECT_NEAR(last[0] / last[1], 1, 1e-6);
}

// Constant pressure: the last part of the tension follows exponentially; air and valves are
// unaffected.
TEST(Memory, CreepIsExponential) {
  Muscle m = plain_bundle();
  m.actuator.effectiveness = {.c0 = 0.9};
  m.actuator.creep = {.share = {0.05, 0}, .time = {0.4, 0}};
  Muscle without = m;
  without.actuator.creep = {};
  Air network(std::vector{m}, {}, {});
  Air dry(std::vector{without}, {}, {});
  TestIntegrator test(network, at_rest, network.atmosphere()),
      quick(dry, at_rest, dry.atmosphere());
  for (TestIntegrator* h : {&test, &quick}) {
    h->electrical(0, true);
    h->run_until(0.01, 5e-4);
    h->electrical(0, false);
  }
  // One by a power, the other in lanes by its series.
  EXPECT_NEAR(test.now.pressure[0] / quick.now.pressure[0], 1, 1e-11);
  const double start = quick.now.tension[0];
  const double gap = 1.05 * start - test.now.tension[0];
  ASSERT_GT(gap, 0.045 * start);
  for (const double t : {0.2, 0.4, 0.8, 4.0}) {
    test.run_until(0.01 + t, 1e-2);
    EXPECT_NEAR(1.05 * start - test.now.tension[0], gap * std::exp(-t / 0.4), 1e-7 * start);
  }
}

// The longest step respects an element that is quicker than the steps.
TEST(Memory, QuickCreepShortensTheStep) {
  Muscle m = plain_bundle();
  m.actuator.creep = {.share = {0.05, 0.01}, .time = {10, 1e-4}};
  Air network(std::vector{m}, {}, {});
  EXPECT_LT(network.longest_step(), 2.6e-4);
  EXPECT_TRUE(network.flowing(network.valves_at_rest()));
}

// The work of a bundle over a cycle of its length at nearly constant pressure (a large vessel),
// with the friction of pressure turned by length, is a loss near 2 w DV.
TEST(Memory, HysteresisTakesWork) {
  Muscle m = plain_bundle();
  m.actuator.loss = {};
  m.external_volume = 1;
  const double w = 0.1 * bar;
  m.actuator.hysteresis = {.half_width = w, .volume_pressure = 400 * bar};
  const auto motion = [](double t) {
    Motion s = still((3.2 - 0.5 * std::cos(2 * M_PI * t)) * inch);
    for (int i = 0; i < 8; ++i) s.rate[i] = M_PI * std::sin(2 * M_PI * t) * inch;
    return s;
  };
  Air network(std::vector{m}, {}, {});
  TestIntegrator test(network, motion, 4 * bar);
  test.run_until(1, 1e-3);
  double taken = 0;
  for (int k = 0; k < 2000; ++k) {
    const double before = test.now.tension[0], l = motion(test.t).length[0];
    test.run_until(test.t + 5e-4, 5e-4);
    taken += 0.5 * (before + test.now.tension[0]) * (motion(test.t).length[0] - l);
  }
  const double dv = m.count * (actuator::volume(m.actuator.braid, 2.7 * inch) -
                               actuator::volume(m.actuator.braid, 3.7 * inch));
  // The friction is w in pressure, of which Eff acts.
  const double eff = actuator::effectiveness(m.actuator.effectiveness, 4 * bar - 101325, 101325) +
                     (4 * bar - 101325) * (m.actuator.effectiveness.c1 +
                                           2 * m.actuator.effectiveness.c2 * (4 * bar - 101325));
  EXPECT_NEAR(taken / (2 * w * dv * eff), 1, 0.03);
}

}  // namespace
}  // namespace sinew::air::memory_test
