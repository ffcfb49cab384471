// Without options the network has the results of the braid lanes; each option follows its law.
#include "sinew/air/network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/air/test_integrator.h"
#include "sinew/air/test_machines.h"

namespace sinew::air::network_test {
namespace {

// Everything that lanes support: bundles, losses, ends, 2-way and 3-way valves, ramps.
std::vector<Muscle> any_muscles(std::mt19937& random) {
  using Scale = actuator::Loss::Scale;
  using Law = actuator::ShortEnd::Law;
  std::vector<Muscle> muscles;
  for (int i = 0; i < 8; ++i) {
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

// Other parts change no bit of muscles between valves; if one of them needs the direct form of its
// law, all use it, with the same results to rounding.
TEST(AirNetwork, MusclesAreTheSameWhateverStandsBeside) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> lengths(2.2 * inch, 4.0 * inch), rates(-0.3, 0.3);
  std::uniform_real_distribution<double> densities(0.8, 8.0), instants(0, 4e-3);
  const gas::Air air{.polytropic_exponent = 1.1};
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Muscle> muscles = any_muscles(random);
    const Air plain(muscles, air, {});
    const Air beside(muscles, air, {}, thesis_cylinder());
    muscles[7].actuator.hysteresis.half_width = 1e-9;  // negligible, but lanes do not support it
    const Air in_words(muscles, air, {});

    Air::Ends ends{};
    Air::State state = beside.initial(air.atmosphere, still_at(3 * inch).length, 0);
    for (int i = 0; i < 8; ++i) {
      ends.length[i] = lengths(random);
      ends.rate[i] = rates(random);
      state.mass[i] = densities(random) * plain.volume(i, ends.length[i]);
    }
    const double t = instants(random);
    const unsigned opened = random();
    const auto evaluated = [&](const Air& network) {
      Air::Valves valves = network.valves_at_rest();
      Air::Memory memory = network.memory_at_rest(air.atmosphere, ends.length);
      Air::Evaluation out{};
      network.evaluate(0, ends, state, valves, memory, out);
      for (int valve = 0; valve < 16; ++valve)
        network.command(
            {.valve = {static_cast<std::uint8_t>(valve)}, .open = (opened >> valve & 1) != 0}, 0,
            out, valves);
      network.move_valves(t, out, valves);
      network.update_memory(out, state, memory);
      network.evaluate(t, ends, state, valves, memory, out);
      return out;
    };
    const Air::Evaluation a = evaluated(plain), b = evaluated(beside), c = evaluated(in_words);
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(a.pressure[i], b.pressure[i]);
      EXPECT_EQ(a.tension[i], b.tension[i]);
      EXPECT_EQ(a.friction_bound[i], b.friction_bound[i]);
      EXPECT_EQ(a.inflow[i], b.inflow[i]);
      EXPECT_EQ(a.outflow[i], b.outflow[i]);
      EXPECT_NEAR(c.pressure[i] / a.pressure[i], 1, 1e-12);
      EXPECT_NEAR(c.tension[i], a.tension[i], 1e-12 * (1000 + a.tension[i])) << i;
      EXPECT_NEAR(c.friction_bound[i], a.friction_bound[i], 1e-12 * (1 + a.friction_bound[i])) << i;
      EXPECT_NEAR(c.inflow[i], a.inflow[i], 1e-12 * (1e-3 + a.inflow[i]));
      EXPECT_NEAR(c.outflow[i], a.outflow[i], 1e-12 * (1e-3 + a.outflow[i]));
    }
  }
}

}  // namespace
}  // namespace sinew::air::network_test
