// Flow through an open valve: the orifice of [42]-[44], ISO 6358, and their fast forms.

#include "sinew/gas/orifice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sinew::gas::orifice_test {
namespace {

constexpr double area = 1.6722547200000001e-06;  // 1.8e-5 ft2

Flow orifice() { return {.area = area, .efficiency = 0.85}; }

Flow iso() {
  return {.law = Flow::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = 0.35};
}

const std::vector<Flow> both_laws{orifice(), iso()};

double critical_of(const Flow& flow) {
  return flow.law == Flow::Law::iso6358 ? flow.critical_pressure_ratio : critical_pressure_ratio();
}

double any_pressure(std::mt19937_64& random) {
  return std::uniform_real_distribution<>(5e4, 9e5)(random);
}

double fast(const Flow& flow, const Air& air, double a, double b) {
  return flow_y(flow_constants(flow, air), y_of(air, a), y_of(air, b));
}

TEST(Orifice, IsChokedWhereItsFlowIsGreatest) {
  const Air air;
  const double critical = critical_pressure_ratio();
  const auto free_flow = [](double r) {
    return std::sqrt(std::pow(r, 2 / 1.4) - std::pow(r, 2.4 / 1.4));
  };
  EXPECT_GT(free_flow(critical), free_flow(critical - 1e-3));
  EXPECT_GT(free_flow(critical), free_flow(critical + 1e-3));

  // Below the limit the downstream pressure has no effect.
  const double up = 6e5, choked = mass_flow(area, up, 293, critical * up, air);
  for (double r : {0.0, 0.1, 0.5}) EXPECT_EQ(mass_flow(area, up, 293, r * up, air), choked);
}

TEST(Orifice, ChokedFlowIsTheFreeLawAtTheCriticalRatio) {
  for (double gamma : {1.1, 1.3, 1.4, 1.6667}) {
    const double r = critical_pressure_ratio(gamma);
    const double root = std::sqrt(std::pow(r, 2 / gamma) - std::pow(r, (gamma + 1) / gamma));
    EXPECT_NEAR(choked_parameter(287, gamma), free_parameter(287, gamma) * root, 1e-15);
  }
}

// Isentropic nozzle, derived independently: throat temperature and speed of sound.
TEST(Orifice, ChokedFlowIsDensityTimesSoundAtTheThroat) {
  const Air air;
  const double up = 7e5, temperature = 293;
  const double throat_temperature = temperature / 1.2, throat_pressure = up * std::pow(1.2, -3.5);
  const double density = throat_pressure / (air.gas_constant * throat_temperature);
  const double sound = std::sqrt(1.4 * air.gas_constant * throat_temperature);
  EXPECT_NEAR(mass_flow(area, up, temperature, 1e5, air) / (area * density * sound), 1, 1e-14);
}

TEST(Iso6358, AtTheReferenceAirIsVolumeFlowPerPressure) {
  // m' = C rho_0 P at T_0, choked.
  EXPECT_DOUBLE_EQ(mass_flow_iso6358(2e-9, 0.3, 7e5, 293.15, 1e5), 2e-9 * 1.185 * 7e5);
}

TEST(Iso6358, IsAQuarterEllipseAboveTheCriticalRatio) {
  const double up = 7e5, b = 0.3, choked = mass_flow_iso6358(2e-9, b, up, 300, b * up);
  for (double x : {0.0, 0.2, 0.6, 0.9, 1.0}) {
    const double flow = mass_flow_iso6358(2e-9, b, up, 300, (b + x * (1 - b)) * up) / choked;
    EXPECT_NEAR(flow * flow + x * x, 1, 1e-12);
  }
}

TEST(Flow, ConductanceAndAreaConvertBothWays) {
  const Air air;
  EXPECT_NEAR(effective_area_of(sonic_conductance_of(area, air), air), area, 1e-20);
}

TEST(Flow, IsoValveOfTheSameConductanceIsTheChokedOrifice) {
  const Air air;
  const Flow valve = {.law = Flow::Law::iso6358,
                      .sonic_conductance = sonic_conductance_of(0.85 * area, air),
                      .critical_pressure_ratio = critical_pressure_ratio()};
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double up = any_pressure(random);
    for (double r : {0.1, 0.3, 0.52}) {
      const double by_area = mass_flow(orifice(), air, up, r * up);
      EXPECT_NEAR(mass_flow(valve, air, up, r * up) / by_area, 1, 1e-13);
    }
    // Free, the ellipse with b = 0.528 stays within 0.3 % of the orifice.
    for (double r = 0.53; r < 0.999; r += 0.01) {
      const double by_area = mass_flow(orifice(), air, up, r * up);
      EXPECT_NEAR(mass_flow(valve, air, up, r * up) / by_area, 1, 3.1e-3);
    }
  }
}

