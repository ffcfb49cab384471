// With nothing switched on the plumbing says what the bank says; what an option adds obeys its law.
#include "sinew/muscle/plumbing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/muscle/test_bank.h"
#include "sinew/muscle/test_machines.h"

namespace sinew::muscle {
namespace {

// Everything that both can do: bundles, losses, ends, 2-way and 3-way valves, ramps.
std::vector<Muscle> any_muscles(std::mt19937& random) {
  using Scale = actuator::Loss::Scale;
  using Law = actuator::ShortEnd::Law;
  std::vector<Muscle> muscles;
  for (int i = 0; i < capacity; ++i) {
    Muscle m = bundle(0.1 * i);
    m.actuator.loss.coulomb_scale =
        std::array{Scale::secant, Scale::sealed, Scale::constant}[i % 3];
    m.actuator.loss.coulomb_stiffness = 5000;
    m.actuator.loss.stick = i % 4 != 3;
    m.actuator.short_end.law = i % 5 == 4 ? Law::zero : Law::stop;
    if (i % 3 == 1) m.inlet.kind = gas::Valve::Kind::three_way;
    if (random() % 2) {
      m.inlet.profile = gas::Valve::Profile::ramp;
      m.inlet.opening_ramp = m.inlet.closing_ramp = 1e-3;
    }
    muscles.push_back(m);
  }
  return muscles;
}

TEST(Plumbing, PlainMusclesAreTheBanks) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> lengths(2.2 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0), instants(0, 4e-3);
  const gas::Air air{.polytropic_exponent = 1.1};
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<Muscle> muscles = any_muscles(random);
    BankByHand bank(muscles, air, {});
    Plumbing plumbing(muscles, air, {});
    Plumbing::Valves valves = plumbing.valves_at_rest();
    ASSERT_EQ(plumbing.states(), capacity);

    Lanes length{}, rate{}, mass{};
    AirState state = plumbing.initial(air.atmosphere, length, 0), derivative{};
    for (int i = 0; i < capacity; ++i) {
      length[i] = lengths(random);
      rate[i] = rates(random);
      state[i] = mass[i] = densities(random) * bank.volume(i, length[i]);
    }
    for (int valve = 0; valve < 2 * capacity; ++valve)
      if (random() % 2 &&
          (valve % 2 == 0 ||
           muscles[static_cast<std::size_t>(valve / 2)].inlet.kind == gas::Valve::Kind::two_way)) {
        bank.electrical(valve, 0, true);
        plumbing.electrical(valve, 0, true, {}, valves);
      }
    EXPECT_EQ(bank.next_change(), valves.next_change);
    const double t = instants(random);
    bank.node(t);
    plumbing.node(t, {}, valves);
    EXPECT_EQ(bank.next_change(), valves.next_change);

    Pull by_bank{};
    AirPull out{};
    bank.evaluate(t, length, rate, mass, by_bank);
    bank.follow(by_bank.drift);
    bank.evaluate(t, length, rate, mass, by_bank);
    plumbing.evaluate(t, length, rate, 0, 0, state, valves, out, derivative);
    plumbing.remember(out, state);
    plumbing.evaluate(t, length, rate, 0, 0, state, valves, out, derivative);
    for (int i = 0; i < capacity; ++i) {
      EXPECT_NEAR(out.pressure[i] / by_bank.pressure[i], 1, 1e-12);
      EXPECT_NEAR(out.tension[i], by_bank.tension[i], 1e-12 * (1000 + by_bank.tension[i])) << i;
      EXPECT_NEAR(out.mesh[i], by_bank.mesh[i], 1e-12 * (1 + by_bank.mesh[i])) << i;
      if (bank.any_open()) {
        EXPECT_NEAR(out.inflow[i], by_bank.inflow[i], 1e-12 * (1e-3 + by_bank.inflow[i]));
        EXPECT_NEAR(out.outflow[i], by_bank.outflow[i], 1e-12 * (1e-3 + by_bank.outflow[i]));
      }
      EXPECT_EQ(derivative[i], out.inflow[i] - out.outflow[i]);
    }
  }
}

TEST(Plumbing, MoreThanItHoldsIsRefused) {
  const std::vector<Muscle> nine(capacity + 1, bundle(0));
  EXPECT_THROW(Plumbing(nine, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew::muscle
