// Muscles between valves in lanes have the results of the actuator's and the gas's laws, whatever
// other parts the machine has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::network_lanes_test {
namespace {

// A network with its valves and memory, evaluated at any lengths and masses.
class TestNetwork : public Air {
 public:
  TestNetwork(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply)
      : Air(muscles, air, supply), valves_(valves_at_rest()), memory_(memory_at_rest(1e5, {})) {}

  void electrical(int valve, double t, bool open) {
    command({.valve = {static_cast<std::uint8_t>(valve)}, .open = open}, t, last_, valves_);
  }
  void node(double t) { move_valves(t, last_, valves_); }
  void evaluate_node(const Evaluation& evaluation) { update_memory(evaluation, {}, memory_); }
  void evaluate(double t, const Lanes& length, const Lanes& rate, const Lanes& mass,
                Evaluation& out) {
    State state{};
    state.mass = mass;
    Air::evaluate(t, {length, rate}, state, valves_, memory_, out);
    last_ = out;
  }
  bool any_open() const { return flowing(valves_); }
  double open_share(int valve, double t) const { return Air::open_share(valve, t, valves_); }
  double next_change() const { return valves_.next_change; }

 private:
  Valves valves_;
  Memory memory_;
  Evaluation last_{};
};

struct Machine {
  gas::Air air{.polytropic_exponent = 1.1};
  gas::Supply supply;
};

TEST(AirInLanes, TensionAndPressureAreTheLawsInWords) {
  const Machine k;
  std::vector<Muscle> muscles;
  for (int i = 0; i < 6; ++i) muscles.push_back(bundle(0.15 * i));
  TestNetwork network(muscles, k.air, k.supply);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> lengths(2.3 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0);
  for (int trial = 0; trial < 2000; ++trial) {
    Air::Lanes length{}, rate{}, mass{};
    for (int i = 0; i < 8; ++i) {
      const int m = i < 6 ? i : 5;
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = densities(random) * network.volume(m, length[i]);
    }
    Air::Evaluation pull;
    network.evaluate(0, length, rate, mass, pull);
    network.evaluate_node(pull);  // from here on the series has this state as its base
    network.evaluate(0, length, rate, mass, pull);
    for (int i = 0; i < 6; ++i) {
      const Muscle& m = muscles[static_cast<std::size_t>(i)];
      const double p = gas::pressure(k.air, mass[i] / network.volume(i, length[i]));
      EXPECT_NEAR(pull.pressure[i], p, 1e-9 * p);
      const double gauge = p - k.air.atmosphere;
      const double f = m.count * actuator::clamped_tension(m.actuator, length[i], rate[i], gauge,
                                                           k.air.atmosphere);
      EXPECT_NEAR(pull.tension[i], std::max(f, 0.0), 1e-6 * (1 + std::abs(f)));
      const double friction_bound =
          m.count * actuator::coulomb_bound(m.actuator, length[i], gauge, k.air.atmosphere, 0);
      EXPECT_NEAR(pull.friction_bound[i], friction_bound, 1e-8 * (1 + friction_bound));
    }
  }
}

// Outside the range of the series, in any lane, and a new base of the series there.
TEST(AirInLanes, ATableAnswersAsThePowerDoes) {
  const Machine k;
  std::vector<Muscle> muscles;
  for (int i = 0; i < 5; ++i) muscles.push_back(bundle(0.1 * i));
  TestNetwork power(muscles, k.air, k.supply), table(muscles, k.air, k.supply);
  table.use_power_table();

  std::mt19937 random(6);
  std::uniform_real_distribution<double> lengths(2.3 * inch, 4.0 * inch), densities(0.8, 8.0);
  for (int trial = 0; trial < 1000; ++trial) {
    Air::Lanes length{}, mass{};
    for (int i = 0; i < 5; ++i) {
      length[i] = lengths(random);
      mass[i] = densities(random) * power.volume(i, length[i]);
    }
    Air::Evaluation one, other;
    for (int pass = 0; pass < 2; ++pass) {
      power.evaluate(0, length, {}, mass, one);
      table.evaluate(0, length, {}, mass, other);
      for (int i = 0; i < 5; ++i)  // seven times what y is off
        EXPECT_NEAR(other.pressure[i], one.pressure[i], 2e-14 * one.pressure[i]) << pass;
      if (trial % 10 != 0) continue;
      power.evaluate_node(one);
      table.evaluate_node(other);
    }
  }
}

// Every switch of the losses and of the short end, against the direct form of the laws.
TEST(AirInLanes, SwitchesAreTheLawsInWords) {
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
  TestNetwork network(muscles, k.air, k.supply);

  std::mt19937 random(4);
  std::uniform_real_distribution<double> lengths(2.2 * inch, 4.0 * inch), rates(-0.3, 0.3);
  for (int trial = 0; trial < 1000; ++trial) {
    Air::Lanes length{}, rate{}, mass{};
    for (int i = 0; i < 8; ++i) {
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = 4.0 * network.volume(std::min(i, 5), length[i]);
    }
    Air::Evaluation pull;
    network.evaluate(0, length, rate, mass, pull);
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
          m.count * actuator::clamped_tension(a, length[i], rate[i], gauge, k.air.atmosphere), 0.0);
      // [33] as printed adds sign(v) times the bound and leaves nothing to stick.
      const double printed = std::max(smooth + (rate[i] >= 0 ? bound : -bound), 0.0);
      EXPECT_NEAR(pull.tension[i], a.loss.stick ? smooth : printed, 1e-6 * (1 + smooth)) << i;
      EXPECT_NEAR(pull.friction_bound[i], a.loss.stick ? bound : 0.0, 1e-7 * (1 + bound)) << i;
    }
  }
}