TEST(Flow, FastFormIsTheGeneralOne) {
  std::mt19937_64 random(2);
  const Air air;
  for (const Flow& flow : both_laws) {
    for (int i = 0; i < 20000; ++i) {
      const double a = any_pressure(random);
      const double b = i % 2 ? any_pressure(random) : a * (1 + 2e-3 * (i % 101 - 50) / 50.0);
      const double slow = mass_flow(flow, air, a, b);
      // The difference of nearly equal pressures is what is small, so compare with choked flow.
      const double size = std::abs(mass_flow(flow, air, std::max(a, b), 0));
      ASSERT_NEAR(fast(flow, air, a, b), slow, 1e-12 * size) << a << " " << b;
      if (std::abs(a - b) > 0.01 * a) {
        ASSERT_NEAR(fast(flow, air, a, b) / slow, 1, 1e-12);
      }
    }
  }
}

// The fast form does not depend on the exponent of the chamber's air.
TEST(Flow, DoesNotDependOnThePolytropicExponent) {
  Air air;
  const double adiabatic = fast(orifice(), air, 6e5, 4e5);
  air.polytropic_exponent = 1.05;
  EXPECT_EQ(fast(orifice(), air, 6e5, 4e5), adiabatic);
}

TEST(Flow, BackIsTheNegativeOfForthToTheBit) {
  std::mt19937_64 random(3);
  const Air air;
  for (const Flow& flow : both_laws) {
    for (int i = 0; i < 10000; ++i) {
      const double a = any_pressure(random), b = any_pressure(random);
      EXPECT_EQ(fast(flow, air, a, b), -fast(flow, air, b, a));
      EXPECT_EQ(mass_flow(flow, air, a, b), -mass_flow(flow, air, b, a));
      EXPECT_EQ(fast(flow, air, a, b) > 0, y_of(air, a) > y_of(air, b));
    }
    EXPECT_EQ(fast(flow, air, 3e5, 3e5), 0);
  }
}

TEST(Flow, IsContinuousWhereTheLawChanges) {
  const Air air;
  for (const Flow& flow : both_laws) {
    const double up = 6e5;
    for (double ratio : {critical_of(flow), 1 - flow.linear_below}) {
      const double below = fast(flow, air, up, up * (ratio - 1e-12));
      const double above = fast(flow, air, up, up * (ratio + 1e-12));
      EXPECT_NEAR(below / above, 1, 1e-8);
    }
  }
}

TEST(Flow, IsLinearInTheDifferenceNearEqualPressures) {
  const Air air;
  for (const Flow& flow : both_laws) {
    const double up = 5e5;
    const double edge = fast(flow, air, up, up * (1 - flow.linear_below));
    for (double share : {0.0, 0.01, 0.5, 0.99}) {
      const double flow_there = fast(flow, air, up, up * (1 - share * flow.linear_below));
      EXPECT_NEAR(flow_there, share * edge, 1e-11 * edge);
    }
    // With the same slope at any pressure: G (P_a - P_b).
    EXPECT_NEAR(fast(flow, air, 2 * up, 2 * up - 100), fast(flow, air, up, up - 100), 1e-9 * edge);
  }
}

