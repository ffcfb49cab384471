// Air in a chamber: [38]-[40] integrated over time give the closed form that the code uses.

#include "sinew/gas/air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::gas::air_test {
namespace {

TEST(Air, DensityIsTheInverseOfPressure) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> pressures(5e4, 9e5), exponents(1, 1.4);
  for (int i = 0; i < 1000; ++i) {
    const Air air{.polytropic_exponent = exponents(random)};
    const double p = pressures(random);
    EXPECT_NEAR(pressure(air, density(air, p)) / p, 1, 4e-15);
  }
}

TEST(Air, AtTheAtmosphereIsIdealGas) {
  const Air air;
  const double rho = density_at_atmosphere(air);
  EXPECT_DOUBLE_EQ(rho * air.gas_constant * air.temperature, air.atmosphere);
  EXPECT_NEAR(pressure(air, rho), air.atmosphere, 1e-9);
}

TEST(Air, IsothermalPressureIsProportionalToDensity) {
  const Air air{.polytropic_exponent = 1};
  EXPECT_NEAR(pressure(air, 5 * density_at_atmosphere(air)), 5 * air.atmosphere, 1e-8);
}

// [40], dP/dt = n P (m'/m - V'/V), through a chamber that fills and moves: P (V/m)^n stays.
TEST(Air, RateOfPressureIntegratesToTheClosedForm) {
  for (double n : {1.0, 1.089, 1.4}) {
    const Air air{.polytropic_exponent = n};
    const auto mass = [](double t) { return 1e-5 * (1 + 0.5 * t + 0.2 * std::sin(9 * t)); };
    const auto mass_rate = [](double t) { return 1e-5 * (0.5 + 1.8 * std::cos(9 * t)); };
    const auto volume = [](double t) { return 8e-6 * (1 + 0.3 * std::sin(5 * t)); };
    const auto volume_rate = [](double t) { return 8e-6 * 1.5 * std::cos(5 * t); };
    const auto rate = [&](double t, double p) {
      return n * p * (mass_rate(t) / mass(t) - volume_rate(t) / volume(t));
    };

    double p = pressure(air, mass(0) / volume(0));
    const double h = 1e-3;
    for (int i = 0; i < 1000; ++i) {  // RK4
      const double t = i * h;
      const double k1 = rate(t, p), k2 = rate(t + h / 2, p + h / 2 * k1);
      const double k3 = rate(t + h / 2, p + h / 2 * k2), k4 = rate(t + h, p + h * k3);
      p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    EXPECT_NEAR(p / pressure(air, mass(1) / volume(1)), 1, 1e-9);
  }
}

TEST(Air, ScalingAllPressuresLeavesTheLaw) {
  const Air air, thrice{.atmosphere = 3 * Air{}.atmosphere};
  const double rho = 4.2;
  EXPECT_NEAR(pressure(thrice, 3 * rho), 3 * pressure(air, rho), 1e-8);
}

}  // namespace
}  // namespace sinew::gas::air_test