TEST(AirInLanes, PressureBySeriesIsThePower) {
  // design.md: 8e-11 relative within |x| <= 0.05, for any exponent.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> drift(-0.05, 0.05), exponents(1.0, 1.4);
  for (int trial = 0; trial < 2000; ++trial) {
    const gas::Air air{.polytropic_exponent = exponents(random)};
    const std::vector<Muscle> one{bundle(0)};
    TestNetwork network(one, air, {});
    Air::Lanes length{}, rate{}, mass{};
    for (int i = 0; i < lanes; ++i)
      length[i] = 3.1 * inch, mass[i] = 4.0 * network.volume(0, length[i]);
    Air::Evaluation pull;
    network.evaluate(0, length, rate, mass, pull);
    network.evaluate_node(pull);
    const double x = drift(random);
    for (int i = 0; i < lanes; ++i) mass[i] *= 1 + x;
    network.evaluate(0, length, rate, mass, pull);
    const double exact = gas::pressure(air, mass[0] / network.volume(0, length[0]));
    EXPECT_NEAR(pull.pressure[0] / exact, 1.0, 2e-10);
  }
}

TEST(AirInLanes, AMuscleHasTheSameBitsAloneAndAmongOthers) {
  const Machine k;
  std::vector<Muscle> many;
  for (int i = 0; i < 8; ++i) many.push_back(bundle(0.1 * i));
  TestNetwork together(many, k.air, k.supply);

  std::mt19937 random(3);
  std::uniform_real_distribution<double> lengths(2.3 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0);
  for (int trial = 0; trial < 200; ++trial) {
    Air::Lanes length{}, rate{}, mass{};
    for (int i = 0; i < 8; ++i) {
      length[i] = lengths(random);
      rate[i] = rates(random);
      mass[i] = densities(random) * together.volume(i, length[i]);
    }
    Air::Evaluation all;
    together.evaluate(0, length, rate, mass, all);
    for (int i = 0; i < 8; ++i) {
      const std::vector<Muscle> one{many[static_cast<std::size_t>(i)]};
      TestNetwork alone(one, k.air, k.supply);
      Air::Lanes l{}, v{}, m{};
      for (int j = 0; j < lanes; ++j) l[j] = length[i], v[j] = rate[i], m[j] = mass[i];
      Air::Evaluation pull;
      alone.evaluate(0, l, v, m, pull);
      EXPECT_EQ(pull.tension[0], all.tension[i]);
      EXPECT_EQ(pull.pressure[0], all.pressure[i]);
      EXPECT_EQ(pull.friction_bound[0], all.friction_bound[i]);
    }
  }
}