// A flow reports which of the two it is: the straight line is below the law and meets it at its
// end.
TEST(Flow, ReportsWhetherItIsInTheLinearPart) {
  const Air air;
  for (const Flow& flow : both_laws) {
    Flow law = flow;
    law.linear_below = 0;
    const double up = 5e5;
    for (const double share : {0.1, 0.5, 0.9, 1.1, 2.0}) {
      const double down = up * (1 - share * flow.linear_below);
      const bool linear = in_linear_part(flow, up, down);
      EXPECT_EQ(linear, share < 1);
      EXPECT_EQ(in_linear_part(flow, down, up), linear);
      EXPECT_FALSE(in_linear_part(law, up, down));
      const double ratio = mass_flow(flow, air, up, down) / mass_flow(law, air, up, down);
      EXPECT_NEAR(ratio, linear ? std::sqrt(share) : 1, 1e-2);
    }
  }
}

TEST(Flow, WithoutALinearPartIsTheBareLaw) {
  const Air air;
  for (Flow flow : both_laws) {
    flow.linear_below = 0;
    const double up = 5e5, down = up * (1 - 1e-4);
    Flow tight = flow;
    tight.linear_below = 5e-5;
    EXPECT_NEAR(fast(flow, air, up, down) / fast(tight, air, up, down), 1, 1e-12);
    EXPECT_EQ(fast(flow, air, up, up), 0);
  }
}

TEST(Flow, NeverFallsWhenTheDifferenceGrows) {
  const Air air;
  for (const Flow& flow : both_laws) {
    double last = 0;
    for (double down = 6e5; down > 1e4; down *= 0.9997) {
      const double now = fast(flow, air, 6e5, down);
      EXPECT_GE(now, last * (1 - 1e-14));
      last = now;
    }
  }
}

// Pressures times p, lengths times k: mass flow scales as p k^2, and as 1/sqrt(T).
TEST(Flow, ScalesWithAreaPressureAndTemperature) {
  const double k = 2.5, p = 3;
  std::mt19937_64 random(4);
  for (int i = 0; i < 1000; ++i) {
    const double a = any_pressure(random), b = any_pressure(random);
    for (const Flow& flow : both_laws) {
      Flow big = flow;
      big.area *= k * k;
      big.sonic_conductance *= k * k;
      const Air air, dense{.atmosphere = p * Air{}.atmosphere},
          hot{.temperature = 4 * Air{}.temperature};
      const double one = fast(flow, air, a, b);
      const double size = std::abs(mass_flow(flow, air, std::max(a, b), 0));  // choked
      EXPECT_NEAR(fast(big, dense, p * a, p * b) / (p * k * k), one, 1e-12 * size);
      EXPECT_NEAR(fast(flow, hot, a, b), one / 2, 1e-12 * size);
    }
  }
}

// A loop over lanes gives each lane the scalar's bits.
TEST(Flow, LanesHaveTheBitsOfTheScalar) {
  constexpr int lanes = 64;
  const Air air;
  Flow rounded = orifice();
  rounded.law = Flow::Law::appendix_a;
  const FlowConstants c[3] = {flow_constants(orifice(), air), flow_constants(iso(), air),
                              flow_constants(rounded, air)};
  double gain[lanes], choked[lanes], choke[lanes], spread[lanes], slope[lanes], from[lanes],
      is_iso[lanes];
  double a[lanes], b[lanes], out[lanes];
  std::mt19937_64 random(5);
  for (int i = 0; i < lanes; ++i) {
    const FlowConstants& k = c[i % 3];
    gain[i] = k.gain, choked[i] = k.choked_gain, choke[i] = k.choke, spread[i] = k.spread;
    slope[i] = k.linear_gain, from[i] = k.linear_from, is_iso[i] = k.iso;
    a[i] = y_of(air, any_pressure(random));
    b[i] = i % 5 ? y_of(air, any_pressure(random)) : a[i] * (1 + 1e-5 * (i - 30));
  }
  for (int i = 0; i < lanes; ++i) {
    const FlowConstants k{gain[i], choked[i], choke[i], spread[i], slope[i], from[i], is_iso[i]};
    out[i] = flow_y(k, a[i], b[i]);
  }
  for (int i = 0; i < lanes; ++i) {
    volatile double ya = a[i], yb = b[i];
    EXPECT_EQ(out[i], flow_y(c[i % 3], double{ya}, double{yb}));
  }
}

TEST(Flow, ShutValvePassesNothing) {
  const Flow shut;
  EXPECT_EQ(fast(shut, Air{}, 8e5, 1e5), 0);
}

}  // namespace
}  // namespace sinew::gas::orifice_test
