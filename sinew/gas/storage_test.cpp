// Laws of a store of air: closed forms, limits, and emptying integrated with warm walls.

#include "sinew/gas/storage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/gas/heat.h"

namespace sinew::gas::storage_test {
namespace {

const Air air;
constexpr double litre = 1e-3, bar = 1e5;

TEST(Storage, CompressibilityMeetsItsTableAndTheIdealGas) {
  for (const auto& row : compressibility_at_300_k) {
    if (row.pressure > highest_stored_pressure) continue;
    EXPECT_EQ(compressibility(row.pressure), row.z);
  }
  EXPECT_EQ(compressibility(0), 1);
  EXPECT_NEAR(compressibility(7 * bar), 1, 0.003);
  EXPECT_TRUE(std::isnan(compressibility(321 * bar)));
  EXPECT_TRUE(std::isnan(compressibility(-1)));
}

// A bottle of 48 in3 at 3000 psi has 161 l of free air by the ideal gas, 3.5 % less by its table.
TEST(Storage, ABottleHoldsLessThanAnIdealGas) {
  const double volume = 0.787 * litre, pressure = 206.8 * bar + air.atmosphere;
  const double free = stored_mass(air, volume, pressure) / density_at_atmosphere(air);
  EXPECT_NEAR(free, 0.161 / 1.037, 0.001);
}

// The work of an isothermal expansion against the room, in small steps.
TEST(Storage, ExergyIsTheWorkOfAnExpansionAtTheRoomsTemperature) {
  for (const double high : {8 * bar, 60 * bar, 207 * bar, 319 * bar}) {
    const double mass = stored_mass(air, litre, high);
    const auto volume = [&](double p) {
      return mass * compressibility(p) * air.gas_constant * air.temperature / p;
    };
    double work = 0;
    const int steps = 200'000;
    for (int i = 0; i < steps; ++i) {
      const auto at = [&](int k) {
        return high * std::pow(air.atmosphere / high, static_cast<double>(k) / steps);
      };
      work += (0.5 * (at(i) + at(i + 1)) - air.atmosphere) * (volume(at(i + 1)) - volume(at(i)));
    }
    EXPECT_NEAR(stored_exergy(air, litre, high) / work, 1, 1e-6) << high;
  }
}

TEST(Storage, ExergyOfLowPressuresIsThatOfTheIdealGas) {
  const double p = 7 * bar, x = p / air.atmosphere;
  EXPECT_NEAR(stored_exergy(air, litre, p) / (p * litre * (std::log(x) - 1 + 1 / x)), 1, 0.005);
  EXPECT_EQ(stored_exergy(air, litre, air.atmosphere), 0);
}

// A store that loses a little air at the room's temperature loses the exergy of that air's flow.
TEST(Storage, ExergyOfAStoreLeavesWithItsAir) {
  for (const double p : {2 * bar, 30 * bar, 130 * bar, 305 * bar}) {
    const double lower = p * (1 - 1e-5);
    const double mass = stored_mass(air, litre, p) - stored_mass(air, litre, lower);
    const double exergy = stored_exergy(air, litre, p) - stored_exergy(air, litre, lower);
    EXPECT_NEAR(exergy / (mass * stream_exergy(air, p)), 1, 1e-4) << p;
  }
  EXPECT_NEAR(stream_exergy(air, 7 * bar),
              air.gas_constant * air.temperature * std::log(7 * bar / air.atmosphere),
              0.003 * stream_exergy(air, 7 * bar));
}

TEST(Storage, WarmWallsYieldMore) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> high(2, 320), share(0.05, 0.999);
  for (int i = 0; i < 1000; ++i) {
    const double from = high(random) * bar, to = from * share(random);
    const AirLeft warm = left_at_room_temperature(air, litre, to),
                  cold = left_without_heat(air, litre, from, to);
    EXPECT_GT(cold.mass, warm.mass) << from << " to " << to;
    EXPECT_LT(cold.mass, stored_mass(air, litre, from));
    EXPECT_LT(cold.temperature, air.temperature);
  }
}

// Energy balance of the limit without heat: what leaves carries its enthalpy away.
TEST(Storage, WithoutHeatTheEnthalpyThatLeavesIsTheEnergyLost) {
  const double from = 9 * bar, to = 3 * bar;
  const double first = from * litre / (air.gas_constant * air.temperature);
  const auto temperature = [&](double p) {
    return left_without_heat(air, litre, from, p).temperature;
  };
  const auto mass = [&](double p) {
    return first * left_without_heat(air, litre, from, p).mass / stored_mass(air, litre, from);
  };
  double left = 0;
  const int steps = 20'000;
  for (int i = 0; i < steps; ++i) {
    const double p = from + (to - from) * i / steps, q = from + (to - from) * (i + 1) / steps;
    left +=
        heat_capacity_pressure(air) * 0.5 * (temperature(p) + temperature(q)) * (mass(p) - mass(q));
  }
  const auto energy = [&](double p) {
    return mass(p) * heat_capacity_volume(air) * temperature(p);
  };
  EXPECT_NEAR(left / (energy(from) - energy(to)), 1, 1e-6);
}

// Emptying with walls of any time constant, heat.h, is between the limits: mass and the exergy that
// the line gets. Pressures are low, where heat.h's ideal gas and the table agree.
TEST(Storage, EveryWallIsBetweenTheLimits) {
  const double from = 9 * bar, to = 3 * bar, mass_flow = 1e-4;
  double before = 0;
  for (const double wall_time : {1e-3, 1.0, 10.0, 100.0, 1e5}) {
    const Air room{.wall_time = wall_time};
    double mass = from * litre / (room.gas_constant * room.temperature);
    const double first = mass;
    double energy = energy_at_rest(room, mass);
    const double step = 1e-4;
    while (pressure_of_energy(energy, litre) > to) {
      const double enthalpy = mass_flow * heat_capacity_ratio * energy / mass;  // c_p T = gamma U/m
      energy += step * (heat_flow(room, energy, mass) - enthalpy);
      mass -= step * mass_flow;
    }
    const double warm = first * to / from, cold = first * std::pow(to / from, 1 / 1.4);
    EXPECT_GE(mass, warm * 0.999) << wall_time;
    EXPECT_LE(mass, cold * 1.001) << wall_time;
    EXPECT_GT(mass, before);
    before = mass;
    const double used = (first - mass) * stream_exergy(room, to);
    EXPECT_LE(used, (first - warm) * stream_exergy(room, to) * 1.001);
    EXPECT_GE(used, (first - cold) * stream_exergy(room, to) * 0.999);
    EXPECT_LE(used, stored_exergy(room, litre, from) - stored_exergy(room, litre, to));
  }
}

TEST(Storage, ACompressorIsLinearBetweenItsPoints) {
  // Viair 90C, 10 and 110 psi.
  const std::array<CompressorPoint, 3> points{
      {{0, 4.15e-4, 84}, {69e3, 2.36e-4, 96}, {758e3, 1.04e-4, 120}}};
  EXPECT_EQ(compressor_at(points, 69e3).free_flow, 2.36e-4);
  EXPECT_NEAR(compressor_at(points, 34.5e3).free_flow, 0.5 * (4.15e-4 + 2.36e-4), 1e-12);
  EXPECT_NEAR(compressor_at(points, 34.5e3).power, 90, 1e-9);
  EXPECT_EQ(compressor_at(points, -1e3).free_flow, 4.15e-4);
  EXPECT_EQ(compressor_at(points, 758e3).power, 120);
  EXPECT_EQ(compressor_at(points, 800e3).free_flow, 0);
  EXPECT_EQ(compressor_at({}, 1e5).free_flow, 0);
}

TEST(Storage, ARegulatorFallsWithItsFlow) {
  const double droop = 1e5 / (150e-3 / 60);  // 1 bar at 150 l/min
  EXPECT_EQ(drooped_pressure(7e5, droop, 0), 7e5);
  EXPECT_NEAR(drooped_pressure(7e5, droop, 75e-3 / 60), 6.5e5, 1e-6);
}

}  // namespace
}  // namespace sinew::gas::storage_test
