// The bank is the actuator's and the gas's laws in lanes: the same numbers, whatever stands beside.
#include "sinew/muscle/bank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/muscle/test_bank.h"
#include "sinew/muscle/test_machines.h"

namespace sinew::muscle {
namespace {

struct Machine {
  gas::Air air{.polytropic_exponent = 1.1};
  gas::Supply supply;
};

TEST(Bank, TensionAndPressureAreTheLawsInWords) {
  const Machine k;
  std::vector<Muscle> muscles;
  for (int i = 0; i < 6; ++i) muscles.push_back(bundle(0.15 * i));
  BankByHand bank(muscles, k.air, k.supply);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> lengths(2.3 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0);
  for (int trial = 0; trial < 2000; ++trial) {
    Lanes length{}, rate{}, mass{};
    for (int i = 0; i < capacity; ++i) {
      const int m = i < 6 ? i : 5;
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = densities(random) * bank.volume(m, length[i]);
    }
    Pull pull;
    bank.evaluate(0, length, rate, mass, pull);
    bank.follow(pull.drift);  // from now on by the series about this state
    bank.evaluate(0, length, rate, mass, pull);
    for (int i = 0; i < 6; ++i) {
      const Muscle& m = muscles[static_cast<std::size_t>(i)];
      const double p = gas::pressure(k.air, mass[i] / bank.volume(i, length[i]));
      EXPECT_NEAR(pull.pressure[i], p, 1e-9 * p);
      const double gauge = p - k.air.atmosphere;
      const double f =
          m.count * actuator::tension(m.actuator, length[i], rate[i], gauge, k.air.atmosphere);
      EXPECT_NEAR(pull.tension[i], std::max(f, 0.0), 1e-6 * (1 + std::abs(f)));
      const double mesh =
          m.count * actuator::coulomb_bound(m.actuator, length[i], gauge, k.air.atmosphere, 0);
      EXPECT_NEAR(pull.mesh[i], mesh, 1e-8 * (1 + mesh));
    }
  }
}

// Every switch of the losses and of the short end, against the laws in words.
TEST(Bank, SwitchesAreTheLawsInWords) {
  using Scale = actuator::Loss::Scale;
  using Law = actuator::ShortEnd::Law;
  const Machine k;
  std::vector<Muscle> muscles;
  for (const Scale scale : {Scale::secant, Scale::sealed, Scale::constant})
    for (const Law law : {Law::stop, Law::zero}) {
      Muscle m = bundle(0.3);
      m.actuator.loss.coulomb_scale = scale;
      m.actuator.loss.coulomb_stiffness = 5000;
      m.actuator.loss.stick = law == Law::stop;
      m.actuator.short_end.law = law;
      muscles.push_back(m);
    }
  BankByHand bank(muscles, k.air, k.supply);

  std::mt19937 random(4);
  std::uniform_real_distribution<double> lengths(2.2 * inch, 4.0 * inch), rates(-0.3, 0.3);
  for (int trial = 0; trial < 1000; ++trial) {
    Lanes length{}, rate{}, mass{};
    for (int i = 0; i < capacity; ++i) {
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = 4.0 * bank.volume(std::min(i, 5), length[i]);
    }
    Pull pull;
    bank.evaluate(0, length, rate, mass, pull);
    for (int i = 0; i < 6; ++i) {
      const Muscle& m = muscles[static_cast<std::size_t>(i)];
      const actuator::Actuator& a = m.actuator;
      const double p = pull.pressure[i], gauge = p - k.air.atmosphere;
      const double sealed =
          actuator::stiffness_sealed(a, length[i], p, k.air.atmosphere, m.external_volume / m.count,
                                     k.air.polytropic_exponent);
      const double bound =
          m.count * actuator::coulomb_bound(a, length[i], gauge, k.air.atmosphere, sealed);
      const double smooth = std::max(
          m.count * actuator::tension(a, length[i], rate[i], gauge, k.air.atmosphere), 0.0);
      // [33] as printed adds sign(v) times the bound and leaves nothing to stick.
      const double printed = std::max(smooth + (rate[i] >= 0 ? bound : -bound), 0.0);
      EXPECT_NEAR(pull.tension[i], a.loss.stick ? smooth : printed, 1e-6 * (1 + smooth)) << i;
      EXPECT_NEAR(pull.mesh[i], a.loss.stick ? bound : 0.0, 1e-7 * (1 + bound)) << i;
    }
  }
}

TEST(Bank, PressureBySeriesIsThePower) {
  // design.md: 8e-11 relative within |x| <= 0.05, for any exponent.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> drift(-0.05, 0.05), exponents(1.0, 1.4);
  for (int trial = 0; trial < 2000; ++trial) {
    const gas::Air air{.polytropic_exponent = exponents(random)};
    const std::vector<Muscle> one{bundle(0)};
    BankByHand bank(one, air, {});
    Lanes length{}, rate{}, mass{};
    for (int i = 0; i < lanes; ++i)
      length[i] = 3.1 * inch, mass[i] = 4.0 * bank.volume(0, length[i]);
    Pull pull;
    bank.evaluate(0, length, rate, mass, pull);
    bank.follow(pull.drift);
    const double x = drift(random);
    for (int i = 0; i < lanes; ++i) mass[i] *= 1 + x;
    bank.evaluate(0, length, rate, mass, pull);
    const double exact = gas::pressure(air, mass[0] / bank.volume(0, length[0]));
    EXPECT_NEAR(pull.pressure[0] / exact, 1.0, 2e-10);
  }
}

TEST(Bank, AMuscleHasTheSameBitsAloneAndAmongOthers) {
  const Machine k;
  std::vector<Muscle> many;
  for (int i = 0; i < capacity; ++i) many.push_back(bundle(0.1 * i));
  BankByHand together(many, k.air, k.supply);

  std::mt19937 random(3);
  std::uniform_real_distribution<double> lengths(2.3 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0);
  for (int trial = 0; trial < 200; ++trial) {
    Lanes length{}, rate{}, mass{};
    for (int i = 0; i < capacity; ++i) {
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = densities(random) * together.volume(i, length[i]);
    }
    Pull all;
    together.evaluate(0, length, rate, mass, all);
    for (int i = 0; i < capacity; ++i) {
      const std::vector<Muscle> one{many[static_cast<std::size_t>(i)]};
      BankByHand alone(one, k.air, k.supply);
      Lanes l{}, v{}, m{};
      for (int j = 0; j < lanes; ++j) l[j] = length[i], v[j] = rate[i], m[j] = mass[i];
      Pull pull;
      alone.evaluate(0, l, v, m, pull);
      EXPECT_EQ(pull.tension[0], all.tension[i]);
      EXPECT_EQ(pull.pressure[0], all.pressure[i]);
      EXPECT_EQ(pull.mesh[0], all.mesh[i]);
    }
  }
}

// A chamber of constant length: fill, then seal, then vent. Nothing but the mass moves.
TEST(Bank, FlowsFollowTheValvesAndTheirDelays) {
  const Machine k;
  const std::vector<Muscle> one{bundle(0)};
  BankByHand bank(one, k.air, k.supply);
  Lanes length{}, rate{}, mass{};
  for (int i = 0; i < lanes; ++i) {
    length[i] = 3.15 * inch;
    mass[i] = bank.mass_at(0, k.air.atmosphere, length[i]);
  }
  Pull pull;  // of whoever asks, again and again: nothing old may stay in it
  pull.inflow[0] = pull.outflow[0] = 7;
  const auto flows = [&](double t) {
    bank.node(t);
    bank.evaluate(t, length, rate, mass, pull);
    return std::pair{pull.inflow[0], pull.outflow[0]};
  };

  EXPECT_FALSE(bank.any_open());
  EXPECT_EQ(flows(0), std::pair(0.0, 0.0));
  bank.electrical(0, 1e-3, true);
  EXPECT_DOUBLE_EQ(bank.next_change(), 1e-3 + 0.3e-3);
  EXPECT_EQ(flows(1.2e-3).first, 0.0);
  EXPECT_GT(flows(1.4e-3).first, 0.0);
  EXPECT_EQ(flows(1.4e-3).second, 0.0);
  bank.electrical(0, 2e-3, false);
  EXPECT_GT(flows(2.4e-3).first, 0.0);
  EXPECT_EQ(flows(2.6e-3).first, 0.0);

  // Supply into an empty muscle is choked: [42] with [44] above.
  const double choked =
      gas::mass_flow(5e-7, k.supply.pressure, k.air.temperature, k.air.atmosphere, k.air);
  bank.electrical(0, 3e-3, true);
  EXPECT_NEAR(flows(4e-3).first, choked, 1e-12 * choked);
}

TEST(Bank, AThreeWayValveIsNeverSealed) {
  const Machine k;
  std::vector<Muscle> one{bundle(0)};
  one[0].inlet.kind = gas::Valve::Kind::three_way;
  one[0].exhaust = {};
  BankByHand bank(one, k.air, k.supply);
  EXPECT_EQ(bank.open_share(0, 0), 0.0);
  EXPECT_EQ(bank.open_share(1, 0), 1.0);
  bank.electrical(0, 0.01, true);
  bank.node(0.0103);
  EXPECT_EQ(bank.open_share(0, 0.02), 1.0);
  EXPECT_EQ(bank.open_share(1, 0.02), 0.0);
}

TEST(Bank, ARampOpensLinearly) {
  const Machine k;
  std::vector<Muscle> one{bundle(0)};
  one[0].inlet.profile = gas::Valve::Profile::ramp;
  one[0].inlet.opening_ramp = 2e-3;
  BankByHand bank(one, k.air, k.supply);
  bank.electrical(0, 0.01, true);
  bank.node(0.0103);
  EXPECT_NEAR(bank.open_share(0, 0.0113), 0.5, 1e-9);
  EXPECT_NEAR(bank.next_change(), 0.0123, 1e-12);
}

TEST(Bank, MoreThanItHoldsIsRefused) {
  const std::vector<Muscle> nine(capacity + 1, bundle(0));
  EXPECT_THROW(Bank(nine, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew::muscle
