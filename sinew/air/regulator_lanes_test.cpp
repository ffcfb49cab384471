// The calm step of four muscles behind regulators is RODAS3's step of each.
#include "sinew/air/regulator_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/body.h"
#include "sinew/air/stiff/quick.h"
#include "sinew/air/test_machines.h"
#include "sinew/gas/air.h"

namespace sinew::air::regulator_lanes_test {
namespace {

constexpr double lag = 0.03, step = 1e-3;

// Four muscles and their states: pressures near the outlets' or far from them.
class FourRegulated : public ::testing::Test {
 protected:
  FourRegulated() {
    for (int i = 0; i < lanes; ++i) {
      Muscle m = bundle(0.2 * i);
      m.inlet.kind = gas::Valve::Kind::regulator;
      m.inlet.regulator = {.range = 6 * bar, .time_constant = i == 1 ? 0.0 : lag};
      if (i % 2 == 0)
        m.inlet.flow = {.law = gas::Flow::Law::iso6358,
                        .sonic_conductance = 1e-8,
                        .critical_pressure_ratio = 0.3};
      else
        m.inlet.flow.area = 3e-5;
      muscles_.push_back(m);
    }
  }

  static double volume(const Muscle& m, double length) {
    return m.count * actuator::volume(m.actuator, length) + m.external_volume;
  }

  void draw() {
    std::uniform_real_distribution<double> lengths(2.5 * inch, 3.8 * inch), rates(-0.2, 0.2);
    std::uniform_real_distribution<double> pressures(1.5 * bar, 6 * bar), near(-0.001, 0.001);
    for (std::size_t i = 0; i < lanes; ++i) {
      const bool far = random_() % 8 == 0;
      State& s = state_[i];
      s = {.length = lengths(random_), .rate = rates(random_), .set = pressures(random_)};
      s.outlet = muscles_[i].inlet.regulator.time_constant > 0 && !far
                     ? s.set * (1 + 5 * near(random_))
                     : s.set;
      const double p = far ? pressures(random_) : s.outlet * (1 + near(random_));
      s.mass = gas::density(air_, p) * volume(muscles_[i], s.length);
    }
  }

  // Integrates all through a step; lane i has muscle `of[i]`.
  RegulatorLanes::Outputs ahead(const std::array<std::size_t, lanes>& of) const {
    std::vector<Muscle> muscles;
    std::vector<gas::Valve> valves;
    for (const std::size_t i : of) {
      muscles.push_back(muscles_[i]);
      valves.push_back(muscles_[i].inlet);
    }
    const BraidLanes braids(muscles, air_);
    const RegulatorLanes regulators(braids, valves, air_);
    Lanes<lanes> length, rate, mass, y_ref, inverse_sigma;
    RegulatorLanes::Inputs in{.length = length.of.data(),
                              .rate = rate.of.data(),
                              .mass = mass.of.data(),
                              .y_ref = y_ref.of.data(),
                              .inverse_sigma = inverse_sigma.of.data()};
    for (std::size_t at = 0; at < lanes; ++at) {
      const State& s = state_[of[at]];
      const int k = static_cast<int>(at);
      const double density = s.mass / volume(muscles_[of[at]], s.length);
      length[k] = s.length;
      rate[k] = s.rate;
      mass[k] = s.mass;
      y_ref[k] = braids.exact_y(density);
      inverse_sigma[k] = 1 / density;
      in.set[at] = s.set;
      in.off[at] = s.outlet - s.set;
      in.outlet_y[at] = gas::y_of(air_, s.outlet);
      in.outlet_inverse[at] = 1 / s.outlet;
    }
    RegulatorLanes::Outputs out;
    regulators.integrate(0, step, supply_y_, in, out);
    return out;
  }

