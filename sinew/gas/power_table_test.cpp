// Powers from a table: as exact as units::power everywhere.
#include "sinew/gas/power_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::gas::power_table_test {
namespace {

double relative(double a, double b) { return std::fabs(a / b - 1.0); }

TEST(PowerTable, IsAsExactAsThePower) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> octave(-8, 8), n(1.0, 1.4);
  for (int k = 0; k < 20; ++k) {
    const double exponent = n(random) / 7.0;
    const PowerTable table(exponent);
    for (int i = 0; i < 20'000; ++i) {
      const double q = std::exp2(octave(random));
      const auto truth = static_cast<double>(
          std::pow(static_cast<long double>(q), static_cast<long double>(exponent)));
      ASSERT_LT(relative(table(q), truth), 1.2e-15) << q << " ^ " << exponent;
    }
  }
}

// Tests both sides of each border between parts and octaves, to detect a wrong neighbour.
TEST(PowerTable, HasNoSteps) {
  const PowerTable table(1.04 / 7.0);
  for (double octave = 1.0 / 256; octave < 256; octave *= 2)
    for (int i = 0; i < 64; ++i) {
      const double border = octave * (1.0 + i / 64.0);
      EXPECT_LT(relative(table(border), table(std::nextafter(border, 0.0))), 2.5e-15) << border;
    }
}

TEST(PowerTable, GoesByThePowerBeyondIt) {
  const PowerTable table(0.2);
  for (const double q : {1e-9, 3e-3, 257.0, 1e6}) EXPECT_EQ(table(q), units::power(q, 0.2));
}

}  // namespace
}  // namespace sinew::gas::power_table_test