// A chamber of constant length: fill, then seal, then vent. Only the mass changes.
TEST(AirInLanes, FlowsFollowTheValvesAndTheirDelays) {
  const Machine k;
  const std::vector<Muscle> one{bundle(0)};
  TestNetwork network(one, k.air, k.supply);
  Air::Lanes length{}, rate{}, mass{};
  for (int i = 0; i < lanes; ++i) {
    length[i] = 3.15 * inch;
    mass[i] = network.mass_at(0, k.air.atmosphere, length[i]);
  }
  Air::Evaluation pull;  // reused, to show that no old value stays in it
  pull.inflow[0] = pull.outflow[0] = 7;
  const auto flows = [&](double t) {
    network.node(t);
    network.evaluate(t, length, rate, mass, pull);
    return std::pair{pull.inflow[0], pull.outflow[0]};
  };

  EXPECT_FALSE(network.any_open());
  EXPECT_EQ(flows(0), std::pair(0.0, 0.0));
  network.electrical(0, 1e-3, true);
  EXPECT_DOUBLE_EQ(network.next_change(), 1e-3 + 0.3e-3);
  EXPECT_EQ(flows(1.2e-3).first, 0.0);
  EXPECT_GT(flows(1.4e-3).first, 0.0);
  EXPECT_EQ(flows(1.4e-3).second, 0.0);
  network.electrical(0, 2e-3, false);
  EXPECT_GT(flows(2.4e-3).first, 0.0);
  EXPECT_EQ(flows(2.6e-3).first, 0.0);

  // Supply into an empty muscle is choked: [42] with [44] above.
  const double choked =
      gas::mass_flow(5e-7, k.supply.pressure, k.air.temperature, k.air.atmosphere, k.air);
  network.electrical(0, 3e-3, true);
  EXPECT_NEAR(flows(4e-3).first, choked, 1e-12 * choked);
}

TEST(AirInLanes, AThreeWayValveIsNeverSealed) {
  const Machine k;
  std::vector<Muscle> one{bundle(0)};
  one[0].inlet.kind = gas::Valve::Kind::three_way;
  one[0].exhaust = {};
  TestNetwork network(one, k.air, k.supply);
  EXPECT_EQ(network.open_share(0, 0), 0.0);
  EXPECT_EQ(network.open_share(1, 0), 1.0);
  network.electrical(0, 0.01, true);
  network.node(0.0103);
  EXPECT_EQ(network.open_share(0, 0.02), 1.0);
  EXPECT_EQ(network.open_share(1, 0.02), 0.0);
}

TEST(AirInLanes, ARampOpensLinearly) {
  const Machine k;
  std::vector<Muscle> one{bundle(0)};
  one[0].inlet.profile = gas::Valve::Profile::ramp;
  one[0].inlet.opening_ramp = 2e-3;
  TestNetwork network(one, k.air, k.supply);
  network.electrical(0, 0.01, true);
  network.node(0.0103);
  EXPECT_NEAR(network.open_share(0, 0.0113), 0.5, 1e-9);
  EXPECT_NEAR(network.next_change(), 0.0123, 1e-12);
}

TEST(AirNetwork, MoreThanItHoldsIsRefused) {
  const std::vector<Muscle> nine(9, bundle(0));
  EXPECT_THROW(Air(nine, {}, {}), std::invalid_argument);
  EXPECT_NO_THROW(AirNetwork<48>(nine, {}, {}));
}

}  // namespace
}  // namespace sinew::air::network_lanes_test