  // Integrates muscle i alone, by the direct form of the laws.
  QuickStep<1> alone(std::size_t i) const {
    const State& s = state_[i];
    const Muscle& m = muscles_[i];
    const double v = volume(m, s.length);
    const double grows = m.count * actuator::volume_slope(m.actuator, s.length) * s.rate;
    const gas::FlowConstants flow = gas::flow_constants(m.inlet.flow, air_);
    const double tau = m.inlet.regulator.time_constant, n7 = air_.polytropic_exponent / 7;
    const auto rates = [&](double t, const std::array<double, 1>& x, bool) {
      const double room = v + grows * t;
      const double y = gas::y_of(air_, gas::pressure(air_, x[0] / room));
      const double off = tau > 0 ? (s.outlet - s.set) * std::exp(-t / tau) : 0.0;
      const double p = s.set + off, outlet = gas::y_of(air_, p);
      const double rising = tau > 0 ? -off / tau * outlet / (7 * p) : 0.0;
      const bool cut = outlet > supply_y_;
      const gas::SlopedFlow f = gas::sloped_flow_y(flow, cut ? supply_y_ : outlet, y);
      QuickRates<1> r;
      r.mass[0] = f.flow;
      r.mass_by[0][0] = f.by_b * n7 * y / x[0];
      r.mass_by_time[0] = f.by_a * (cut ? 0 : rising) - f.by_b * n7 * y * grows / room;
      const std::size_t k = f.flow > 0 ? 0 : 1;
      const double sign = f.flow > 0 ? 1 : -1;
      r.passed[k] = sign * r.mass[0];
      r.passed_by[k][0] = sign * r.mass_by[0][0];
      r.passed_by_time[k] = sign * r.mass_by_time[0];
      return r;
    };
    return rodas3_step<1>(rates, 0.0, {s.mass}, step);
  }

  struct State {
    double length = 0, rate = 0, set = 0, outlet = 0, mass = 0;
  };
  const gas::Air air_{.polytropic_exponent = 1.2};
  const double supply_y_ = gas::y_of(air_, 5.5 * bar);
  std::vector<Muscle> muscles_;
  std::array<State, lanes> state_;
  std::mt19937 random_{11};
};

TEST_F(FourRegulated, GoAsEachGoesByTheLawsInWords) {
  int calm = 0, restless = 0, both_ways = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    draw();
    const RegulatorLanes::Outputs out = ahead({0, 1, 2, 3});
    for (std::size_t i = 0; i < lanes; ++i) {
      const QuickStep<1> one = alone(i);
      const double start = state_[i].mass;
      const bool suits = std::abs(one.curvature[0]) < quick::calm_curvature * start &&
                         one.error[0] < quick::muscle_error * start;
      if ((out.calm >> i & 1) == 0) {
        ++restless;
        continue;
      }
      ++calm;
      EXPECT_TRUE(suits) << i;
      EXPECT_NEAR(out.full[i], one.mass[0], 1e-9 * start) << i;
      EXPECT_NEAR(out.half[i], 0.5 * (start + one.mass[0]) + one.curvature[0], 1e-9 * start) << i;
      EXPECT_NEAR(out.in[i], one.passed[0], 1e-9 * start) << i;
      EXPECT_NEAR(out.out[i], one.passed[1], 1e-9 * start) << i;
      EXPECT_NEAR(out.in[i] - out.out[i], out.full[i] - start, 1e-15 * start) << i;
      both_ways += one.passed[0] > 0 && one.passed[1] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(calm, 1000);
  EXPECT_GT(restless, 200);
  EXPECT_GT(both_ways, 20);
}

TEST_F(FourRegulated, HaveTheSameBitsInAnyLane) {
  std::array<std::size_t, lanes> of{0, 1, 2, 3};
  for (int trial = 0; trial < 500; ++trial) {
    draw();
    const RegulatorLanes::Outputs in_order = ahead({0, 1, 2, 3});
    std::shuffle(of.begin(), of.end(), random_);
    of[0] = of[1];  // twice the same, and one of them left out
    const RegulatorLanes::Outputs mixed = ahead(of);
    for (std::size_t at = 0; at < lanes; ++at) {
      const std::size_t i = of[at];
      ASSERT_EQ(mixed.calm >> at & 1, in_order.calm >> i & 1);
      if ((mixed.calm >> at & 1) == 0) continue;
      EXPECT_EQ(mixed.half[at], in_order.half[i]);
      EXPECT_EQ(mixed.full[at], in_order.full[i]);
      EXPECT_EQ(mixed.in[at], in_order.in[i]);
      EXPECT_EQ(mixed.out[at], in_order.out[i]);
    }
    of = {0, 1, 2, 3};
  }
}

}  // namespace
}  // namespace sinew::air::regulator_lanes_test
