// The figures of a valve are consistent with its law and with each other.
#include "sinew/gas/valve_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/gas/orifice.h"

namespace sinew::gas::valve_flow_test {
namespace {

constexpr int trials = 500;

struct Draw {
  std::mt19937_64 random{7};
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Flow flow() {
    if (between(0, 1) < 0.5) return {.area = between(1e-7, 1e-5), .efficiency = between(0.5, 1)};
    return {.law = Flow::Law::iso6358,
            .sonic_conductance = between(1e-9, 1e-7),
            .critical_pressure_ratio = between(0.1, 0.6)};
  }
};

TEST(ValveFlow, SwappedPortsTurnTheFlowAroundAndNothingElse) {
  Draw draw;
  const Air air;
  for (int i = 0; i < trials; ++i) {
    const Flow flow = draw.flow();
    const double a = draw.between(5e4, 1e6), b = draw.between(5e4, 1e6);
    const ValveFlow there = flow_through(flow, air, a, b), back = flow_through(flow, air, b, a);
    EXPECT_EQ(there.mass_flow, -back.mass_flow);
    EXPECT_EQ(there.mass_flow > 0, a > b);
    EXPECT_EQ(there.ratio, back.ratio);
    EXPECT_EQ(there.choked(), back.choked());
  }
}

TEST(ValveFlow, WhatAnAreaEqualsAsAConductanceFlowsTheSameWhenChoked) {
  Draw draw;
  const Air air;
  for (int i = 0; i < trials; ++i) {
    const Flow flow = draw.flow();
    const double up = draw.between(4e5, 1e6);
    const ValveFlow told = flow_through(flow, air, up, 0.05 * up);
    ASSERT_TRUE(told.choked());
    const Flow as_area{.area = told.area};
    const Flow as_conductance{.law = Flow::Law::iso6358,
                              .sonic_conductance = told.sonic_conductance,
                              .critical_pressure_ratio = 0.3};
    for (const Flow& other : {as_area, as_conductance})
      EXPECT_NEAR(mass_flow(other, air, up, 0.05 * up), told.mass_flow, 1e-12 * told.mass_flow);
  }
}

TEST(ValveFlow, TheLinearPartIsBelowTheLawItselfAndReportsIt) {
  Draw draw;
  const Air air;
  int linear = 0;
  for (int i = 0; i < trials; ++i) {
    const Flow flow = draw.flow();
    const double up = draw.between(2e5, 1e6), down = up * (1 - draw.between(1e-6, 4e-3));
    const ValveFlow told = flow_through(flow, air, up, down);
    linear += told.linear;
    if (told.linear) {
      EXPECT_LT(told.mass_flow, told.law_flow);
    } else {
      EXPECT_EQ(told.mass_flow, told.law_flow);
    }
  }
  EXPECT_GT(linear, trials / 20);
  EXPECT_FALSE(flow_through(Flow{.area = 1e-6}, air, 2e5, 2e5).linear);
}

TEST(Transfers, TakeLongerForMoreOfTheWayAndInProportionToTheVolume) {
  Draw draw;
  const Air air;
  for (int i = 0; i < trials / 10; ++i) {
    const Flow flow = draw.flow();
    const ValveFlow f = flow_through(flow, air, draw.between(3e5, 9e5), draw.between(9e4, 2e5));
    const std::vector<Transfer> one = transfers(flow, air, 1e-5, f, Exchange::polytrope);
    const std::vector<Transfer> two = transfers(flow, air, 2e-5, f, Exchange::polytrope);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_NEAR(two[k].fill, 2 * one[k].fill, 1e-9 * two[k].fill);
      EXPECT_NEAR(two[k].vent, 2 * one[k].vent, 1e-9 * two[k].vent);
      if (k == 0) continue;
      EXPECT_GT(one[k].share, one[k - 1].share);
      EXPECT_GT(one[k].fill, one[k - 1].fill);
      EXPECT_GT(one[k].vent, one[k - 1].vent);
    }
  }
}

// Walls that pass some heat are between the two limits, up to some percent, and tend to either.
TEST(Transfers, WallsLieBetweenTheirLimits) {
  Draw draw;
  for (int i = 0; i < 8; ++i) {
    const Flow flow = draw.flow();
    Air air;
    const double up = draw.between(3e5, 9e5), down = draw.between(9e4, 2e5);
    const ValveFlow f = flow_through(flow, air, up, down);
    const auto times = [&](Exchange exchange) { return transfers(flow, air, 1e-5, f, exchange); };
    const auto quick = times(Exchange::adiabatic), slow = times(Exchange::isothermal);
    for (const double share : {0.01, 0.3, 1e3}) {
      air.wall_time = share * slow.back().fill;
      const auto walls = times(Exchange::walls);
      for (std::size_t k = 0; k < walls.size(); ++k) {
        EXPECT_GT(walls[k].fill, (1 - 1e-4) * quick[k].fill);
        EXPECT_LT(walls[k].fill, 1.08 * slow[k].fill);  // cooling continues
        if (share < 1) continue;
        EXPECT_NEAR(walls[k].fill, quick[k].fill, 5e-3 * quick[k].fill);
        EXPECT_NEAR(walls[k].vent, quick[k].vent, 5e-3 * quick[k].vent);
      }
      if (share < 0.1) {
        EXPECT_NEAR(walls[2].fill, slow[2].fill, 2e-2 * slow[2].fill);
        EXPECT_NEAR(walls[2].vent, slow[2].vent, 2e-2 * slow[2].vent);
      }
    }
    // A rigid chamber fills 1.4 times as quickly if no heat leaves it.
    for (std::size_t k = 0; k < slow.size(); ++k)
      EXPECT_NEAR(slow[k].fill, 1.4 * quick[k].fill, 1e-9 * slow[k].fill);
  }
}

}  // namespace
}  // namespace sinew::gas::valve_flow_test
