// Flow figures of makers: conversions against published factors, and there and back.

#include "sinew/gas/conductance.h"

#include <gtest/gtest.h>

#include <random>

namespace sinew::gas::conductance_test {
namespace {

constexpr double litre_per_minute = 1e-3 / 60;
constexpr double litre_per_second_bar = 1e-8;  // [m3/(s Pa)]

// Q_n in L/min per C in L/(s bar); the published factors have three or four digits.
TEST(Conductance, NominalFlowHasThePublishedFactors) {
  const auto factor = [](double b) {
    return nominal_flow_of(litre_per_second_bar, b) / litre_per_minute;
  };
  EXPECT_NEAR(factor(0.3), 254.5, 0.05);
  EXPECT_NEAR(factor(0.38), 268, 0.5);
  EXPECT_NEAR(factor(0.528), 301, 0.5);
}

// "About 993" and "about 3.9": conventions for the step from water to air differ by a percent.
TEST(Conductance, ACvHasThePublishedFactorsWithinOnePercent) {
  const double per_cv = nominal_flow_of_cv(1) / litre_per_minute;
  EXPECT_NEAR(per_cv / 993, 1, 0.01);
  const double c = conductance_of_nominal_flow(nominal_flow_of_cv(1), 0.3);
  EXPECT_NEAR(c / litre_per_second_bar / 3.9, 1, 0.01);
  EXPECT_NEAR(kv_per_cv(), 0.865, 5e-4);
}

// 5.3 scfm at 90 psi gauge and 14.5 psi of difference were published with C_v = 0.149.
TEST(Conductance, ARegulatorsPublishedFlowAndCvAgree) {
  const double scfm = 22.48 * 0.149 * std::sqrt(14.5 * (90 - 14.5 + 14.7) / 527.67);
  EXPECT_NEAR(scfm / 5.3, 1, 0.01);
}

TEST(Conductance, AHoleOfOneSquareMillimetreHasItsPublishedConductance) {
  EXPECT_NEAR(sonic_conductance_of(1e-6, Air{}) / litre_per_second_bar, 0.199, 5e-4);
}

TEST(Conductance, EachConversionReturnsItsNumber) {
  std::mt19937 random(44);
  std::uniform_real_distribution<double> exponent(-11, -6), ratio(0, 0.9);
  for (int i = 0; i < 1000; ++i) {
    const double c = std::pow(10, exponent(random)), b = ratio(random);
    const double flow = nominal_flow_of(c, b);
    EXPECT_NEAR(conductance_of_nominal_flow(flow, b) / c, 1, 1e-14);
    EXPECT_NEAR(nominal_flow_of_cv(cv_of_nominal_flow(flow)) / flow, 1, 1e-14);
    EXPECT_NEAR(effective_area_of(sonic_conductance_of(c, Air{}), Air{}) / c, 1, 1e-14);
  }
}

// The flow grows with b at the same C, and is the law's own at these pressures.
TEST(Conductance, NominalFlowIsTheLawsAndGrowsWithTheCriticalRatio) {
  const Air air{.temperature = iso_temperature};
  double before = 0;
  for (double b = 0.05; b < 0.85; b += 0.05) {
    const Flow flow{
        .law = Flow::Law::iso6358, .sonic_conductance = 3e-9, .critical_pressure_ratio = b};
    const double now = nominal_flow_of(3e-9, b);
    EXPECT_NEAR(mass_flow(flow, air, nominal_upstream, nominal_downstream) / (iso_density * now), 1,
                1e-14);
    EXPECT_GT(now, before);
    before = now;
  }
}

}  // namespace
}  // namespace sinew::gas::conductance_test
