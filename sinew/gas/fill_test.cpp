// Fill and vent times against closed forms, and against numerical integration elsewhere.

#include "sinew/gas/fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::gas::fill_test {
namespace {

constexpr double volume = 1e-5, supply = 7.9e5;

Flow orifice() { return {.area = 1.6722547200000001e-06, .efficiency = 0.85}; }
Flow iso() {
  return {.law = Flow::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.35};
}

// K in m' = K P_up of the choked valve.
double choked_gain(const Flow& flow, const Air& air) {
  return mass_flow(flow, air, 1e6, 1.0) / 1e6;
}

TEST(Fill, ChokedAtConstantFlow) {
  for (double n : {1.0, 1.2, 1.4}) {
    const Air air{.polytropic_exponent = n};
    for (const Flow& flow : {orifice(), iso()}) {
      const double to = 0.34 * supply;  // choked for both
      const double exact = volume * (density(air, to) - density(air, air.atmosphere)) /
                           (choked_gain(flow, air) * supply);
      EXPECT_NEAR(transfer_time(flow, air, volume, supply, air.atmosphere, to) / exact, 1, 1e-9);
    }
  }
}

TEST(Fill, VentingChokedIsothermalAirIsExponential) {
  const Air air{.polytropic_exponent = 1};
  const double from = 8e5, to = 3e5;
  const double exact = volume / (choked_gain(orifice(), air) * air.gas_constant * air.temperature) *
                       std::log(from / to);
  EXPECT_NEAR(transfer_time(orifice(), air, volume, air.atmosphere, from, to) / exact, 1, 1e-9);
}

TEST(Fill, VentingChokedPolytropicAirInClosedForm) {
  const Air air{.polytropic_exponent = 1.4};
  const double from = 8e5, to = 3e5, power = 1 / 1.4 - 1;
  const double exact =
      volume * density_at_atmosphere(air) / (choked_gain(orifice(), air) * air.atmosphere * 0.4) *
      (std::pow(to / air.atmosphere, power) - std::pow(from / air.atmosphere, power));
  EXPECT_NEAR(transfer_time(orifice(), air, volume, air.atmosphere, from, to) / exact, 1, 1e-9);
}

TEST(Fill, LastPartIsExponential) {
  const Air air{.polytropic_exponent = 1};
  const Flow flow = orifice();
  const double from = supply * (1 - 0.9 * flow.linear_below);
  const double gain = mass_flow(flow, air, supply, from) / (supply - from);
  const double exact = volume / (gain * air.gas_constant * air.temperature) * std::log(1e3);
  EXPECT_NEAR(
      transfer_time(flow, air, volume, supply, from, supply - (supply - from) * 1e-3) / exact, 1,
      1e-9);
}

TEST(Fill, IsTheSumOfItsParts) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> inside(1.02e5, 7.89e5);
  const Air air{.polytropic_exponent = 1.1};
  for (const Flow& flow : {orifice(), iso()}) {
    const double whole = transfer_time(flow, air, volume, supply, 1.01e5, 7.899e5);
    const double back = transfer_time(flow, air, volume, air.atmosphere, 7.899e5, 1.02e5);
    for (int i = 0; i < 50; ++i) {
      const double p = inside(random);
      const double parts = transfer_time(flow, air, volume, supply, 1.01e5, p) +
                           transfer_time(flow, air, volume, supply, p, 7.899e5);
      EXPECT_NEAR(parts / whole, 1, 1e-9);
      const double back_parts = transfer_time(flow, air, volume, air.atmosphere, 7.899e5, p) +
                                transfer_time(flow, air, volume, air.atmosphere, p, 1.02e5);
      EXPECT_NEAR(back_parts / back, 1, 1e-9);
    }
  }
}

// Computes the same by time steps of the mass, RK4.
TEST(Fill, AgreesWithASimulation) {
  const Air air{.polytropic_exponent = 1.3};
  const Flow flow = orifice();
  const double to = 0.95 * supply, h = 1e-6;
  const auto rate = [&](double mass) {
    return mass_flow(flow, air, supply, pressure(air, mass / volume));
  };
  double mass = volume * density(air, air.atmosphere), time = 0;
  const double enough = volume * density(air, to);
  for (;;) {
    const double k1 = rate(mass), k2 = rate(mass + h / 2 * k1), k3 = rate(mass + h / 2 * k2);
    const double step = h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(mass + h * k3));
    if (mass + step > enough) {
      time += h * (enough - mass) / step;
      break;
    }
    mass += step;
    time += h;
  }
  EXPECT_NEAR(transfer_time(flow, air, volume, supply, air.atmosphere, to), time, 1e-6 * time);
}

TEST(Fill, GoesWithVolumeAndAgainstArea) {
  const Air air;
  Flow wide = orifice();
  wide.area *= 4;
  const double one = transfer_time(orifice(), air, volume, supply, 1.1e5, 7e5);
  EXPECT_NEAR(transfer_time(orifice(), air, 3 * volume, supply, 1.1e5, 7e5), 3 * one, 1e-12);
  EXPECT_NEAR(transfer_time(wide, air, volume, supply, 1.1e5, 7e5), one / 4, 1e-12);
}

TEST(Fill, KnowsWhatCannotBe) {
  const Air air;
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(transfer_time(orifice(), air, volume, supply, 1e5, supply), never);
  EXPECT_EQ(transfer_time(orifice(), air, volume, supply, 1e5, 9e5), never);
  EXPECT_EQ(transfer_time(orifice(), air, volume, supply, 3e5, 2e5), never);
  EXPECT_EQ(transfer_time(orifice(), air, volume, air.atmosphere, 3e5, air.atmosphere), never);
  EXPECT_EQ(transfer_time(orifice(), air, volume, air.atmosphere, 2e5, 3e5), never);
  EXPECT_EQ(transfer_time(Flow{}, air, volume, supply, 2e5, 3e5), never);
  EXPECT_EQ(transfer_time(orifice(), air, volume, supply, 2e5, 2e5), 0);
}

TEST(Fill, DoesWithoutALinearPart) {
  Flow flow = orifice();
  flow.linear_below = 0;
  const Air air;
  const double with = transfer_time(orifice(), air, volume, supply, 1.1e5, 0.99 * supply);
  EXPECT_NEAR(transfer_time(flow, air, volume, supply, 1.1e5, 0.99 * supply) / with, 1, 1e-9);
}

}  // namespace
}  // namespace sinew::gas::fill_test
