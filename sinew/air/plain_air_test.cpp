// Air of machines side by side: each has the same bits as alone.
#include "sinew/air/plain_air.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

#include "sinew/air/test_machines.h"

namespace sinew::air::plain_air_test {
namespace {

constexpr int most = 4;
using Network = AirNetwork<most>;

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Machines with different muscles, gas, supply and laws.
Network random_machine(std::mt19937& random, int muscles) {
  std::vector<Muscle> all;
  for (int i = 0; i < muscles; ++i) {
    Muscle m = bundle(between(random, 0, 1));
    m.actuator.loss.stick = random() % 4 != 0;
    if (random() % 3 == 0) m.actuator.loss.coulomb_scale = actuator::Loss::Scale::sealed;
    if (random() % 3 == 0) m.actuator.short_end.law = actuator::ShortEnd::Law::zero;
    for (gas::Valve* v : {&m.inlet, &m.exhaust})
      if (random() % 3 == 0) {
        v->flow.law = gas::Flow::Law::iso6358;
        v->flow.sonic_conductance = 2e-9;
        v->flow.critical_pressure_ratio = 0.4;
      }
    all.push_back(m);
  }
  const gas::Air air{.polytropic_exponent = between(random, 1.0, 1.4)};
  const gas::Supply supply{.pressure = between(random, 5e5, 8e5)};
  return {all, air, supply};
}

// One of them, integrated alone.
struct Alone {
  Network::State state;
  Network::Valves valves;
  Network::Memory memory;
  Network::Evaluation evaluation;
  Network::Ends ends;
  double t = 0;
};

// Returns the ends a time `by` later at constant rates, as a body's stages see them  [s].
template <class Ends>
Ends further(const Ends& ends, double by) {
  Ends out = ends;
  for (int i = 0; i < most; ++i) out.length[i] = ends.length[i] + by * ends.rate[i];
  return out;
}

void step_alone(const Network& network, double h, Alone& a) {
  Network::Evaluation later[3];
  Network::State stage = a.state;
  Network::QuickMasses quick_masses{};
  const Network::Evaluation* evaluations[4] = {&a.evaluation, &later[0], &later[1], &later[2]};
  for (int s = 0; s < 3; ++s) {
    network.move(stage, a.state, s == 2 ? h : 0.5 * h, *evaluations[s], a.valves, quick_masses);
    network.evaluate(a.t, further(a.ends, 1e-4 * (s + 1)), stage, a.valves, a.memory, later[s]);
  }
  network.finish(a.state, h, evaluations, a.valves, quick_masses);
}

template <int W>
struct Together {
  using Air = PlainAir<most, W>;
  typename Air::State state{};
  typename Air::Shares shares{};
  typename Air::Memory memory{};
  typename Air::Evaluation evaluation{};
  typename Air::Ends ends{};
};

template <int W>
void step_together(const PlainAir<most, W>& air, const units::Pack<W>& h, Together<W>& t) {
  typename PlainAir<most, W>::Evaluation later[3];
  typename PlainAir<most, W>::State stage;
  const typename PlainAir<most, W>::Evaluation* evaluations[4] = {&t.evaluation, &later[0],
                                                                  &later[1], &later[2]};
  for (int s = 0; s < 3; ++s) {
    air.move(stage, t.state, s == 2 ? h : 0.5 * h, *evaluations[s], t.shares, {});
    air.evaluate(0, further(t.ends, 1e-4 * (s + 1)), stage, t.shares, t.memory, later[s]);
  }
  air.finish(t.state, h, evaluations, t.shares, {});
}

template <class One, class Packed>
void expect_lane(const char* what, const Packed& packed, int lane, const One& one, int muscles) {
  for (int i = 0; i < muscles; ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(packed[i][lane]), std::bit_cast<std::uint64_t>(one[i]))
        << what << " of muscle " << i << " in lane " << lane << ": " << packed[i][lane] << ", "
        << one[i];
}

template <int W>
void expect_alone(const Together<W>& t, int lane, const Alone& a, int muscles) {
  expect_lane("tension", t.evaluation.tension, lane, a.evaluation.tension, muscles);
  expect_lane("clamped", t.evaluation.clamped, lane, a.evaluation.clamped, muscles);
  expect_lane("pressure", t.evaluation.pressure, lane, a.evaluation.pressure, muscles);
  expect_lane("friction", t.evaluation.friction_bound, lane, a.evaluation.friction_bound, muscles);
  expect_lane("drift", t.evaluation.drift, lane, a.evaluation.drift, muscles);
  expect_lane("inflow", t.evaluation.inflow, lane, a.evaluation.inflow, muscles);
  expect_lane("outflow", t.evaluation.outflow, lane, a.evaluation.outflow, muscles);
  expect_lane("mass", t.state.mass, lane, a.state.mass, muscles);
  expect_lane("in", t.state.in, lane, a.state.in, muscles);
  expect_lane("out", t.state.out, lane, a.state.out, muscles);
  expect_lane("reference", t.memory.y, lane, a.memory.reference.y, muscles);
}

template <int W>
void put(int lane, const Alone& a, Together<W>& t, const PlainAir<most, W>& air) {
  for (int i = 0; i < most; ++i) {
    t.ends.length[i].set(lane, a.ends.length[i]);
    t.ends.rate[i].set(lane, a.ends.rate[i]);
  }
  air.set_shares(lane, a.valves, t.shares);
}

// Muscles are filled, vented, stretched and released at random; each machine has its own steps, or
// none.
template <int W>
void expect_machines_alone(std::mt19937& random, int& open, int& far) {
  const int muscles = 1 + static_cast<int>(random() % most);
  std::vector<Network> networks;
  std::array<const Network*, W> each;
  std::array<Alone, W> alone;
  networks.reserve(W);
  for (std::size_t k = 0; k < W; ++k) {
    each[k] = &networks.emplace_back(random_machine(random, muscles));
    ASSERT_TRUE(each[k]->stays_plain());
    Alone& a = alone[k];
    a.ends = {};
    for (int i = 0; i < most; ++i) a.ends.length[i] = between(random, 2.4, 3.8) * inch;
    a.state = each[k]->initial(between(random, 1.0, 5.0) * bar, a.ends.length, 0);
    a.valves = each[k]->valves_at_rest();
    a.memory = each[k]->memory_at_rest(1e5, a.ends.length);
  }
  const PlainAir<most, W> air(each);
  Together<W> t;
  for (std::size_t k = 0; k < W; ++k)
    for (int i = 0; i < muscles; ++i) {
      t.state.mass[i].set(static_cast<int>(k), alone[k].state.mass[i]);
      t.memory.y[i].set(static_cast<int>(k), alone[k].memory.reference.y[i]);
      t.memory.inverse_sigma[i].set(static_cast<int>(k),
                                    alone[k].memory.reference.inverse_sigma[i]);
    }

  for (int node = 0; node < 120; ++node) {
    units::Pack<W> h = 0;
    units::PackMask<W> goes = h > 0.0;
    for (std::size_t k = 0; k < W; ++k) {
      Alone& a = alone[k];
      const int lane = static_cast<int>(k);
      for (int i = 0; i < muscles; ++i) {
        const double jump = random() % 50 == 0 ? 0.3 : 0.002;
        a.ends.length[i] += between(random, -jump, jump) * inch;
        a.ends.length[i] = std::clamp(a.ends.length[i], 2.3 * inch, 4.0 * inch);
        a.ends.rate[i] = between(random, -0.3, 0.3);
      }
      each[k]->move_valves(a.t, a.evaluation, a.valves);
      each[k]->evaluate(a.t, a.ends, a.state, a.valves, a.memory, a.evaluation);
      put(lane, a, t, air);
      goes.set(lane, random() % 4 != 0);
      for (int i = 0; i < muscles; ++i) {
        open += a.evaluation.inflow[i] != 0 || a.evaluation.outflow[i] != 0;
        far += std::abs(a.evaluation.drift[i]) > gas::PowerSeries::reach;
      }
    }
    air.evaluate(0, t.ends, t.state, t.shares, t.memory, t.evaluation);
    for (int k = 0; k < W; ++k)
      ASSERT_NO_FATAL_FAILURE(expect_alone(t, k, alone[static_cast<std::size_t>(k)], muscles));

    // Lanes that wait neither update their memory nor step.
    const std::array<int, W> failed = air.update_memory(goes, t.evaluation, t.memory);
    for (std::size_t k = 0; k < W; ++k) {
      EXPECT_EQ(failed[k], -1);
      if (!goes[static_cast<int>(k)]) continue;
      Alone& a = alone[k];
      each[k]->update_memory(a.evaluation, a.state, a.memory);
      const double step = between(random, 1e-6, 1e-3);
      h.set(static_cast<int>(k), step);
      step_alone(*each[k], step, a);
      a.t += step;
      const auto valve = static_cast<std::uint8_t>(random() % static_cast<unsigned>(2 * muscles));
      if (random() % 4 == 0)
        each[k]->command({.valve = {valve}, .open = random() % 2 == 0}, a.t, a.evaluation,
                         a.valves);
    }
    step_together(air, h, t);
  }
}

template <int W>
void expect_all_machines_alone() {
  std::mt19937 random(W);
  int open = 0, far = 0;
  for (int trial = 0; trial < 60; ++trial)
    ASSERT_NO_FATAL_FAILURE(expect_machines_alone<W>(random, open, far));
  EXPECT_GT(open, 1000 * W);
  EXPECT_GT(far, 100 * W);
}

TEST(PlainAir, MachinesSideBySideAreThoseAlone) {
  expect_all_machines_alone<2>();
  expect_all_machines_alone<4>();
}

// A chamber without air is reported for the machine that has it, and for no other.
TEST(PlainAir, ANonFiniteDensityIsReported) {
  std::mt19937 random(3);
  const Network a = random_machine(random, 2), b = random_machine(random, 2);
  const PlainAir<most, 2> air({&a, &b});
  Together<2> t;
  for (int i = 0; i < 2; ++i) {
    t.memory.y[i] = t.memory.inverse_sigma[i] = 1;
    t.evaluation.drift[i] = 0;
  }
  t.evaluation.drift[1].set(1, -1.5);
  const auto both = t.evaluation.drift[0] == 0.0;
  EXPECT_EQ(air.update_memory(both, t.evaluation, t.memory), (std::array<int, 2>{-1, 1}));
}

// A machine whose air is not plain cannot be simulated side by side with others.
TEST(PlainAir, OnlyPlainNetworksAreFit) {
  std::vector<Muscle> muscles{bundle(0.1)};
  const gas::Air air;
  const gas::Supply supply;
  EXPECT_TRUE(Network(muscles, air, supply).stays_plain());
  const AirFault fault{.what = AirFault::What::stuck_open, .begin = 1, .end = 2};
  EXPECT_FALSE(Network(muscles, air, supply, {}, std::array{fault}).stays_plain());
  std::vector<Muscle> ramps = muscles, leaks = muscles;
  ramps[0].inlet.profile = gas::Valve::Profile::ramp;
  leaks[0].leak = {.area = 1e-8};
  std::vector<Muscle> wide = muscles;  // integrated ahead, unless the steps are short
  wide[0].exhaust.flow.area = 2e-5;
  EXPECT_FALSE(Network(wide, air, supply).stays_plain());
  EXPECT_TRUE(Network(wide, air, supply, {}, {}, 1e-5).stays_plain());
  EXPECT_FALSE(Network(ramps, air, supply).stays_plain());
  EXPECT_FALSE(Network(leaks, air, supply).stays_plain());
}

}  // namespace
}  // namespace sinew::air::plain_air_test
