// A hose between its two limits, the balance between restrictions, and leaks.
#include "sinew/gas/hose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/gas/leak.h"

namespace sinew::gas::hose_test {
namespace {

Hose pipe(double length, double diameter) {
  return {.law = Hose::Law::pipe, .length = length, .inner_diameter = diameter};
}

double flow(const Hose& hose, const Air& air, double a, double b) {
  return hose_flow_y(hose_constants(hose, air), y_of(air, a), y_of(air, b));
}

double reynolds(const Hose& hose, double mass_flow) {
  return 4 * mass_flow / (std::numbers::pi * hose.inner_diameter * viscosity_of_air);
}

// Hagen-Poiseuille with the mean density: m = pi D^4 rho dP/(128 mu L).
TEST(Hose, SlowFlowIsHagenPoiseuille) {
  const Air air;
  const Hose hose = pipe(1.0, 2.5e-3);
  for (double dp : {1.0, 5.0, 20.0}) {
    const double a = 4e5 + dp, b = 4e5;
    const double density = 0.5 * (a + b) / (air.gas_constant * air.temperature);
    const double expected =
        std::numbers::pi * std::pow(2.5e-3, 4) * density * dp / (128 * viscosity_of_air);
    ASSERT_LT(reynolds(hose, expected), 400);
    EXPECT_NEAR(flow(hose, air, a, b) / expected, 1, 1e-3);
  }
}

// Darcy-Weisbach with Blasius's factor, for a drop small enough that the density is constant.
TEST(Hose, FastFlowIsBlasius) {
  const Air air;
  const Hose hose = pipe(1.0, 4e-3);
  const double a = 6.05e5, b = 6e5, m = flow(hose, air, a, b);
  const double re = reynolds(hose, m);
  ASSERT_GT(re, 1e4);
  ASSERT_LT(re, 1e5);
  const double area = std::numbers::pi * 4e-6,
               density = 0.5 * (a + b) / (air.gas_constant * air.temperature);
  const double speed = m / (density * area), factor = 0.3164 / std::pow(re, 0.25);
  EXPECT_NEAR(factor * (1.0 / 4e-3) * 0.5 * density * speed * speed / (a - b), 1, 1e-3);
}

// Where both laws have the same flow the blend is 2^(1/8) below.
TEST(Hose, TheLawsCrossAtReynolds1187) {
  EXPECT_NEAR(blasius_crossing(), 1187, 1);
  const Air air;
  const Hose hose = pipe(1.0, 3e-3);
  const double square =
      std::pow(turbulent_conductance(hose, air) / laminar_conductance(hose, air), 7.0 / 3.0);
  const double b = 3e5, a = std::sqrt(b * b + square);
  const double laminar = laminar_conductance(hose, air) * square;
  EXPECT_NEAR(reynolds(hose, laminar) / blasius_crossing(), 1, 1e-9);
  EXPECT_NEAR(flow(hose, air, a, b) / laminar, std::pow(2.0, -1.0 / 8), 1e-9);
}

TEST(Hose, IsAntisymmetricMonotoneAndNeverAboveEitherLaw) {
  const Air air;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> pressures(5e4, 9e5), lengths(0.05, 3), diameters(1e-3, 8e-3);
  for (int i = 0; i < 3000; ++i) {
    const Hose hose = pipe(lengths(random), diameters(random));
    const double a = pressures(random), b = pressures(random), m = flow(hose, air, a, b);
    EXPECT_EQ(m, -flow(hose, air, b, a));
    EXPECT_EQ(flow(hose, air, a, a), 0);
    const double squares = std::abs(a * a - b * b);
    const double area = std::numbers::pi / 4 * hose.inner_diameter * hose.inner_diameter;
    const double most = std::min({laminar_conductance(hose, air) * squares,
                                  turbulent_conductance(hose, air) * std::pow(squares, 4.0 / 7.0),
                                  mass_flow(area, std::max(a, b), air.temperature, 0, air)});
    EXPECT_LE(std::abs(m), most * (1 + 1e-9));
    EXPECT_GE(std::abs(m), 0.9 * most);
    if (a > b) {
      EXPECT_GE(flow(hose, air, a * 1.001, b), m);
      EXPECT_GE(flow(hose, air, a, b * 0.999), m * (1 - 1e-14));
    }
  }
}

TEST(Hose, GoesAsItsDiameterToTheFourthAndItsLengthWhereItIsLaminar) {
  const Air air;
  const double one = flow(pipe(1, 1e-3), air, 1.01e5, 1e5);
  EXPECT_NEAR(flow(pipe(2, 1e-3), air, 1.01e5, 1e5) / one, 0.5, 1e-3);
  EXPECT_NEAR(flow(pipe(16, 2e-3), air, 1.01e5, 1e5) / one, 1, 1e-3);
}

TEST(Hose, ByConductanceItIsAValve) {
  const Air air;
  const Hose hose = {
      .law = Hose::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.3};
  const Flow valve = {
      .law = Flow::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.3};
  for (double a : {1e5, 3e5, 7e5})
    EXPECT_NEAR(flow(hose, air, a, 2e5), mass_flow(valve, air, a, 2e5), 1e-15);
}

// Roots of functions of all shapes, including the infinite slope of an orifice.
TEST(Balance, FindsWhereTheSurplusVanishes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<> roots(1.0, 1.35);
  for (int i = 0; i < 2000; ++i) {
    const double root = roots(random);
    int calls = 0;
    const auto straight = [&](double y) { return ++calls, root - y; };
    const auto steep = [&](double y) {
      const double d = root - y;
      return ++calls, d > 0 ? std::sqrt(d) : -std::sqrt(-d);
    };
    const auto flat = [&](double y) { return ++calls, (root - y) * (root - y) * (root - y); };
    EXPECT_NEAR(balance(straight, 1.0, 1.35), root, 1e-15);
    EXPECT_NEAR(balance(steep, 1.0, 1.35), root, 1e-15);
    EXPECT_LT(calls, 80);
    EXPECT_NEAR(balance(flat, 1.0, 1.35), root, 1e-5);  // cubed, that is below rounding
  }
  // Ends that are roots are returned.
  EXPECT_EQ(balance([](double y) { return 1.0 - y; }, 1.0, 1.3), 1.0);
  EXPECT_EQ(balance([](double y) { return 1.3 - y; }, 1.0, 1.3), 1.3);
}

TEST(Leak, IsTheHoleAndThePorousWallTogether) {
  const Air air;
  const Leak leak{.area = 2e-8, .conductance = 1e-11};
  const LeakConstants c = leak_constants(leak, air);
  for (double p : {0.7e5, 1.2e5, 6e5}) {
    const double hole = mass_flow(Flow{.area = 2e-8}, air, p, air.atmosphere);
    EXPECT_NEAR(leak_flow_y(c, y_of(air, p)), hole + 1e-11 * (p - air.atmosphere), 1e-17);
  }
  EXPECT_EQ(leak_flow_y(c, 1.0), 0);
  EXPECT_TRUE(leak_constants({}, air).tight());
  EXPECT_FALSE(leak_constants({.conductance = 1e-12}, air).tight());
}

}  // namespace
}  // namespace sinew::gas::hose_test
